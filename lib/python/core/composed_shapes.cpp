// Shapes composed of other shapes, of points or of user functions.
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "supernormal/python/interpreter_lock.hpp"
#include "supernormal/shapes/callback_shape.hpp"
#include "supernormal/shapes/linear_image.hpp"
#include "supernormal/shapes/minkowski_sum.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "values.hpp"

namespace py = pybind11;

namespace supernormal::python {
namespace {

using ShapePointer = std::shared_ptr<Shape>;

/// A Polytope refers to its points: store them together.
struct PolytopeAndPoints {
  explicit PolytopeAndPoints(std::vector<Vector3> vertices) : points(std::move(vertices)), polytope(points) {}

  std::vector<Vector3> points;
  Polytope polytope;
};

std::shared_ptr<Polytope> make_polytope(const Doubles& points) {
  const py::ssize_t count = require_rows("points", points, {3});
  std::vector<Vector3> vertices;
  vertices.reserve(static_cast<std::size_t>(count));
  for (py::ssize_t i = 0; i < count; ++i) vertices.push_back(vector_at(points.data() + 3 * i));
  const auto owner = std::make_shared<PolytopeAndPoints>(std::move(vertices));
  return {owner, &owner->polytope};
}

/// A Python function that C++ may call, copy and destroy on any thread, with or without the interpreter's lock.
class PythonFunction {
 public:
  PythonFunction(const char* name, py::function function)
      : name_(name), function_(new py::function(std::move(function)), [](py::function* last) {
          const HoldingTheLock lock;
          delete last;
        }) {}

  const py::function& function() const { return *function_; }

  /// Calls the function with a unit vector (3,). Reads `count` numbers of the result in array order.
  template <std::size_t kCount>
  std::array<double, kCount> call(const Vector3& n) const {
    const HoldingTheLock lock;
    return outlive_the_interpreter([&] { return call_locked<kCount>(n); });
  }

 private:
  template <std::size_t kCount>
  std::array<double, kCount> call_locked(const Vector3& n) const {
    py::array_t<double> direction(py::ssize_t{3});
    std::copy(n.data(), n.data() + 3, direction.mutable_data());
    // Each call of Python may end the thread. Until the wait nothing may be destroyed that takes the lock, such as an argument.
    const auto result = py::reinterpret_steal<py::object>(outlive_the_interpreter(
        [&] { return PyObject_CallFunctionObjArgs(function_->ptr(), direction.ptr(), static_cast<PyObject*>(nullptr)); }));
    if (!result) throw py::error_already_set();
    const Doubles values = outlive_the_interpreter([&] { return Doubles::of(result); });
    if (!values || values.size() != static_cast<py::ssize_t>(kCount)) {
      throw std::invalid_argument(std::string(name_) + "(" + vector_text(n.data(), 3) + ") returned " +
                                  std::string(py::repr(result)) + ", but must return " + std::to_string(kCount) +
                                  (kCount == 1 ? " number" : " numbers"));
    }
    std::array<double, kCount> out{};
    std::copy(values.data(), values.data() + kCount, out.begin());
    return out;
  }

  const char* name_;
  std::shared_ptr<py::function> function_;
};

/// The functions of a CallbackShape.
struct Functions {
  PythonFunction point;
  std::optional<PythonFunction> support, hessian;

  py::tuple arguments() const {
    const auto or_none = [](const std::optional<PythonFunction>& it) { return it ? py::object(it->function()) : py::none(); };
    return py::make_tuple(point.function(), or_none(support), or_none(hessian));
  }
};

/// The functions of all living CallbackShapes. Access needs the interpreter's lock. The map is never destroyed.
std::unordered_map<const CallbackShape*, Functions>& functions_of() {
  static auto* const map = new std::unordered_map<const CallbackShape*, Functions>;
  return *map;
}

void delete_callback_shape(const CallbackShape* last) {
  const HoldingTheLock lock;
  functions_of().erase(last);
  delete last;
}

std::shared_ptr<CallbackShape> make_callback_shape(py::function point, std::optional<py::function> support,
                                                   std::optional<py::function> hessian) {
  Functions given{PythonFunction("point", std::move(point)), std::nullopt, std::nullopt};
  const auto point_of = [function = given.point](const Vector3& n) { return vector_at(function.call<3>(n).data()); };
  CallbackShape::Support support_of = [point_of](const Vector3& n) { return n.dot(point_of(n)); };
  if (support) {
    given.support.emplace("support", std::move(*support));
    support_of = [function = *given.support](const Vector3& n) { return function.call<1>(n)[0]; };
  }
  CallbackShape::Hessian hessian_of;
  if (hessian) {
    given.hessian.emplace("hessian", std::move(*hessian));
    hessian_of = [function = *given.hessian](const Vector3& n) { return matrix_at(function.call<9>(n).data()); };
  }
  auto shape = std::make_unique<CallbackShape>(std::move(support_of), point_of, std::move(hessian_of));
  functions_of().emplace(shape.get(), std::move(given));
  return {shape.release(), &delete_callback_shape};
}

/// A part of a composed shape. The pointer keeps the whole alive.
template <typename Whole>
ShapePointer part_of(const std::shared_ptr<Whole>& whole, const Shape& part) {
  return {whole, const_cast<Shape*>(&part)};  // NOLINT(cppcoreguidelines-pro-type-const-cast): Python has no const
}

constexpr const char* kCallbackDoc =
    R"(A convex body defined by functions of the unit normal n, (3,), in the body's frame.

point(n): (3,), m: the boundary point with outward normal n; for a flat face, any of its points.
support(n): m: the support function h(n) = n . point(n). None: computed from point.
hessian(n): (3, 3), m: the second derivatives of h; symmetric, hessian(n) @ n = 0. None: solvers estimate the radii of curvature.

The functions must be pure. They are called with the interpreter's lock, from the thread that queries the shape, so a batch of
such shapes uses one core. The constructor tests them in 26 directions. It raises ValueError, with the direction, the value and
the expected value, unless all results are finite and belong to a convex body of a size in [1e-30, 1e30] m. An exception in a
later call ends the query and propagates.)";

void bind_polytope(py::module_& m) {
  py::class_<Polytope, Shape, std::shared_ptr<Polytope>> type(
      m, "Polytope",
      "The convex hull of points: a point, a segment, a triangle or a solid. The origin should be near its centre.\n\n"
      "points: (N, 3), m, N >= 1, within 1e30; ValueError otherwise.");
  type.def(py::init(&make_polytope), py::arg("points"))
      .def_property_readonly(
          "points", [](const Polytope& self) { return rows_of(self.points()); }, "(N, 3), m; a copy")
      .def("__repr__", [](const py::object& self) {
        const auto points = self.cast<const Polytope&>().points();
        if (points.size() > kMostInText) return call_text(self, points.size(), "points");
        py::list rows;
        for (const Vector3& point : points) rows.append(plain(point));
        return call_text(self, {"points"}, py::make_tuple(rows));
      });
  // == does not compare arrays by value. It does compare their bytes.
  bind_value(
      type, [](const std::shared_ptr<Polytope>& self) { return py::make_tuple(rows_of(self->points()).attr("tobytes")()); },
      [](const py::tuple& of) {
        const py::array numbers = py::module_::import("numpy").attr("frombuffer")(of[0]);
        return make_polytope(numbers.attr("reshape")(-1, 3).cast<Doubles>());
      });
}

void bind_combinations(py::module_& m) {
  bind_shape<Rounded>(m, "Rounded", "A shape swept by a sphere.\n\nradius: m, in [0, 1e30]; ValueError otherwise.",
                      Field{"core", [](const std::shared_ptr<Rounded>& self) { return part_of(self, self->core()); },
                            "Shape: the shape without the rounding"},
                      Field{"radius", &Rounded::radius, "m"});
  using Sum = std::shared_ptr<MinkowskiSum>;
  bind_shape<MinkowskiSum>(m, "MinkowskiSum", "All points p + q with p in the first shape and q in the second.",
                           Field{"first", [](const Sum& self) { return part_of(self, self->first()); }, "Shape: one of the two"},
                           Field{"second", [](const Sum& self) { return part_of(self, self->second()); }, "Shape: the other"});
  bind_shape<LinearImage>(
      m, "LinearImage",
      "The points matrix @ p of all points p of a shape.\n\n"
      "matrix: (3, 3), with singular values in [1e-30, 1e30] and a ratio of at most 1e12; ValueError otherwise.",
      Field{"shape", [](const std::shared_ptr<LinearImage>& self) { return part_of(self, self->shape()); },
            "Shape: the original shape"},
      Field{"matrix", &LinearImage::matrix, "(3, 3)"});
}

void bind_callback_shape(py::module_& m) {
  py::class_<CallbackShape, Shape, std::shared_ptr<CallbackShape>> type(m, "CallbackShape", kCallbackDoc);
  type.def(py::init(&make_callback_shape), py::arg("point"), py::arg("support") = py::none(), py::arg("hessian") = py::none());
  bind_value(
      type, {"point", "support", "hessian"},
      [](const std::shared_ptr<CallbackShape>& self) { return functions_of().at(self.get()).arguments(); },
      [](const py::tuple& of) {
        using Function = std::optional<py::function>;
        return make_callback_shape(of[0].cast<py::function>(), of[1].cast<Function>(), of[2].cast<Function>());
      });
}

}  // namespace

void bind_composed_shapes(py::module_& m) {
  bind_polytope(m);
  bind_combinations(m);
  bind_callback_shape(m);
}

}  // namespace supernormal::python
