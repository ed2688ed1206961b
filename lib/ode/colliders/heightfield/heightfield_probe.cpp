#include "ode/colliders/heightfield/heightfield_probe.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ode/geom/convert.hpp"

namespace supernormal::ode {
namespace {

// Longer than any ray that has to get through a surface, and finite, because ODE would multiply infinity by zero.
constexpr double kRayLength = 1e18;

constexpr int kMaxListed = 2048;

// Heights are found as a ray's start minus the distance to the surface: a start this many scales above the surface costs digits.
constexpr double kNear = 16;

}  // namespace

HeightfieldProbe& HeightfieldProbe::looking_at(dGeomID heightfield) {
  thread_local HeightfieldProbe probe;
  probe.data_ = dGeomHeightfieldGetHeightfieldData(heightfield);
  dGeomHeightfieldSetHeightfieldData(probe.heightfield_, probe.data_);
  dGeomMoved(probe.heightfield_);
  std::array<dReal, 6> aabb{};
  dGeomGetAABB(probe.heightfield_, aabb.data());
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
  for (const dGeomID geom : {heightfield_, ray_, capsule_}) dGeomDestroy(geom);
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
  // For a start below all samples around, ODE reports a hit although the ray goes down (heightfield.cpp, "totally under").
  return facet.height < start && facet.normal.allFinite() && facet.normal.y() > 0;
}

// A ray that starts below the surface does not find it, and where the surface ends is not always known: the start goes up until
// there is a hit, and comes down again for the last digits.
bool HeightfieldProbe::find_facet(double x, double z, double scale, Facet& facet) {
  if (!(std::abs(x) < half_width_ * (1 - kBorder)) || !(std::abs(z) < half_depth_ * (1 - kBorder))) return false;
  if (std::isfinite(max_height_) && cast_down(x, z, max_height_ + scale, facet)) return true;
  double rise = scale;
  while (rise < kRayLength / 1e3 && !cast_down(x, z, rise, facet)) rise *= 1e3;
  if (!(rise < kRayLength / 1e3)) return false;
  if (rise - facet.height > kNear * (scale + std::abs(facet.height))) cast_down(x, z, facet.height + scale + 1e-12 * rise, facet);
  return true;
}

// ODE lists the samples within the deep capsule, except for those of the triangle's planes that meet the capsule's lower end in
// that very triangle (heightfield.cpp, "pass 2"); the points of these come first, far below.
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
