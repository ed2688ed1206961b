// A program that has only the installed files. It computes the same gap with the C++ core and the C interface, and with a shape of
// its own. It catches an exception of the library, which needs the library's tables of virtual functions and type information.
#include <supernormal/supernormal.h>

#include <cmath>
#include <cstdio>
#include <supernormal/effects.hpp>
#include <supernormal/supernormal.hpp>

namespace {

// Two ellipsoids whose closest points lie on the common axis: centres 3 m apart, half-axes 1 m and 0.5 m along it.
constexpr double kDistance = 3;
constexpr double kGap = 1.5;

// A ball with the left ellipsoid's largest half-axis as its radius.
class Ball final : public supernormal::Shape {
 public:
  void evaluate(const supernormal::Vector3& n, supernormal::Order /*order*/, supernormal::Jet& jet) const override {
    jet.h = 1;
    jet.r = n;
    jet.H = supernormal::Matrix3::Identity() - n * n.transpose();
  }
};

double gap_by_core(const supernormal::Shape& left) {
  const supernormal::Ellipsoid right({0.5, 0.4, 0.3});
  supernormal::Pose pose;
  pose.position.x() = kDistance;
  return supernormal::find_proximity(left, {}, right, pose).gap;
}

bool refuses_bad_effects() {
  try {
    const supernormal::effects::Effects effects({supernormal::effects::Friction{-1}}, 0.001);
  } catch (const supernormal::effects::BadEffect& error) {
    return error.effect() == "friction";
  }
  return false;
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
  const supernormal::Ellipsoid ellipsoid({1, 0.8, 0.6});
  const supernormal::Shape& shape = ellipsoid;
  const double core = gap_by_core(ellipsoid);
  const double own = gap_by_core(Ball());
  const double ode = gap_by_ode();
  std::printf("gap by the core %.17g, of a shape of our own %.17g, by the C interface %.17g, expected %g\n", core, own, ode, kGap);
  const bool gaps_agree = std::abs(core - kGap) < 1e-9 && std::abs(own - kGap) < 1e-9 &&
                          std::abs(ode - kGap) < (sizeof(dReal) == sizeof(double) ? 1e-9 : 1e-6);
  return gaps_agree && refuses_bad_effects() && dynamic_cast<const supernormal::Ellipsoid*>(&shape) != nullptr ? 0 : 1;
}
