// Shapes and poses as text, and back.
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <variant>

#include "bindings.hpp"
#include "poses.hpp"
#include "supernormal/shapes/description.hpp"

namespace py = pybind11;

namespace supernormal::python {
namespace {

constexpr const char* kDescribeDoc = R"(The text of a shape or a pose: an expression that makes it again, such as
Rounded(core=Box(half_lengths=(1, 2, 3)), radius=0.1). The C++ core and the C interface read and write the same text.

Numbers have the fewest digits that read back as the same double. A subclass is described as the class of this package from which
it derives. Raises ValueError for a CallbackShape, by name, and for a shape that contains one.)";

constexpr const char* kReadShapeDoc = R"(The shape with this description. Nothing is evaluated, so the text may come from anywhere.

Raises ValueError with the place and what is expected there for any other text, and for arguments out of range.)";

constexpr const char* kReadPoseDoc = R"(The pose with this description.

Raises ValueError with the place and what is expected there for any other text, and as Pose() does.)";

}  // namespace

void bind_descriptions(py::module_& m) {
  using Value = std::variant<const Shape*, const Pose*>;
  m.def(
      "describe", [](const Value& value) { return std::visit([](const auto* of) { return describe(*of); }, value); },
      py::arg("value").none(false), kDescribeDoc);
  m.def(
      "read_shape", [](const std::string& text) { return std::const_pointer_cast<Shape>(read_shape(text)); }, py::arg("text"),
      kReadShapeDoc);
  m.def(
      "read_pose",
      [](const std::string& text) {
        const Pose pose = read_pose(text);
        return make_pose(pose.position, pose.rotation, {});
      },
      py::arg("text"), kReadPoseDoc);
}

}  // namespace supernormal::python
