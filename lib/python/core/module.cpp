// The Python module supernormal._core: the core of the library, without ODE.
#include <cstddef>

#include "bindings.hpp"

namespace supernormal::python {
namespace {

// An object without its __init__: of __new__() alone, or used by a subclass's __init__ before that calls super().__init__().
// pybind11 allocates it when a function takes it and leaves it without a value, unless its class allocates by itself.
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
  m.doc() = "Smooth convex bodies: shapes, signed distance, contacts and rays. Import `supernormal`, which has all of it.";
  bind_enums(m);
  bind_poses(m);
  bind_settings(m);
  bind_shapes(m);
  bind_composed_shapes(m);
  bind_shape_sequence(m);
  bind_proximity(m);
  bind_contact(m);
  bind_raycast(m);
  bind_impact(m);
  bind_batch(m);
  refuse_unmade_objects(m);
}
