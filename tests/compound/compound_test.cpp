// Tests of samples/compound: the mass and inertia of bodies made of several geoms.
#include "compound.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/relative.hpp"

namespace {

class World {
 public:
  World() {
    dInitODE2(0);
    dAllocateODEDataForThread(dAllocateFlagBasicData | dAllocateFlagCollisionData);
    world_ = dWorldCreate();
  }
  ~World() {
    dWorldDestroy(world_);
    snClose();
    dCloseODE();
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  operator dWorldID() const { return world_; }  // NOLINT(google-explicit-constructor): as ODE's own dWorld

 private:
  dWorldID world_;
};

void destroy(const std::vector<Part>& parts) {
  for (const Part& part : parts) dGeomDestroy(part.geom);
}

/// Mass, first moments and the integrals of x^2, y^2, z^2, x y, x z, y z.
struct Sums {
  double mass = 0;
  std::array<double, 3> first{};
  std::array<double, 6> second{};

  void add(const std::array<double, 3>& p, double m) {
    mass += m;
    for (std::size_t i = 0; i < 3; ++i) {
      first[i] += m * p[i];
      second[i] += m * p[i] * p[i];
    }
    second[3] += m * p[0] * p[1];
    second[4] += m * p[0] * p[2];
    second[5] += m * p[1] * p[2];
  }
};

/// Adds the cells of a cubic lattice over the bounding box of a geom in its place. The fraction of each cell follows from the
/// distance of its middle from the boundary.
void add_cells(const Part& part, double edge, double weight, Sums& sums) {
  std::array<dReal, 6> box{};
  dGeomGetAABB(part.geom, box.data());
  std::array<int, 3> count{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    count[axis] = static_cast<int>(std::ceil((box[2 * axis + 1] - box[2 * axis]) / edge)) + 2;
  }
  for (int i = 0; i < count[0]; ++i) {
    for (int j = 0; j < count[1]; ++j) {
      for (int k = 0; k < count[2]; ++k) {
        const std::array<double, 3> p{box[0] + (i - 0.5) * edge, box[2] + (j - 0.5) * edge, box[4] + (k - 0.5) * edge};
        const double share = std::clamp(0.5 + snGeomPointDepth(part.geom, p[0], p[1], p[2]) / edge, 0.0, 1.0);
        sums.add(p, weight * part.density * share * edge * edge * edge);
      }
    }
  }
}

}  // namespace

TEST_CASE("compound: two balls of different density have the closed form") {
  const World world;
  constexpr double kRadius = 0.1, kDistance = 0.3;
  const std::vector<Part> parts = {make_part(snCreateEllipsoid(nullptr, kRadius, kRadius, kRadius), 3000, 0, 0, kDistance),
                                   make_part(snCreateEllipsoid(nullptr, kRadius, kRadius, kRadius), 1000, 0, 0, 0)};
  dMass mass;
  const dBodyID body = assemble(world, parts, mass);
  const double ball = 4 * std::numbers::pi / 3 * kRadius * kRadius * kRadius;
  const double along = 0.4 * 4000 * ball * kRadius * kRadius;
  const double across = along + ball * 3000.0 * 1000 / 4000 * kDistance * kDistance;  // with the reduced mass
  CHECK(mass.mass == supernormal::test::relative(4000 * ball).epsilon(1e-13));
  CHECK(mass.I[0] == supernormal::test::relative(across).epsilon(1e-13));
  CHECK(mass.I[5] == supernormal::test::relative(across).epsilon(1e-13));
  CHECK(mass.I[10] == supernormal::test::relative(along).epsilon(1e-13));
  CHECK(dGeomGetPosition(parts[0].geom)[2] == supernormal::test::relative(0.25 * kDistance).epsilon(1e-13));
  CHECK(dGeomGetPosition(parts[1].geom)[2] == supernormal::test::relative(-0.75 * kDistance).epsilon(1e-13));
  CHECK(least_gap(parts) == supernormal::test::relative(kDistance - 2 * kRadius).epsilon(1e-9));
  destroy(parts);
  dBodyDestroy(body);
}

TEST_CASE("compound: tapered, rotated and moved parts agree with sums over a lattice of cells") {
  const World world;
  const std::vector<Part> parts = {
      make_part(snCreateSuperovoid(nullptr, 0.55, 0.5, 0.35, 3.5, 4, 0.15, 0.15), 2900, 0.1, -0.2, 0.3),
      make_part(snCreateSuperovoid(nullptr, 0.2, 0.16, 0.6, 2, 3, 0.5, 0.5), 2100, 0.2, 0.5, -0.9, 0.4),
      make_part(snCreateSuperovoid(nullptr, 0.2, 0.16, 0.6, 2, 3, -0.5, -0.5), 2100, 0.1, -0.6, -0.9, -0.7)};
  dMass mass;
  const dBodyID body = assemble(world, parts, mass);
  CHECK(least_gap(parts) > 0);

  Sums sums;
  // The error of the linear fraction is proportional to the square of the edge (Steiner's formula), so Richardson's extrapolation
  // applies.
  for (const Part& part : parts) {
    add_cells(part, 0.02, 4.0 / 3, sums);
    add_cells(part, 0.04, -1.0 / 3, sums);
  }
  const auto& [xx, yy, zz, xy, xz, yz] = sums.second;
  constexpr double kTolerance = 5e-4;  // twice the error of the lattice
  const double size = kTolerance * (xx + yy + zz);
  CHECK(mass.mass == supernormal::test::relative(sums.mass).epsilon(kTolerance));
  for (const double moment : sums.first) CHECK(std::abs(moment) < kTolerance * sums.mass);  // the centre of mass is at the origin
  CHECK(std::abs(mass.I[0] - (yy + zz)) < size);
  CHECK(std::abs(mass.I[5] - (zz + xx)) < size);
  CHECK(std::abs(mass.I[10] - (xx + yy)) < size);
  CHECK(std::abs(mass.I[1] + xy) < size);
  CHECK(std::abs(mass.I[2] + xz) < size);
  CHECK(std::abs(mass.I[6] + yz) < size);
  destroy(parts);
  dBodyDestroy(body);
}
