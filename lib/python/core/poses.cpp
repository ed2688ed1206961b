// Pose and Poses, from a rotation matrix or a quaternion. They validate rotations once, as the core requires.
#include "poses.hpp"

#include <pybind11/stl.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "arrays.hpp"
#include "base/usable_pose.hpp"
#include "base/validation.hpp"
#include "bindings.hpp"
#include "values.hpp"

namespace py = pybind11;

namespace supernormal::python {
namespace {

// Rotations computed in double precision are within this error, and are used unchanged, bit for bit. Flat faces tolerate no more.
// The limits and the measure equal those in lib/ode/geom/rotation.hpp.
constexpr double kRoundedRotation = 1e-14;

// A rotation typed with three decimals is accepted. A scale or shear of one per cent is not.
constexpr double kNearRotation = 1e-2;

constexpr double kUnitQuaternion = 1e-6;

Matrix3 require_rotation(Name name, const Matrix3& R) {
  // The largest entry is tested first, because its square might overflow.
  const double error = all_within(R, 2) ? rotation_error(R) : std::numeric_limits<double>::infinity();
  if (error <= kRoundedRotation) return R;
  if (!(error <= kNearRotation)) {
    std::array<double, 9> rows{};
    write_matrix(R, rows.data());
    throw std::invalid_argument(name.text() + " = " + vector_text(rows.data(), 9) +
                                " (by rows), but must be orthonormal and right-handed to " + to_text(kNearRotation));
  }
  // The nearest rotation is the orthogonal factor of the polar decomposition.
  const Eigen::JacobiSVD<Matrix3> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

Matrix3 require_quaternion(Name name, const double* q) {
  const double norm = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  if (!std::islessequal(std::abs(norm - 1), kUnitQuaternion)) {
    throw std::invalid_argument(name.text() + " = " + vector_text(q, 4) + " (w, x, y, z) has the length " + to_text(norm) +
                                ", but must have 1 to " + to_text(kUnitQuaternion));
  }
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
}

void refuse_two_orientations(bool rotation, bool quaternion) {
  if (rotation && quaternion) throw std::invalid_argument("rotation and quaternion are both given; give one of them");
}

void require_as_many(const char* name, py::ssize_t count, py::ssize_t wanted) {
  if (count == wanted) return;
  throw std::invalid_argument(std::string(name) + " has " + std::to_string(count) + " entries and position " +
                              std::to_string(wanted) + "; they must have as many");
}

Poses make_poses(const Doubles& position, const std::optional<Doubles>& rotation, const std::optional<Doubles>& quaternion) {
  refuse_two_orientations(rotation.has_value(), quaternion.has_value());
  const py::ssize_t count = require_rows("position", position, {3});
  if (rotation) require_as_many("rotation", require_rows("rotation", *rotation, {3, 3}), count);
  if (quaternion) require_as_many("quaternion", require_rows("quaternion", *quaternion, {4}), count);
  Poses result;
  result.poses.resize(static_cast<std::size_t>(count));
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    Pose& pose = result.poses[static_cast<std::size_t>(i)];
    pose.position = require_place({"position", i}, vector_at(position.data() + 3 * i));
    if (rotation) pose.rotation = require_rotation({"rotation", i}, matrix_at(rotation->data() + 9 * i));
    if (quaternion) pose.rotation = require_quaternion({"quaternion", i}, quaternion->data() + 4 * i);
  }
  return result;
}

py::array_t<double> positions_of(const Poses& self) {
  py::array_t<double> out({static_cast<py::ssize_t>(self.poses.size()), py::ssize_t{3}});
  double* to = out.mutable_data();
  for (const Pose& pose : self.poses) to = std::copy(pose.position.data(), pose.position.data() + 3, to);
  return out;
}

py::array_t<double> rotations_of(const Poses& self) {
  py::array_t<double> out({static_cast<py::ssize_t>(self.poses.size()), py::ssize_t{3}, py::ssize_t{3}});
  double* to = out.mutable_data();
  for (const Pose& pose : self.poses) {
    write_matrix(pose.rotation, to);
    to += 9;
  }
  return out;
}

py::object are_equal(const Poses& self, const py::object& other) {
  if (!py::isinstance<Poses>(other)) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
  const auto is_same = [](const Pose& a, const Pose& b) { return a.position == b.position && a.rotation == b.rotation; };
  return py::bool_(std::ranges::equal(self.poses, other.cast<const Poses&>().poses, is_same));
}

std::string text_of(const py::object& self) {
  const std::vector<Pose>& poses = self.cast<const Poses&>().poses;
  if (poses.size() > kMostInText) return call_text(self, poses.size(), "bodies");
  py::list positions, rotations;
  for (const Pose& pose : poses) {
    positions.append(plain(pose.position));
    rotations.append(plain(pose.rotation));
  }
  return call_text(self, {"position", "rotation"}, py::make_tuple(positions, rotations));
}

constexpr const char* kPoseDoc = R"(The position and orientation of a body: x_world = rotation @ x_body + position.

position: (3,), m, each coordinate within 1e150.
rotation: (3, 3), orthonormal and right-handed: the sum of the errors of the defining equations. Within 1e-14 it is used unchanged.
Within 1e-2 the nearest rotation is used.
quaternion: (4,), w, x, y, z, of unit length to 1e-6; instead of a rotation.

Raises ValueError when a number is out of range, when the matrix is not a rotation, or when both are given.)";

constexpr const char* kPosesDoc = R"(N poses, for find_proximities() and find_ray_hits().

position: (N, 3), m; rotation: (N, 3, 3) or None; quaternion: (N, 4), w, x, y, z, or None. The requirements and errors are the same
as for Pose. A message names the entry.)";

}  // namespace

Pose make_pose(const Vector3& position, const std::optional<Matrix3>& rotation, const std::optional<Eigen::Vector4d>& quaternion) {
  refuse_two_orientations(rotation.has_value(), quaternion.has_value());
  Pose pose;
  pose.position = require_place({"position"}, position);
  if (rotation) pose.rotation = require_rotation({"rotation"}, *rotation);
  if (quaternion) pose.rotation = require_quaternion({"quaternion"}, quaternion->data());
  return pose;
}

void bind_poses(py::module_& m) {
  py::class_<Pose> pose(m, "Pose", kPoseDoc);
  pose.def(py::init(&make_pose), py::arg("position") = Vector3(0, 0, 0), py::arg("rotation") = py::none(),
           py::arg("quaternion") = py::none());
  bind_arguments(
      pose, [](const py::tuple& of) { return make_pose(of[0].cast<Vector3>(), of[1].cast<Matrix3>(), std::nullopt); },
      Field{"position", &Pose::position, "(3,), m"}, Field{"rotation", &Pose::rotation, "(3, 3)"});
  py::class_<Poses, std::shared_ptr<Poses>> poses(m, "Poses", kPosesDoc);
  poses.def(py::init(&make_poses), py::arg("position"), py::arg("rotation") = py::none(), py::arg("quaternion") = py::none())
      .def_property_readonly("position", &positions_of, "(N, 3), m; a copy")
      .def_property_readonly("rotation", &rotations_of, "(N, 3, 3); a copy")
      .def("__len__", [](const Poses& self) { return self.poses.size(); })
      .def("__getitem__",
           [](const Poses& self, std::ptrdiff_t i) { return self.poses[require_index("poses", i, self.poses.size())]; })
      .def("__eq__", &are_equal, py::arg("other"))
      .def("__repr__", &text_of);
  bind_iteration(poses);
  bind_copies(
      poses, [](const std::shared_ptr<Poses>& self) { return py::make_tuple(positions_of(*self), rotations_of(*self)); },
      [](const py::tuple& of) {
        return std::make_shared<Poses>(make_poses(of[0].cast<Doubles>(), of[1].cast<Doubles>(), std::nullopt));
      });
}

}  // namespace supernormal::python
