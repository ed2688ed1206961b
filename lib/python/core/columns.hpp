// Results of N pairs or rays, as NumPy arrays.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "values.hpp"

namespace supernormal::python {

/// A column of a result, filled in place: an array with the dimensions (count, kTail...).
template <typename Number, pybind11::ssize_t... kTail>
class Column {
 public:
  explicit Column(std::ptrdiff_t count)
      : array_(std::vector<pybind11::ssize_t>{static_cast<pybind11::ssize_t>(count), kTail...}), data_(array_.mutable_data()) {}

  void set(std::ptrdiff_t i, Number value) { data_[i] = value; }

  /// Writes a vector, or a matrix by rows.
  template <typename Derived>
  void set(std::ptrdiff_t i, const Eigen::MatrixBase<Derived>& value) {
    Number* out = data_ + (kTail * ... * 1) * i;
    for (Eigen::Index row = 0; row < value.rows(); ++row) {
      for (Eigen::Index column = 0; column < value.cols(); ++column) *out++ = value(row, column);
    }
  }

  /// The first number of entry i.
  const Number* operator[](std::ptrdiff_t i) const { return array_.data() + (kTail * ... * 1) * i; }

  const pybind11::array_t<Number>& array() const { return array_; }
  void set_all(const pybind11::object& values) {
    array_ = values.cast<pybind11::array_t<Number, pybind11::array::c_style | pybind11::array::forcecast>>();
  }

 private:
  pybind11::array_t<Number> array_;
  Number* data_;
};

/// The results of find_proximities().
struct Proximities {
  explicit Proximities(std::ptrdiff_t pairs) : count(pairs) {}

  void set(std::ptrdiff_t i, const Proximity& result) {
    gap.set(i, result.gap);
    error.set(i, result.error);
    normal.set(i, result.normal);
    point1.set(i, result.point1);
    point2.set(i, result.point2);
    contact.set(i, result.contact);
    evaluations.set(i, result.evaluations);
    status.set(i, static_cast<std::uint8_t>(result.status));
    is_global.set(i, result.is_global);
    global_error.set(i, result.global_error);
  }

  Proximity operator[](std::ptrdiff_t i) const {
    return {*gap[i],
            *error[i],
            vector_at(normal[i]),
            vector_at(point1[i]),
            vector_at(point2[i]),
            vector_at(contact[i]),
            *evaluations[i],
            static_cast<Status>(*status[i]),
            *is_global[i],
            *global_error[i]};
  }

  std::ptrdiff_t count;
  Column<double> gap{count}, error{count};
  Column<double, 3> normal{count}, point1{count}, point2{count}, contact{count};
  Column<int> evaluations{count};
  Column<std::uint8_t> status{count};
  Column<bool> is_global{count};
  Column<double> global_error{count};
};

/// Makes a column of a result an attribute, without a copy.
template <typename Result, typename ColumnType>
void bind_column(pybind11::class_<Result>& type, const char* name, ColumnType Result::*column, const char* doc) {
  type.def_property_readonly(
      name, [column](const Result& self) { return (self.*column).array(); }, doc);
}

/// Binds the copies and __repr__ of a result with these columns. `what` is the plural of an entry.
template <typename Result, typename... Columns>
void bind_columns(pybind11::class_<Result>& type, const char* what, Columns... columns) {
  bind_copies(
      type, [columns...](const Result& self) { return pybind11::make_tuple(self.count, (self.*columns).array()...); },
      [columns...](const pybind11::tuple& of) {
        auto made = std::make_unique<Result>(of[0].cast<std::ptrdiff_t>());
        std::size_t k = 1;
        ((*made.*columns).set_all(of[k++]), ...);
        return made;
      });
  type.def("__repr__", [what](const pybind11::object& self) {
    return pybind11::type::of(self).attr("__name__").cast<std::string>() + "(of " + std::to_string(pybind11::len(self)) + " " +
           what + ")";
  });
}

}  // namespace supernormal::python
