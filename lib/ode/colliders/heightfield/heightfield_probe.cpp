#include "ode/colliders/heightfield/heightfield_probe.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/thread_kept.hpp"
#include "ode/geom/convert.hpp"
#include "ode/support/private_geom.hpp"

namespace supernormal::ode {
namespace {

// Longer than any ray needs to be, and finite, because ODE would multiply infinity by zero.
constexpr double kRayLength = 1e18;

constexpr int kMaxListed = 2048;

// A height is the start of the ray minus the distance to the surface. A start more than this many scales above the surface loses
// digits.
constexpr double kNear = 16;

}  // namespace

HeightfieldProbe& HeightfieldProbe::looking_at(dGeomID heightfield) {
  thread_local ThreadKept<HeightfieldProbe> kept;
  HeightfieldProbe& probe = *kept;
  probe.data_ = dGeomHeightfieldGetHeightfieldData(heightfield);
  dGeomHeightfieldSetHeightfieldData(probe.heightfield_, probe.data_);
  // The bounding box is a new geom's, because the samples may be others than last time, and only a placeable geom can be told that
  // it has changed (geom/bounding_box.hpp).
  const dGeomID fresh = dCreateHeightfield(nullptr, probe.data_, 0);
  std::array<dReal, 6> aabb{};
  dGeomGetAABB(fresh, aabb.data());
  dGeomDestroy(fresh);
  probe.half_width_ = double{aabb[1]};
  probe.half_depth_ = double{aabb[5]};
  probe.max_height_ = double{aabb[3]};
  return probe;
}

HeightfieldProbe::HeightfieldProbe()
    : heightfield_(dCreateHeightfield(nullptr, nullptr, 0)),
      ray_(dCreateRay(nullptr, to_real(kRayLength))),
      capsule_(dCreateCapsule(nullptr, 1, 1)),
      contacts_(kMaxListed) {
  dGeomRaySet(ray_, 0, 0, 0, 0, -1, 0);
  const dMatrix3 axis_up = {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0};
  dGeomSetRotation(capsule_, axis_up);
}

HeightfieldProbe::~HeightfieldProbe() {
  for (const dGeomID geom : {heightfield_, ray_, capsule_}) destroy_private_geom(geom);
}

bool HeightfieldProbe::is_infinite() const { return std::isinf(half_width_); }

bool HeightfieldProbe::cast_down(double x, double z, double start, Facet& facet) {
  dGeomSetPosition(ray_, to_real(x), to_real(start), to_real(z));
  dContactGeom hit;
  if (dCollide(heightfield_, ray_, 1, &hit, sizeof hit) != 1) return false;
  facet.x = x;
  facet.z = z;
  facet.height = double{hit.pos[1]};
  facet.normal = -to_vector(hit.normal);
  const double slope = std::hypot(facet.normal.x(), facet.normal.z()) / facet.normal.y();
  facet.rounding = kRealEpsilon * (std::abs(start) + std::abs(facet.height) + slope * (std::abs(x) + std::abs(z)));
  // If the start is below all samples around, ODE reports a hit although the ray goes down (heightfield.cpp, "totally under").
  return facet.height < start && facet.normal.allFinite() && facet.normal.y() > 0;
}

// A ray from below the surface does not hit it, and an upper bound of the surface is not always known. Raise the start until a ray
// hits, then lower it for the last digits.
bool HeightfieldProbe::find_facet(double x, double z, double scale, Facet& facet) {
  if (!(std::abs(x) < half_width_ * (1 - kBorder)) || !(std::abs(z) < half_depth_ * (1 - kBorder))) return false;
  if (std::isfinite(max_height_) && cast_down(x, z, max_height_ + scale, facet)) return true;
  double rise = scale;
  while (rise < kRayLength / 1e3 && !cast_down(x, z, rise, facet)) rise *= 1e3;
  if (!(rise < kRayLength / 1e3)) return false;
  if (rise - facet.height > kNear * (scale + std::abs(facet.height))) cast_down(x, z, facet.height + scale + 1e-12 * rise, facet);
  return true;
}

// ODE lists the samples inside the deep capsule. It omits the samples on planes that the capsule's lower end meets in the triangle
// itself (heightfield.cpp, "pass 2"). Those planes give points far below, which are skipped here.
bool HeightfieldProbe::list_samples(const Vector3& place, double radius, std::vector<Vector3>& samples) {
  const double reach = 1e9 * radius;
  dGeomCapsuleSetParams(capsule_, to_real(radius), to_real(2 * reach));
  dGeomSetPosition(capsule_, to_real(place.x()), to_real(place.y()), to_real(place.z()));
  const int count = dCollide(heightfield_, capsule_, kMaxListed, contacts_.data(), sizeof(dContactGeom));
  for (int k = 0; k < count; ++k) {
    const Vector3 point = to_vector(contacts_[static_cast<std::size_t>(k)].pos);
    if (point.allFinite() && std::abs(point.y() - place.y()) < reach / 2) samples.push_back(point);
  }
  return count < kMaxListed;
}

}  // namespace supernormal::ode
