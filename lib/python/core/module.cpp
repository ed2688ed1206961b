// The Python module supernormal._core: the core of the library, without ODE.
#include <cstddef>

#include "bindings.hpp"

namespace supernormal::python {
namespace {

// An object is unmade before its __init__: after __new__() alone, or in a subclass's __init__ before super().__init__(). When a
// function takes it, pybind11 allocates it without constructing a value, unless its class has its own allocator.
void* refuse_unmade_object(std::size_t /*size*/) {
  throw pybind11::type_error("an object is used before its __init__() was called; a subclass calls super().__init__() first");
}

void refuse_unmade_objects(const pybind11::module_& m) {
  for (const auto& [name, value] : m.attr("__dict__").cast<pybind11::dict>()) {
    if (!PyType_Check(value.ptr())) continue;
    auto* const bound = pybind11::detail::get_type_info(reinterpret_cast<PyTypeObject*>(value.ptr()));
    if (bound != nullptr) bound->operator_new = &refuse_unmade_object;
  }
}

}  // namespace
}  // namespace supernormal::python

PYBIND11_MODULE(_core, m) {
  using namespace supernormal::python;
  m.doc() =
      "Smooth convex bodies: shapes, signed distance, contacts and rays. Import `supernormal` instead; it exports everything.";
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
  bind_batch(m);
  bind_derivatives(m);
  refuse_unmade_objects(m);
}
