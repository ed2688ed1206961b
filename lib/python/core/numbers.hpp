// Conversions between numbers of Python and of Eigen.
#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <cstring>
#include <vector>

namespace supernormal::python {

/// Any argument that NumPy can convert to an array of doubles. It is copied only if it is not such an array.
class Doubles : public pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast> {
 public:
  using array_t::array_t;
  Doubles() : array_t(pybind11::handle(), stolen_t{}) {}

  /// Empty unless `source` has real numbers. NumPy would drop the imaginary parts of complex ones, and would read texts.
  static Doubles of(const pybind11::handle& source) {
    const auto array = pybind11::array::ensure(source);
    if (!array || std::strchr("biufO", array.dtype().kind()) == nullptr) return {};
    const auto doubles = array_t::ensure(array);
    return doubles ? Doubles(doubles) : Doubles();
  }
};

}  // namespace supernormal::python

namespace pybind11::detail {

template <>
struct type_caster<supernormal::python::Doubles> {
  PYBIND11_TYPE_CASTER(supernormal::python::Doubles, const_name("numpy.ndarray"));

  bool load(handle source, bool) {
    value = supernormal::python::Doubles::of(source);
    return static_cast<bool>(value);
  }
};

/// Vectors and matrices of a fixed size. pybind11/eigen.h takes complex numbers and texts, too.
template <int kRows, int kColumns>
struct type_caster<Eigen::Matrix<double, kRows, kColumns>> {
  using Matrix = Eigen::Matrix<double, kRows, kColumns>;
  PYBIND11_TYPE_CASTER(Matrix, const_name("numpy.ndarray[") + const_name<kRows>() +
                                   const_name<kColumns == 1>(const_name(""), const_name(", ") + const_name<kColumns>()) +
                                   const_name("]"));

  bool load(handle source, bool) {
    const auto numbers = supernormal::python::Doubles::of(source);
    if (!numbers || numbers.size() != kRows * kColumns || numbers.shape(0) != kRows || numbers.ndim() > 2) return false;
    if (kColumns > 1 && numbers.ndim() != 2) return false;
    for (int k = 0; k < kRows * kColumns; ++k) value(k / kColumns, k % kColumns) = numbers.data()[k];
    return true;
  }

  static handle cast(const Matrix& source, return_value_policy, handle) {
    auto shape = std::vector<ssize_t>{kRows};
    if (kColumns > 1) shape.push_back(kColumns);
    array_t<double> out(shape);
    for (int k = 0; k < kRows * kColumns; ++k) out.mutable_data()[k] = source(k / kColumns, k % kColumns);
    return out.release();
  }
};

}  // namespace pybind11::detail
