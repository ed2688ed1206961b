// NumPy arrays of numbers, vectors and matrices.
#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "numbers.hpp"

namespace supernormal::python {

/// The name of an argument or of one entry. The text is only made for a message.
struct Name {
  const char* argument;
  std::ptrdiff_t index = -1;  ///< no entry if negative

  std::string text() const;
};

/// Raises TypeError: `name` is `argument`, but must be what `wanted` says.
[[noreturn]] void refuse_type(const std::string& name, const pybind11::handle& argument, const char* wanted);

/// The place of self[index]; -1 is the last. Raises IndexError, with the name and the range, outside of it.
std::size_t require_index(const char* name, std::ptrdiff_t index, std::size_t count);

/// "(5, 2)"
std::string shape_text(const pybind11::array& array);

/// "(0, nan, 1)"
std::string vector_text(const double* values, int count);

/// Raises ValueError, with the name, unless the array has the dimensions (N, tail...). Returns N.
pybind11::ssize_t require_rows(const char* name, const pybind11::array& array, const std::vector<pybind11::ssize_t>& tail);

/// Raises ValueError unless the last dimension of the array is 3. Returns the number of vectors.
pybind11::ssize_t require_vectors(const char* name, const pybind11::array& array);

/// Returns an array (N, 3).
pybind11::array_t<double> rows_of(std::span<const Eigen::Vector3d> points);

/// The dimensions of an array of vectors, with the last one replaced by `tail`.
std::vector<pybind11::ssize_t> leading_shape(const pybind11::array& array, const std::vector<pybind11::ssize_t>& tail);

inline Eigen::Vector3d vector_at(const double* values) { return {values[0], values[1], values[2]}; }

/// Writes a 3 x 3 matrix in the row-major order of NumPy.
inline void write_matrix(const Eigen::Matrix3d& matrix, double* rows) {
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> map(rows);
  map = matrix;
}

inline Eigen::Matrix3d matrix_at(const double* rows) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows);
}

/// Normalises `vector`, which must be finite and not 0. Otherwise raises ValueError with the name.
Eigen::Vector3d require_direction(Name name, const Eigen::Vector3d& vector);

/// Raises ValueError, with the name and the range, if a coordinate of a point is out of range.
Eigen::Vector3d require_place(Name name, const Eigen::Vector3d& point);

}  // namespace supernormal::python
