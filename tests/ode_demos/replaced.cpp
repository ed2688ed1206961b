// ODE's functions for spheres and boxes as the demos call them (replaced.h). With DEMO_SPHERES=1 a sphere is an ellipsoid of ours.
// With DEMO_EXPONENT a box is a superellipsoid of that exponent. Otherwise they are ODE's own. Classes and sizes are reported as
// the demo requested them, since the demo chooses friction and drawing by them.
#include "replaced.hpp"

#include <supernormal/supernormal.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace {

// The exponents of an ellipsoid; boxes have larger ones.
constexpr dReal kRound = 2;

struct Size {
  std::array<dReal, 3> half_axes{};
  dReal exponent = 0;
};

CollisionCounts& counts() {
  static CollisionCounts all;
  return all;
}

bool is_ours(dGeomID geom) { return dGeomGetClass(geom) == snGeomClass(); }

Size size_of(dGeomID geom) {
  Size size;
  dReal epsilon = 0;
  auto& [a, b, c] = size.half_axes;
  if (snGeomSuperellipsoidGetParams(geom, &a, &b, &c, &size.exponent, &epsilon) == 0) std::abort();
  return size;
}

dGeomID remembered(dGeomID geom) {
  if (geom == nullptr) {
    std::fprintf(stderr, "%s\n", snLastError());
    std::abort();
  }
  replaceables().push_back({geom});
  return geom;
}

}  // namespace

double number_from(const char* name) {
  const char* const text = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): there is one thread
  return text == nullptr ? 0 : std::strtod(text, nullptr);
}

std::vector<Replaceable>& replaceables() {
  static std::vector<Replaceable> all;
  return all;
}

const CollisionCounts& collision_counts() { return counts(); }

extern "C" {

dGeomID demo_create_sphere(dSpaceID space, dReal radius) {
  static const bool ours = number_from("DEMO_SPHERES") > 0;
  return remembered(ours ? snCreateEllipsoid(space, radius, radius, radius) : dCreateSphere(space, radius));
}

dGeomID demo_create_box(dSpaceID space, dReal lx, dReal ly, dReal lz) {
  static const auto exponent = static_cast<dReal>(number_from("DEMO_EXPONENT"));
  return remembered(exponent > 0 ? snCreateSuperellipsoid(space, lx / 2, ly / 2, lz / 2, exponent, exponent)
                                 : dCreateBox(space, lx, ly, lz));
}

void demo_geom_destroy(dGeomID geom) {
  std::erase_if(replaceables(), [geom](const Replaceable& known) { return known.geom == geom; });
  dGeomDestroy(geom);
}

int demo_geom_get_class(dGeomID geom) {
  if (!is_ours(geom)) return dGeomGetClass(geom);
  return size_of(geom).exponent == kRound ? dSphereClass : dBoxClass;
}

void demo_sphere_set_radius(dGeomID geom, dReal radius) {
  if (!is_ours(geom)) return dGeomSphereSetRadius(geom, radius);
  if (snGeomSuperellipsoidSetParams(geom, radius, radius, radius, kRound, kRound) == 0) std::abort();
}

dReal demo_sphere_get_radius(dGeomID geom) { return is_ours(geom) ? size_of(geom).half_axes[0] : dGeomSphereGetRadius(geom); }

dReal demo_sphere_point_depth(dGeomID geom, dReal x, dReal y, dReal z) {
  return is_ours(geom) ? snGeomPointDepth(geom, x, y, z) : dGeomSpherePointDepth(geom, x, y, z);
}

void demo_box_get_lengths(dGeomID geom, dReal* lengths) {
  if (!is_ours(geom)) return dGeomBoxGetLengths(geom, lengths);
  const Size size = size_of(geom);
  std::ranges::transform(size.half_axes, lengths, [](dReal half) { return 2 * half; });
}

int demo_collide(dGeomID g1, dGeomID g2, int flags, dContactGeom* contacts, int skip) {
  const int found = dCollide(g1, g2, flags, contacts, skip);
  counts().calls += 1;
  counts().contacts += static_cast<unsigned>(found);
  return found;
}

// Without the demo's threads a run has the same digits every time, and its processor time is the time of its work.
void demo_set_threading(dWorldID world, const dThreadingFunctionsInfo* functions, dThreadingImplementationID threading) {
  if (number_from("DEMO_THREADS") > 0) dWorldSetStepThreadingImplementation(world, functions, threading);
}

}  // extern "C"
