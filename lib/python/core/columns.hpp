// Results of N pairs or rays, as NumPy arrays.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
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

  template <typename Value>
  requires std::is_scalar_v<Value>
  void set(std::ptrdiff_t i, Value value) { data_[i] = static_cast<Number>(value); }

  /// Writes a vector, or a matrix by rows.
  template <typename Derived>
  void set(std::ptrdiff_t i, const Eigen::MatrixBase<Derived>& value) {
    Number* out = data_ + (kTail * ... * 1) * i;
    for (Eigen::Index row = 0; row < value.rows(); ++row) {
      for (Eigen::Index column = 0; column < value.cols(); ++column) *out++ = value(row, column);
    }
  }

  /// Entry i, as the field has it: a number, or a vector.
  template <typename Value>
  Value at(std::ptrdiff_t i) const {
    if constexpr (sizeof...(kTail) == 0) {
      return static_cast<Value>(array_.data()[i]);
    } else {
      return vector_at(array_.data() + (kTail * ... * 1) * i);
    }
  }

  const pybind11::array_t<Number>& array() const { return array_; }
  void set_all(const pybind11::object& values) {
    array_ = values.cast<pybind11::array_t<Number, pybind11::array::c_style | pybind11::array::forcecast>>();
  }

 private:
  pybind11::array_t<Number> array_;
  Number* data_;
};

/// The column of a field: statuses are numbers of 8 bits.
template <typename Value>
struct ColumnFor {
  using Type = Column<std::conditional_t<std::is_enum_v<Value>, std::uint8_t, Value>>;
};
template <int kRows, int kOptions>
struct ColumnFor<Eigen::Matrix<double, kRows, 1, kOptions>> {
  using Type = Column<double, kRows>;
};
template <int kRows, int kColumns, int kOptions>
struct ColumnFor<Eigen::Matrix<double, kRows, kColumns, kOptions>> {
  using Type = Column<double, kRows, kColumns>;
};

/// N values, as a column for each of their fields, a tuple of Field.
template <typename Value, const auto& kFields>
class Table {
 public:
  /// A column that is left out has no entries, and its attribute is None.
  explicit Table(std::ptrdiff_t count, const std::vector<std::string_view>& left_out = {})
      : count_(count),
        columns_(std::apply(
            [&](const auto&... field) { return Columns(std::ranges::count(left_out, field.name) > 0 ? 0 : count...); }, kFields)) {}

  std::ptrdiff_t count() const { return count_; }

  void set(std::ptrdiff_t i, const Value& value) {
    each([&](auto& column, const auto& field) {
      if (column.array().size() > 0) column.set(i, std::invoke(field.get, value));
    });
  }

  /// Entry i, if its fields are all there is to a value.
  Value operator[](std::ptrdiff_t i) const {
    return [&]<std::size_t... k>(std::index_sequence<k...>) {
      return Value{std::get<k>(columns_).template at<std::decay_t<decltype(std::invoke(std::get<k>(kFields).get, Value()))>>(i)...};
    }
    (kIndices);
  }

  /// Binds the columns as attributes, without a copy; and len(), copies and repr(). `what` is the plural of an entry.
  static void bind(pybind11::class_<Table>& type, const char* what) {
    namespace py = pybind11;
    type.def("__len__", &Table::count);
    [&]<std::size_t... k>(std::index_sequence<k...>) {
      const auto column = [&]<std::size_t kIndex>(std::integral_constant<std::size_t, kIndex>) {
        type.def_property_readonly(
            std::get<kIndex>(kFields).name,
            [](const Table& self) {
              const auto& array = std::get<kIndex>(self.columns_).array();
              return array.shape(0) == self.count_ ? std::optional(array) : std::nullopt;
            },
            std::get<kIndex>(kFields).doc);
      };
      (column(std::integral_constant<std::size_t, k>()), ...);
      bind_copies(
          type, [](const Table& self) { return py::make_tuple(self.count_, std::get<k>(self.columns_).array()...); },
          [](const py::tuple& of) {
            auto made = std::make_unique<Table>(of[0].cast<std::ptrdiff_t>());
            (std::get<k>(made->columns_).set_all(of[k + 1]), ...);
            return made;
          });
    }
    (kIndices);
    type.def("__repr__", [what](const py::object& self) { return call_text(self, py::len(self), what); });
  }

 private:
  template <typename Fields>
  struct ColumnsOf;
  template <typename... Gets>
  struct ColumnsOf<std::tuple<Field<Gets>...>> {
    using Type = std::tuple<typename ColumnFor<std::decay_t<std::invoke_result_t<const Gets&, const Value&>>>::Type...>;
    static constexpr std::index_sequence_for<Gets...> kIndices{};
  };
  using Fields = std::remove_cvref_t<decltype(kFields)>;
  using Columns = typename ColumnsOf<Fields>::Type;
  static constexpr auto kIndices = ColumnsOf<Fields>::kIndices;

  void each(const auto& visit) {
    [&]<std::size_t... k>(std::index_sequence<k...>) { (visit(std::get<k>(columns_), std::get<k>(kFields)), ...); }
    (kIndices);
  }

  std::ptrdiff_t count_;
  Columns columns_;
};

inline constexpr std::tuple kProximityFields{
    Field{"gap", &Proximity::gap, "(N,), m; signed distance: minus the penetration depth if negative"},
    Field{"error", &Proximity::error, "(N,), m; estimated error of the gap; an upper bound if is_global"},
    Field{"normal", &Proximity::normal, "(N, 3), unit, from body 1 to body 2"},
    Field{"point1", &Proximity::point1, "(N, 3), m; on the boundary of body 1"},
    Field{"point2", &Proximity::point2, "(N, 3), m; on the boundary of body 2"},
    Field{"contact", &Proximity::contact, "(N, 3), m; where a contact force acts"},
    Field{"evaluations", &Proximity::evaluations, "(N,) of int32; evaluations of the gap function"},
    Field{"status", &Proximity::status, "(N,) of uint8; compare with members of Status"},
    Field{"is_global", &Proximity::is_global, "(N,) of bool; whether the gap is the proved global maximum"},
    Field{"global_error", &Proximity::global_error, "(N,), m; proved upper bound of the global maximum minus the gap"}};

/// The results of find_proximities().
using Proximities = Table<Proximity, kProximityFields>;

}  // namespace supernormal::python
