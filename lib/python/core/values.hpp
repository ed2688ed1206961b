// Value objects: compared, copied, pickled and printed by their constructor arguments.
#pragma once

#include <pybind11/pybind11.h>

#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "numbers.hpp"

namespace supernormal::python {

/// A vector, or a matrix by rows, as tuples. Tuples compare by value.
inline pybind11::tuple plain(const Eigen::Vector3d& v) { return pybind11::make_tuple(v.x(), v.y(), v.z()); }
inline pybind11::tuple plain(const Eigen::Matrix3d& M) {
  const auto row = [&](int i) { return plain(Eigen::Vector3d(M.row(i))); };
  return pybind11::make_tuple(row(0), row(1), row(2));
}

/// "Sphere(radius=1.0)", with the class name of the object.
std::string call_text(const pybind11::handle& self, const std::vector<const char*>& names, const pybind11::tuple& arguments);

/// Longer lists have a text with their length only, which makes no object again. A program prints thousands by mistake.
inline constexpr std::size_t kMostInText = 100;

/// "Poses(of 1000 bodies)", with the class name of the object.
std::string call_text(const pybind11::handle& self, std::size_t count, const char* what);

/// The attributes that a program added to an object of its own subclass. Empty for our classes.
pybind11::dict attributes_of(const pybind11::handle& self);

/// An object in the form for arguments_of() functions: the shared pointer if its class has one, otherwise a reference.
template <typename Class>
decltype(auto) unwrapped(const pybind11::handle& self) {
  using Type = typename Class::type;
  using Pointer = std::shared_ptr<Type>;
  if constexpr (std::is_same_v<typename Class::holder_type, Pointer>) {
    self.cast<const Type&>();  // raises the error for an object without a value
    return self.cast<Pointer>();
  } else {
    return self.cast<const Type&>();
  }
}

/// The function that makes a shared Made from a tuple of arguments with these types.
template <typename Made, typename... Types>
auto constructor() {
  return [](const pybind11::tuple& of) {
    return [&]<std::size_t... k>(std::index_sequence<k...>) { return std::make_shared<Made>(of[k].template cast<Types>()...); }
    (std::index_sequence_for<Types...>{});
  };
}

/// Binds copy.copy(), copy.deepcopy() and pickle. arguments_of(object) returns a tuple of Python objects from which make(tuple)
/// makes the object, or its shared pointer.
template <typename Class, typename ArgumentsOf, typename Make>
void bind_copies(Class& type, const ArgumentsOf& arguments_of, const Make& make) {
  namespace py = pybind11;
  type.def(py::pickle(
      [arguments_of](const py::object& self) { return py::make_tuple(arguments_of(unwrapped<Class>(self)), attributes_of(self)); },
      [make](const py::tuple& state) { return std::pair(make(state[0].cast<py::tuple>()), state[1].cast<py::dict>()); }));
}

/// Binds iter() of a class with __getitem__. Without it type checkers do not take its objects for iterables.
template <typename Class>
void bind_iteration(Class& type) {
  namespace py = pybind11;
  type.def("__iter__", [](const py::object& self) { return py::reinterpret_steal<py::iterator>(PySeqIter_New(self.ptr())); });
}

/// Binds ==. Objects of the same class are equal if their arguments are.
template <typename Class, typename ArgumentsOf>
void bind_equality(Class& type, const ArgumentsOf& arguments_of) {
  namespace py = pybind11;
  type.def(
      "__eq__",
      [arguments_of](const py::object& self, const py::object& other) -> py::object {
        if (!py::type::of(self).is(py::type::of(other))) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
        return py::bool_(arguments_of(unwrapped<Class>(self)).equal(arguments_of(unwrapped<Class>(other))));
      },
      py::arg("other"));
}

/// Binds copies, pickle, == and hash(), for an immutable class.
template <typename Class, typename ArgumentsOf, typename Make>
void bind_value(Class& type, const ArgumentsOf& arguments_of, const Make& make) {
  namespace py = pybind11;
  bind_copies(type, arguments_of, make);
  bind_equality(type, arguments_of);
  type.def("__hash__", [arguments_of](const py::object& self) {
    return py::hash(py::make_tuple(py::type::of(self), arguments_of(unwrapped<Class>(self))));
  });
}

/// The same, plus repr() with the names of the arguments.
template <typename Class, typename ArgumentsOf, typename Make>
void bind_value(Class& type, std::initializer_list<const char*> names, const ArgumentsOf& arguments_of, const Make& make) {
  bind_value(type, arguments_of, make);
  type.def("__repr__", [arguments_of, names = std::vector<const char*>(names)](const pybind11::object& self) {
    return call_text(self, names, arguments_of(unwrapped<Class>(self)));
  });
}

}  // namespace supernormal::python
