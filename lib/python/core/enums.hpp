// Solver, Status and ImpactStatus are IntEnums in Python, so they compare with integers in NumPy arrays. Include this file wherever
// one of them is passed.
#pragma once

#include <pybind11/pybind11.h>

#include "supernormal/impact/time_of_impact.hpp"
#include "supernormal/proximity/proximity.hpp"

namespace supernormal::python {

/// The member with this value of the IntEnum `name` of supernormal._core. Raises ValueError if there is none.
pybind11::object enum_member(const char* name, int value);

template <typename Enum>
struct EnumName;
template <>
struct EnumName<Solver> {
  static constexpr auto kName = pybind11::detail::const_name("Solver");
};
template <>
struct EnumName<Status> {
  static constexpr auto kName = pybind11::detail::const_name("Status");
};
template <>
struct EnumName<ImpactStatus> {
  static constexpr auto kName = pybind11::detail::const_name("ImpactStatus");
};

}  // namespace supernormal::python

namespace pybind11::detail {

/// Converts between a C++ enum and the IntEnum of the same name.
template <typename Enum>
struct IntEnumCaster {
  using Names = supernormal::python::EnumName<Enum>;
  PYBIND11_TYPE_CASTER(Enum, const_name("supernormal._core.") + Names::kName);

  bool load(handle source, bool) {
    if (!PyLong_Check(source.ptr())) return false;
    value = static_cast<Enum>(int_(supernormal::python::enum_member(Names::kName.text, source.cast<int>())).template cast<int>());
    return true;
  }

  static handle cast(Enum value, return_value_policy, handle) {
    return supernormal::python::enum_member(Names::kName.text, static_cast<int>(value)).release();
  }
};

template <>
struct type_caster<supernormal::Solver> : IntEnumCaster<supernormal::Solver> {};
template <>
struct type_caster<supernormal::Status> : IntEnumCaster<supernormal::Status> {};
template <>
struct type_caster<supernormal::ImpactStatus> : IntEnumCaster<supernormal::ImpactStatus> {};

}  // namespace pybind11::detail
