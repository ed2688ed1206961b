// The Python module supernormal._core: the core of the library, without ODE.
#include "bindings.hpp"

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
  bind_batch(m);
}
