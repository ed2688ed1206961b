// Meshes of geoms through the C interface.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "support/ode_fixture.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

double volume(const snMesh& mesh) {
  double sum = 0;
  for (int k = 0; k < mesh.triangles; ++k) {
    const auto corner = [&](int i) { return to_vec(mesh.position + 3 * mesh.index[3 * k + i]); };
    const Vec a = corner(0), b = corner(1), c = corner(2);
    sum += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6;
  }
  return sum;
}

}  // namespace

TEST_CASE("a mesh has the volume of its geom, and its vertices have the geom's normals") {
  OdeSession session;
  const Geom geom(snCreateSuperellipsoid(nullptr, 1, dReal(0.8), dReal(0.6), 3, 3));
  REQUIRE(snGeomSetRounding(geom, dReal(0.05)) == 1);
  dMass mass;
  REQUIRE(snMassSet(&mass, 1, geom) == 1);
  snMesh mesh;
  REQUIRE(snGeomTessellate(geom, dReal(2e-4), &mesh) == 1);
  CHECK(volume(mesh) == relative(mass.mass).epsilon(1e-3));
  CHECK(volume(mesh) < mass.mass);  // its vertices are on the boundary of a convex body
  for (int k = 0; k < mesh.points; ++k) {
    const dReal* n = mesh.normal + 3 * k;
    const dVector3 direction = {n[0], n[1], n[2]};
    dVector3 point;
    REQUIRE(snGeomSupport(geom, direction, point) == 1);
    for (int i = 0; i < 3; ++i) CHECK(std::abs(point[i] - mesh.position[3 * k + i]) < within_rounding(1e-12));
  }
  snMeshRelease(&mesh);
  CHECK(mesh.position == nullptr);
  snMeshRelease(&mesh);
  snMeshRelease(nullptr);
}

TEST_CASE("a mesh with invalid arguments is refused and empty") {
  OdeSession session;
  const Geom geom(snCreateEllipsoid(nullptr, 3, 2, 1));
  snMesh mesh;
  for (const dReal wrong : {dReal(0), dReal(-1), std::numeric_limits<dReal>::quiet_NaN(), std::numeric_limits<dReal>::infinity()}) {
    CHECK(refused(snGeomTessellate(geom, wrong, &mesh), "chord_error ="));
    CHECK(mesh.triangles == 0);
    CHECK(mesh.position == nullptr);
  }
  CHECK(snGeomTessellate(geom, dReal(0.1), nullptr) == 0);
  CHECK(snGeomTessellate(nullptr, dReal(0.1), &mesh) == 0);
  dGeomID sphere = dCreateSphere(nullptr, 1);
  CHECK(snGeomTessellate(sphere, dReal(0.1), &mesh) == 0);
  dGeomDestroy(sphere);
}
