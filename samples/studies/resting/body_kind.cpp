#include "body_kind.hpp"

#include <supernormal/supernormal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace resting {
namespace {

constexpr dReal kDensity = 1000;  // kg/m^3

using HalfAxes = std::array<dReal, 3>;

/// m.
HalfAxes half_axes_of(const BodyKind& kind, double half_height) {
  HalfAxes a;
  std::ranges::transform(kind.half_axes, a.begin(), [&](double length) { return static_cast<dReal>(half_height * length); });
  return a;
}

/// m; half of the straight length. A pillow, whose section alone has the exponent, is straight along y.
dReal length_of(const BodyKind& kind, const HalfAxes& a) { return kind.has_delta ? a[1] : a[2]; }

/// A user-defined box and cylinder. Their functions get the half-axes as user data.
dReal box_support(const void* user, const dReal n[3]) {
  const auto& a = *static_cast<const HalfAxes*>(user);
  return a[0] * std::abs(n[0]) + a[1] * std::abs(n[1]) + a[2] * std::abs(n[2]);
}

void box_point(const void* user, const dReal n[3], dReal point[3]) {
  const auto& a = *static_cast<const HalfAxes*>(user);
  for (std::size_t k = 0; k < 3; ++k) point[k] = std::copysign(a[k], n[k]);
}

dReal cylinder_support(const void* user, const dReal n[3]) {
  const auto& a = *static_cast<const HalfAxes*>(user);
  return a[0] * std::hypot(n[0], n[1]) + a[2] * std::abs(n[2]);
}

void cylinder_point(const void* user, const dReal n[3], dReal point[3]) {
  const auto& a = *static_cast<const HalfAxes*>(user);
  const dReal across = std::hypot(n[0], n[1]);
  for (std::size_t k = 0; k < 2; ++k) point[k] = across > 0 ? a[0] * n[k] / across : 0;
  point[2] = std::copysign(a[2], n[2]);
}

void release_half_axes(void* user) { delete static_cast<HalfAxes*>(user); }

dGeomID create_user_shape(dSpaceID space, bool is_box, const HalfAxes& a) {
  const snShape shape{is_box ? box_support : cylinder_support, is_box ? box_point : cylinder_point, nullptr, new HalfAxes(a),
                      release_half_axes};
  return snCreateConvex(space, &shape);
}

dGeomID create_geom(dSpaceID space, const BodyKind& kind, double exponent, double half_height) {
  const HalfAxes a = half_axes_of(kind, half_height);
  if (!kind.has_exponent()) return create_user_shape(space, kind.is_box, a);
  const auto delta = static_cast<dReal>(kind.has_delta ? exponent : 2),
             epsilon = static_cast<dReal>(kind.has_epsilon ? exponent : 2);
  const auto taper = static_cast<dReal>(kind.taper), r = static_cast<dReal>(kind.rounding * half_height);
  if (taper != 0) return snCreateSuperovoid(space, a[0], a[1], a[2], delta, epsilon, taper, taper);
  const dGeomID geom = snCreateSuperellipsoid(space, a[0] - r, a[1] - r, a[2] - r, delta, epsilon);
  return geom != nullptr && r > 0 && snGeomSetRounding(geom, r) == 0 ? nullptr : geom;
}

void set_mass_of_counterpart(const BodyKind& kind, double half_height, dMass& mass) {
  const HalfAxes a = half_axes_of(kind, half_height);
  if (kind.is_box) {
    dMassSetBox(&mass, kDensity, 2 * a[0], 2 * a[1], 2 * a[2]);
  } else {
    dMassSetCylinder(&mass, kDensity, 3, a[0], 2 * length_of(kind, a));
  }
}

double lowest_of_box(dGeomID geom, const dReal* rotation) {
  dVector3 lengths;
  dGeomBoxGetLengths(geom, lengths);
  double extent = 0;
  for (int k = 0; k < 3; ++k) extent += 0.5 * std::abs(double{rotation[8 + k] * lengths[k]});
  return -extent;
}

double lowest_of_cylinder(dGeomID geom, const dReal* rotation) {
  dReal radius = 0;
  dReal length = 0;
  dGeomCylinderGetParams(geom, &radius, &length);
  const double along = std::abs(double{rotation[10]});
  return -(0.5 * double{length} * along + double{radius} * std::sqrt(std::max(0.0, 1 - along * along)));
}

}  // namespace

const std::vector<BodyKind>& body_kinds() {
  static const std::vector<BodyKind> kinds = {
      {"brick", true, {2, 1.4, 1}, true, true},
      {"rounded_brick", true, {2, 1.4, 1}, true, true, 0.25},
      {"coin", false, {2, 2, 1}, false, true},
      {"can", false, {1, 1, 5}, false, true},
      {"short_can", false, {1, 1, 1}, false, true},
      {"pillow", false, {1, 3, 1}, true, false},
      {"rounded_can", false, {1, 1, 3}, false, true, 0.25},
      {"cone", false, {1, 1, 3}, false, true, 0, 0.3},
      {"user_brick", true, {2, 1.4, 1}},
      {"user_cylinder", false, {1, 1, 3}},
  };
  return kinds;
}

dGeomID create_body(dSpaceID space, const BodyKind& kind, double exponent, double half_height, dMass& mass) {
  const dGeomID geom = create_geom(space, kind, exponent, half_height);
  // The integrals over the normals miss the volume behind sharp faces, and the centre of mass of a cone is not at its origin.
  const bool is_counterparts = !kind.has_exponent() || kind.taper != 0;
  if (is_counterparts) set_mass_of_counterpart(kind, half_height, mass);
  if (geom == nullptr || (!is_counterparts && snMassSet(&mass, kDensity, geom) == 0)) throw std::runtime_error(snLastError());
  return geom;
}

dGeomID create_counterpart(dSpaceID space, const BodyKind& kind, double half_height, dMass& mass) {
  const HalfAxes a = half_axes_of(kind, half_height);
  set_mass_of_counterpart(kind, half_height, mass);
  return kind.is_box ? dCreateBox(space, 2 * a[0], 2 * a[1], 2 * a[2]) : dCreateCylinder(space, a[0], 2 * length_of(kind, a));
}

double lowest_point(dGeomID geom) {
  const double height{dGeomGetPosition(geom)[2]};
  const dReal* const rotation = dGeomGetRotation(geom);
  switch (dGeomGetClass(geom)) {
    case dBoxClass:
      return height + lowest_of_box(geom, rotation);
    case dCylinderClass:
      return height + lowest_of_cylinder(geom, rotation);
    default: {
      const dVector3 down = {0, 0, -1};
      dVector3 point;
      if (snGeomSupport(geom, down, point) == 0) throw std::runtime_error(snLastError());
      return double{point[2]};
    }
  }
}

}  // namespace resting
