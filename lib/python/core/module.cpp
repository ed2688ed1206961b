// The Python module supernormal._core: the core of the library, without ODE.
#include <algorithm>
#include <cstddef>

#include "bindings.hpp"
#include "supernormal/python/argument_errors.hpp"

namespace supernormal::python {
namespace {

// An object is unmade before its __init__: after __new__() alone, or in a subclass's __init__ before super().__init__(). When a
// function takes it, pybind11 allocates it without constructing a value, unless its class has its own allocator.
void* refuse_unmade_object(std::size_t /*size*/) {
  throw pybind11::type_error("an object is used before its __init__() was called; a subclass calls super().__init__() first");
}

// Protocols 0 and 1 of pickle make an object of pybind11's base class, which ends the interpreter. Their files can hold what
// protocol 2 asks for.
pybind11::object reduce(const pybind11::object& self, int protocol) {
  return pybind11::module_::import("builtins").attr("object").attr("__reduce_ex__")(self, std::max(protocol, 2));
}

void guard_classes(const pybind11::module_& m) {
  namespace py = pybind11;
  for (const auto& [name, value] : m.attr("__dict__").cast<py::dict>()) {
    if (!PyType_Check(value.ptr())) continue;
    auto* const bound = py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(value.ptr()));
    if (bound == nullptr) continue;
    bound->operator_new = &refuse_unmade_object;
    value.attr("__reduce_ex__") = py::cpp_function(&reduce, py::name("__reduce_ex__"), py::is_method(value), py::arg("protocol"));
  }
}

}  // namespace
}  // namespace supernormal::python

PYBIND11_MODULE(_core, m) {
  using namespace supernormal::python;
  m.doc() =
      "Smooth convex bodies: shapes, signed distance, contacts and rays. Import `supernormal` instead; it exports everything.";
  m.attr("__version__") = SUPERNORMAL_PYTHON_VERSION;
  bind_enums(m);
  bind_poses(m);
  bind_settings(m);
  bind_shapes(m);
  bind_composed_shapes(m);
  bind_shape_sequence(m);
  bind_descriptions(m);
  bind_proximity(m);
  bind_contact(m);
  bind_raycast(m);
  bind_impact(m);
  bind_derivatives(m);
  guard_classes(m);
  guard(m);
}
