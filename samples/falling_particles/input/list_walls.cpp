#include "list_walls.hpp"

namespace falling_particles {

std::string list_walls() {
  return R"([[part]]
  parameters  name: letters, digits, _ - and .
              position: m, each in [-1000, 1000]; the origin without it
              axis, angle: the orientation, a rotation by angle degrees in [-360, 360] about axis; none without them
              friction: in (0, 100], of grains on this part; as for walls without it
              restitution: in (0, 1], of grains on this part; as for walls without it
  cost        its contacts; a part that moves has a body more
[[part]] shape = "plane"
  is          the half-space below its xy-plane
[[part]] shape = "box"
  parameters  size: m, three lengths in (0, 1000], around position
[[part]] shape = "cylinder"
  parameters  radius, length: m, in (0, 1000]; along its z-axis, around position
[[part]] shape = "ellipsoid"
  parameters  half_axes: m, three in (0, 1000]
[[part]] shape = "superellipsoid"
  parameters  half_axes; delta, epsilon: exponents of the xy-section and along z, in [1.01, 1000]
[[part]] shape = "superovoid"
  parameters  half_axes, delta, epsilon; taper: along x and y, in [-1, 1], as long as it is convex
[[part]] shape = "mesh"
  parameters  file: an STL or OBJ file, its path relative to the scene file; unit: m, cm, mm or inch
              two_sided: true or false, whether it holds grains on both sides; false without it: what is behind a triangle is solid
[[part.motion]] kind = "velocity"
  parameters  velocity: m/s, each in [-1000, 1000]
              from, until: s, of this and every other kind of motion; the whole run without them
[[part.motion]] kind = "rotation"
  parameters  axis; point: m; rpm: revolutions a minute, anticlockwise as seen from the tip of axis, up to a tenth of one in a step
[[part.motion]] kind = "vibration"
  parameters  direction; amplitude: m, in (0, 1000]; frequency: Hz, at least ten steps a period; phase: degrees, 0 without it
[[part.motion]] kind = "conveyor"
  parameters  velocity: m/s, or axis, point, rpm: of the surface of a part that stands
[part.drive]
  parameters  axis: along which it pushes, and the only way it can go
              force: N, in [-1e9, 1e9]; or pressure: Pa, and area: m^2, that of the part's shape without it
              mass: kg, in [1e-12, 1e6]; damping: N s/m, in [0, 1e9], 0 without it
              from, until: s; it is held before, and only its weight is left after; travel: m, least and most way along axis
)";
}

}  // namespace falling_particles
