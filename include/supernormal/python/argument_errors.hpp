// What users of an extension module meet first: arguments that do not fit, and arrays that are copies.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string>

namespace supernormal::python {

/// pybind11's entry of all functions of a module.
inline PyCFunctionWithKeywords dispatcher = nullptr;

/// Calls a function of pybind11. Its message about arguments that do not fit lists C++ types. `supernormal._arguments` names the
/// argument, its value and what it must be instead.
inline PyObject* call_and_explain(PyObject* self, PyObject* arguments, PyObject* keywords) {
  namespace py = pybind11;
  PyObject* const result = dispatcher(self, arguments, keywords);
  if (result != nullptr || PyErr_ExceptionMatches(PyExc_TypeError) == 0) return result;
  py::error_already_set raised;
  try {
    const py::object given = keywords != nullptr ? py::reinterpret_borrow<py::object>(keywords) : py::dict();
    const py::object text =
        py::module_::import("supernormal._arguments").attr("explain")(raised.value(), py::handle(arguments), given);
    PyErr_SetObject(PyExc_TypeError, text.ptr());
  } catch (const py::error_already_set&) {  // such as Ctrl-C
    raised.restore();
  }
  return nullptr;
}

inline void explain_arguments(const pybind11::handle& member) {
  const pybind11::handle function = pybind11::detail::get_function(member);  // of a method
  if (!function || PyCFunction_Check(function.ptr()) == 0) return;
  PyMethodDef* const method = reinterpret_cast<PyCFunctionObject*>(function.ptr())->m_ml;
  const auto entry = reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(dispatcher));
  // Others, such as __new__, share their method with all classes.
  if (method->ml_meth == entry) method->ml_meth = reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(&call_and_explain));
}

/// Makes the array that a property returns read-only: it may be a copy, and what is written to a copy is lost.
inline void protect_array(const pybind11::handle& type, const pybind11::str& name, const pybind11::handle& property) {
  namespace py = pybind11;
  const py::object get = property.attr("fget"), text = property.attr("__doc__"), signature = get.attr("__doc__");
  if (!property.attr("fset").is_none() || signature.is_none() || signature.cast<std::string>().find("ndarray") == std::string::npos)
    return;
  const py::cpp_function protected_get([get](const py::object& self) {
    py::object value = get(self);
    if (py::isinstance<py::array>(value)) py::detail::array_proxy(value.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return value;
  });
  type.attr(name) = py::module_::import("builtins").attr("property")(protected_get, py::none(), py::none(), text);
}

/// Gives the functions of a module messages for users, and makes the arrays of its classes read-only. Called once all is bound.
inline void guard(const pybind11::module_& m) {
  namespace py = pybind11;
  const py::cpp_function any([] {});
  dispatcher = reinterpret_cast<PyCFunctionWithKeywords>(reinterpret_cast<void (*)()>(PyCFunction_GET_FUNCTION(any.ptr())));
  const auto members_of = [](const py::handle& owner) { return py::dict(owner.attr("__dict__")); };
  for (const auto& [name, value] : members_of(m)) {
    explain_arguments(value);
    if (PyType_Check(value.ptr()) == 0 || py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(value.ptr())) == nullptr)
      continue;
    for (const auto& [key, member] : members_of(value)) {
      explain_arguments(py::getattr(value, key));
      if (!py::isinstance(member, py::module_::import("builtins").attr("property"))) continue;
      explain_arguments(member.attr("fget"));
      explain_arguments(member.attr("fset"));
      protect_array(value, py::reinterpret_borrow<py::str>(key), member);
    }
  }
}

}  // namespace supernormal::python
