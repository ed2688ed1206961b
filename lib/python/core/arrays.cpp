#include "arrays.hpp"

#include <algorithm>
#include <stdexcept>

#include "base/usable_pose.hpp"
#include "base/validation.hpp"

namespace py = pybind11;

namespace supernormal::python {

std::string Name::text() const {
  return index < 0 ? std::string(argument) : std::string(argument) + "[" + std::to_string(index) + "]";
}

void refuse_type(const std::string& name, const py::handle& argument, const char* wanted) {
  throw py::type_error(name + " is " + std::string(py::repr(argument)) + ", but must be " + wanted);
}

std::size_t require_index(const char* name, std::ptrdiff_t index, std::size_t count) {
  const auto size = static_cast<std::ptrdiff_t>(count);
  if (index >= -size && index < size) return static_cast<std::size_t>(index < 0 ? index + size : index);
  throw py::index_error(std::string(name) + "[" + std::to_string(index) + "]: " + name + " has " + std::to_string(count) +
                        " entries" + (size > 0 ? ", from -" + std::to_string(size) + " to " + std::to_string(size - 1) : ""));
}

std::string shape_text(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t axis = 0; axis < array.ndim(); ++axis) {
    text += std::to_string(array.shape(axis)) + (axis + 1 < array.ndim() ? ", " : array.ndim() == 1 ? "," : "");
  }
  return text + ")";
}

std::string vector_text(const double* values, int count) {
  std::string text = "(";
  for (int k = 0; k < count; ++k) text += (k > 0 ? ", " : "") + to_text(values[k]);
  return text + ")";
}

py::ssize_t require_rows(const char* name, const py::array& array, const std::vector<py::ssize_t>& tail) {
  bool fits = array.ndim() == static_cast<py::ssize_t>(tail.size()) + 1;
  std::string wanted = "(N";
  for (std::size_t k = 0; k < tail.size(); ++k) {
    fits = fits && array.shape(static_cast<py::ssize_t>(k) + 1) == tail[k];
    wanted += ", " + std::to_string(tail[k]);
  }
  wanted += tail.empty() ? ",)" : ")";
  if (!fits) throw std::invalid_argument(std::string(name) + " has the shape " + shape_text(array) + ", but must have " + wanted);
  return array.shape(0);
}

py::ssize_t require_vectors(const char* name, const py::array& array) {
  if (array.ndim() < 1 || array.shape(array.ndim() - 1) != 3) {
    throw std::invalid_argument(std::string(name) + " has the shape " + shape_text(array) + ", but must have (..., 3)");
  }
  return array.size() / 3;
}

std::vector<py::ssize_t> leading_shape(const py::array& array, const std::vector<py::ssize_t>& tail) {
  std::vector<py::ssize_t> shape(array.shape(), array.shape() + array.ndim() - 1);
  shape.insert(shape.end(), tail.begin(), tail.end());
  return shape;
}

Eigen::Vector3d require_direction(Name name, const Eigen::Vector3d& vector) {
  if (!vector.allFinite()) throw std::invalid_argument(name.text() + " = " + vector_text(vector.data(), 3) + " is not finite");
  const double scale = vector.cwiseAbs().maxCoeff();  // the square of a very long or short vector overflows or underflows
  if (scale == 0) throw std::invalid_argument(name.text() + " = (0, 0, 0), but must have a length");
  return (vector / scale).normalized();
}

Eigen::Vector3d require_place(Name name, const Eigen::Vector3d& point) {
  if (all_within(point, kFarthest)) return point;
  throw std::invalid_argument(name.text() + " = " + vector_text(point.data(), 3) + " m is outside [-" + to_text(kFarthest) + ", " +
                              to_text(kFarthest) + "] m");
}

py::array_t<double> rows_of(std::span<const Eigen::Vector3d> points) {
  py::array_t<double> out({static_cast<py::ssize_t>(points.size()), py::ssize_t{3}});
  double* to = out.mutable_data();
  for (const Eigen::Vector3d& p : points) to = std::ranges::copy(p, to).out;
  return out;
}

}  // namespace supernormal::python
