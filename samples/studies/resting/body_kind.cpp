#include "body_kind.hpp"

#include <supernormal/supernormal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace resting {
namespace {

constexpr double kDensity = 1000;   // kg/m^3
constexpr double kRounding = 0.25;  // radius of the rounded edges, half-heights
constexpr double kTaper = 0.3;

using HalfAxes = std::array<double, 3>;

/// m; half-extents in the body's frame, whose z axis is the axis of the round section.
HalfAxes half_axes_of(BodyKind kind, double h) {
  switch (kind) {
    case BodyKind::Brick:
    case BodyKind::RoundedBrick:
    case BodyKind::UserBrick:
      return {2 * h, 1.4 * h, h};
    case BodyKind::Coin:
      return {2 * h, 2 * h, h};
    case BodyKind::Can:
      return {h, h, 5 * h};
    case BodyKind::ShortCan:
      return {h, h, h};
    case BodyKind::Pillow:
      return {h, 3 * h, h};
    case BodyKind::RoundedCan:
    case BodyKind::Cone:
    case BodyKind::UserCylinder:
      return {h, h, 3 * h};
  }
  return {};
}

bool is_box(BodyKind kind) { return kind == BodyKind::Brick || kind == BodyKind::RoundedBrick || kind == BodyKind::UserBrick; }

/// m; half of the straight length.
double length_of(BodyKind kind, const HalfAxes& a) { return kind == BodyKind::Pillow ? a[1] : a[2]; }

/// A user-defined box and cylinder. Their functions get the half-axes as user data.
dReal box_support(const void* user, const dReal n[3]) {
  const auto& a = *static_cast<const std::array<dReal, 3>*>(user);
  return a[0] * std::abs(n[0]) + a[1] * std::abs(n[1]) + a[2] * std::abs(n[2]);
}

void box_point(const void* user, const dReal n[3], dReal point[3]) {
  const auto& a = *static_cast<const std::array<dReal, 3>*>(user);
  for (std::size_t k = 0; k < 3; ++k) point[k] = std::copysign(a[k], n[k]);
}

dReal cylinder_support(const void* user, const dReal n[3]) {
  const auto& a = *static_cast<const std::array<dReal, 3>*>(user);
  return a[0] * std::hypot(n[0], n[1]) + a[2] * std::abs(n[2]);
}

void cylinder_point(const void* user, const dReal n[3], dReal point[3]) {
  const auto& a = *static_cast<const std::array<dReal, 3>*>(user);
  const dReal across = std::hypot(n[0], n[1]);
  for (std::size_t k = 0; k < 2; ++k) point[k] = across > 0 ? a[0] * n[k] / across : 0;
  point[2] = std::copysign(a[2], n[2]);
}

void release_half_axes(void* user) { delete static_cast<std::array<dReal, 3>*>(user); }

dGeomID create_user_shape(dSpaceID space, BodyKind kind, const HalfAxes& a) {
  auto* const half_axes = new std::array<dReal, 3>{static_cast<dReal>(a[0]), static_cast<dReal>(a[1]), static_cast<dReal>(a[2])};
  const bool is_brick = kind == BodyKind::UserBrick;
  const snShape shape{is_brick ? box_support : cylinder_support, is_brick ? box_point : cylinder_point, nullptr, half_axes,
                      release_half_axes};
  return snCreateConvex(space, &shape);
}

/// The half-axes without the rounding.
dGeomID create_rounded(dSpaceID space, const HalfAxes& a, double delta, double epsilon, double rounding) {
  const auto less = [&](double length) { return static_cast<dReal>(length - rounding); };
  const dGeomID geom =
      snCreateSuperellipsoid(space, less(a[0]), less(a[1]), less(a[2]), static_cast<dReal>(delta), static_cast<dReal>(epsilon));
  if (geom == nullptr || (rounding > 0 && snGeomSetRounding(geom, static_cast<dReal>(rounding)) == 0)) {
    throw std::runtime_error(snLastError());
  }
  return geom;
}

dGeomID create_geom(dSpaceID space, BodyKind kind, double e, double h) {
  const HalfAxes a = half_axes_of(kind, h);
  switch (kind) {
    case BodyKind::Brick:
      return create_rounded(space, a, e, e, 0);
    case BodyKind::RoundedBrick:
      return create_rounded(space, a, e, e, kRounding * h);
    case BodyKind::Coin:
    case BodyKind::Can:
    case BodyKind::ShortCan:
      return create_rounded(space, a, 2, e, 0);
    case BodyKind::Pillow:
      return create_rounded(space, a, e, 2, 0);
    case BodyKind::RoundedCan:
      return create_rounded(space, a, 2, e, kRounding * h);
    case BodyKind::Cone:
      return snCreateSuperovoid(space, static_cast<dReal>(a[0]), static_cast<dReal>(a[1]), static_cast<dReal>(a[2]), 2,
                                static_cast<dReal>(e), static_cast<dReal>(kTaper), static_cast<dReal>(kTaper));
    case BodyKind::UserBrick:
    case BodyKind::UserCylinder:
      return create_user_shape(space, kind, a);
  }
  return nullptr;
}

void set_mass_of_counterpart(BodyKind kind, double h, dMass& mass) {
  const HalfAxes a = half_axes_of(kind, h);
  const auto density = static_cast<dReal>(kDensity);
  if (is_box(kind)) {
    dMassSetBox(&mass, density, static_cast<dReal>(2 * a[0]), static_cast<dReal>(2 * a[1]), static_cast<dReal>(2 * a[2]));
  } else {
    dMassSetCylinder(&mass, density, 3, static_cast<dReal>(a[0]), static_cast<dReal>(2 * length_of(kind, a)));
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

const std::vector<NamedKind>& body_kinds() {
  static const std::vector<NamedKind> kinds = {{"brick", BodyKind::Brick},
                                               {"rounded_brick", BodyKind::RoundedBrick},
                                               {"coin", BodyKind::Coin},
                                               {"can", BodyKind::Can},
                                               {"short_can", BodyKind::ShortCan},
                                               {"pillow", BodyKind::Pillow},
                                               {"rounded_can", BodyKind::RoundedCan},
                                               {"cone", BodyKind::Cone},
                                               {"user_brick", BodyKind::UserBrick},
                                               {"user_cylinder", BodyKind::UserCylinder}};
  return kinds;
}

bool lies_on_its_side(BodyKind kind) { return !is_box(kind) && kind != BodyKind::Coin; }

bool has_exponent(BodyKind kind) { return kind != BodyKind::UserBrick && kind != BodyKind::UserCylinder; }

dGeomID create_body(dSpaceID space, BodyKind kind, double exponent, double half_height, dMass& mass) {
  const dGeomID geom = create_geom(space, kind, exponent, half_height);
  if (geom == nullptr) throw std::runtime_error(snLastError());
  // The integrals over the normals miss the volume behind sharp faces, and the centre of mass of a cone is not at its origin.
  const bool is_counterparts = !has_exponent(kind) || kind == BodyKind::Cone;
  if (is_counterparts) {
    set_mass_of_counterpart(kind, half_height, mass);
  } else if (snMassSet(&mass, static_cast<dReal>(kDensity), geom) == 0) {
    throw std::runtime_error(snLastError());
  }
  return geom;
}

dGeomID create_counterpart(dSpaceID space, BodyKind kind, double half_height, dMass& mass) {
  const HalfAxes a = half_axes_of(kind, half_height);
  set_mass_of_counterpart(kind, half_height, mass);
  if (is_box(kind)) {
    return dCreateBox(space, static_cast<dReal>(2 * a[0]), static_cast<dReal>(2 * a[1]), static_cast<dReal>(2 * a[2]));
  }
  return dCreateCylinder(space, static_cast<dReal>(a[0]), static_cast<dReal>(2 * length_of(kind, a)));
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
