// Value objects: compared, copied, pickled and printed by their constructor arguments.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "numbers.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal::python {

/// A vector, or a matrix by rows, as tuples, which compare by value. Anything else as it is.
template <typename Value>
const Value& plain(const Value& value) {
  return value;
}
inline pybind11::tuple plain(const Eigen::Vector3d& v) { return pybind11::make_tuple(v.x(), v.y(), v.z()); }
inline pybind11::tuple plain(const Eigen::Matrix3d& M) {
  const auto row = [&](int i) { return plain(Eigen::Vector3d(M.row(i))); };
  return pybind11::make_tuple(row(0), row(1), row(2));
}

/// "Sphere(radius=1.0)", with the class name of the object.
inline std::string call_text(const pybind11::handle& self, const std::vector<const char*>& names,
                             const pybind11::tuple& arguments) {
  std::string text = pybind11::type::of(self).attr("__name__").cast<std::string>() + "(";
  for (std::size_t k = 0; k < names.size(); ++k) {
    text += std::string(k > 0 ? ", " : "") + names[k] + "=" + pybind11::repr(arguments[k]).cast<std::string>();
  }
  return text + ")";
}

/// Longer lists have a text with their length only, which makes no object again. A program prints thousands by mistake.
inline constexpr std::size_t kMostInText = 100;

/// "Poses(of 1000 bodies)", with the class name of the object.
inline std::string call_text(const pybind11::handle& self, std::size_t count, const char* what) {
  return pybind11::type::of(self).attr("__name__").cast<std::string>() + "(of " + std::to_string(count) + " " + what + ")";
}

/// The attributes that a program added to an object of its own subclass. Empty for our classes.
inline pybind11::dict attributes_of(const pybind11::handle& self) { return pybind11::getattr(self, "__dict__", pybind11::dict()); }

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
void bind_iteration(auto& type) {
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
void bind_value(Class& type, const std::vector<const char*>& names, const ArgumentsOf& arguments_of, const Make& make) {
  bind_value(type, arguments_of, make);
  type.def("__repr__", [arguments_of, names](const pybind11::object& self) {
    return call_text(self, names, arguments_of(unwrapped<Class>(self)));
  });
}

/// An attribute of a value: a member, or a function of the object (of its shared pointer, if its class has one).
template <typename Get>
struct Field {
  const char* name;
  Get get;
  const char* doc;
};
template <typename Get>
Field(const char*, Get, const char*) -> Field<Get>;

/// The type of a field of a class.
template <typename Class, typename Get>
using FieldOf = std::decay_t<std::invoke_result_t<const Get&, decltype(unwrapped<Class>(pybind11::handle()))>>;

/// Binds fields as attributes that cannot be set.
template <typename Class, typename... Gets>
void bind_fields(Class& type, const Field<Gets>&... fields) {
  namespace py = pybind11;
  using Type = typename Class::type;
  const auto bind = [&type]<typename Get>(const Field<Get>& field) {
    const Get get = field.get;
    if constexpr (std::is_invocable_v<Get, const Type&>) {
      type.def_property_readonly(
          field.name, [get](const Type& self) -> FieldOf<Class, Get> { return std::invoke(get, self); }, field.doc);
    } else {
      const py::cpp_function function(
          [get](const py::object& self) -> FieldOf<Class, Get> { return std::invoke(get, unwrapped<Class>(self)); });
      type.def_property_readonly(field.name, function, field.doc);
    }
  };
  (bind(fields), ...);
}

/// The arguments_of() function of an object that these fields make again.
template <typename... Gets>
auto arguments_from(const Field<Gets>&... fields) {
  return [... get = fields.get](const auto& self) { return pybind11::make_tuple(plain(std::invoke(get, self))...); };
}

/// The function that makes an object, or its shared pointer, from a tuple of fields with these types.
template <typename Class, typename... Types>
auto maker() {
  using Type = typename Class::type;
  return [](const pybind11::tuple& of) {
    return [&]<std::size_t... k>(std::index_sequence<k...>) {
      if constexpr (std::is_same_v<typename Class::holder_type, std::shared_ptr<Type>>) {
        return std::make_shared<Type>(of[k].template cast<Types>()...);
      } else {
        return Type{of[k].template cast<Types>()...};
      }
    }
    (std::index_sequence_for<Types...>{});
  };
}

/// Binds the fields of an immutable record, with copies, pickle, == and hash().
template <typename Class, typename... Gets>
void bind_record(Class& type, const Field<Gets>&... fields) {
  bind_fields(type, fields...);
  bind_value(type, arguments_from(fields...), maker<Class, FieldOf<Class, Gets>...>());
}

/// The same, plus repr(), for fields that are the arguments of the constructor. make(tuple of them) makes the object.
template <typename Class, typename Make, typename... Gets>
void bind_arguments(Class& type, const Make& make, const Field<Gets>&... fields) {
  bind_fields(type, fields...);
  bind_value(type, {fields.name...}, arguments_from(fields...), make);
}

/// Binds a shape that its fields make, in the order of its constructor.
template <typename ShapeClass, typename... Gets>
auto bind_shape(pybind11::module_& m, const char* name, const char* doc, const Field<Gets>&... fields) {
  namespace py = pybind11;
  using Class = py::class_<ShapeClass, Shape, std::shared_ptr<ShapeClass>>;
  Class type(m, name, doc);
  type.def(py::init<FieldOf<Class, Gets>...>(), py::arg(fields.name).none(false)...);
  bind_arguments(type, maker<Class, FieldOf<Class, Gets>...>(), fields...);
  return type;
}

}  // namespace supernormal::python
