// A program that knows only what is installed: asks the C++ core and the C interface for the same gap.
#include <supernormal/supernormal.h>

#include <cmath>
#include <cstdio>
#include <supernormal/supernormal.hpp>

namespace {

// Two ellipsoids whose closest points lie on the common axis: centres 3 m apart, half-axes 1 m and 0.5 m along it.
constexpr double kDistance = 3;
constexpr double kGap = 1.5;

double gap_by_core() {
  const supernormal::Ellipsoid left({1, 0.8, 0.6});
  const supernormal::Ellipsoid right({0.5, 0.4, 0.3});
  supernormal::Pose pose;
  pose.position.x() = kDistance;
  return supernormal::find_proximity(left, {}, right, pose).gap;
}

double gap_by_ode() {
  dInitODE2(0);
  dGeomID left = snCreateEllipsoid(nullptr, 1, dReal(0.8), dReal(0.6));
  dGeomID right = snCreateEllipsoid(nullptr, dReal(0.5), dReal(0.4), dReal(0.3));
  dGeomSetPosition(right, dReal(kDistance), 0, 0);
  snProximity proximity;
  const int answered = snGeomProximity(left, right, &proximity);
  dGeomDestroy(left);
  dGeomDestroy(right);
  snClose();
  dCloseODE();
  return answered ? proximity.gap : NAN;
}

}  // namespace

int main() {
  const double core = gap_by_core();
  const double ode = gap_by_ode();
  std::printf("gap by the core %.17g, by the C interface %.17g, expected %g\n", core, ode, kGap);
  return std::abs(core - kGap) < 1e-9 && std::abs(ode - kGap) < (sizeof(dReal) == sizeof(double) ? 1e-9 : 1e-6) ? 0 : 1;
}
