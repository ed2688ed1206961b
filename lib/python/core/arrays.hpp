// NumPy arrays of numbers, vectors and matrices.
#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

namespace supernormal::python {

/// An argument: whatever NumPy can make an array of doubles of, copied only if it is not one already.
using Doubles = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// The name of an argument, or of an entry of one; the text is only made for a message.
struct Name {
  const char* argument;
  std::ptrdiff_t index = -1;  ///< no entry if negative

  std::string text() const;
};

/// "(5, 2)"
std::string shape_text(const pybind11::array& array);

/// "(0, nan, 1)"
std::string vector_text(const double* values, int count);

/// Refuses (ValueError) an array whose dimensions are not (N, tail...), naming it, and returns N.
pybind11::ssize_t require_rows(const char* name, const pybind11::array& array, const std::vector<pybind11::ssize_t>& tail);

/// Refuses (ValueError) an array whose last dimension is not 3, or that has none, and returns its number of vectors.
pybind11::ssize_t require_vectors(const char* name, const pybind11::array& array);

/// The dimensions of an array of vectors, with the last one replaced by `tail`.
std::vector<pybind11::ssize_t> leading_shape(const pybind11::array& array, const std::vector<pybind11::ssize_t>& tail);

inline Eigen::Vector3d vector_at(const double* values) { return {values[0], values[1], values[2]}; }

/// Writes a 3 x 3 matrix by rows, as NumPy has it.
inline void write_matrix(const Eigen::Matrix3d& matrix, double* rows) {
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> map(rows);
  map = matrix;
}

inline Eigen::Matrix3d matrix_at(const double* rows) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows);
}

/// `vector` (any length but 0, finite) of unit length; ValueError, naming it, if it has none.
Eigen::Vector3d require_direction(Name name, const Eigen::Vector3d& vector);

/// Refuses (ValueError) a point or position with a coordinate that cannot be computed with, naming it and the range.
Eigen::Vector3d require_place(Name name, const Eigen::Vector3d& point);

}  // namespace supernormal::python
