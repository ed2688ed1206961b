// The rattleback of Kane and Levinson (Realistic mathematical modeling of the rattleback, Int. J. Non-Linear Mechanics 17, 1982):
// an ellipsoid that, turned the wrong way, begins to rattle and reverses. The rattling grows out of a tilt of half a degree, so
// that an error of the contact point or a damping in it would show magnified.
#include <doctest/doctest.h>

#include "ode/ode_world.hpp"
#include "relative.hpp"

using namespace supernormal::test;

namespace {

Vec cross(const Vec& a, const Vec& b) { return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}; }

/// Half-axes 0.2, 0.03, 0.02 m, the centre of mass 0.01 m below the ellipsoid's; the attitude is R_x(alpha) R_y(beta) R_z(yaw).
class Rattleback {
 public:
  /// Let go at alpha = beta = 0.5 degrees with a spin (rad/s) about the body's third axis, the contact point at rest.
  explicit Rattleback(double spin) {
    world_.add_plane();
    world_.surface.mu = dInfinity;  // no slip
    const dGeomID geom = snCreateEllipsoid(world_.space(), dReal(0.2), dReal(0.03), dReal(0.02));
    dMass mass;
    dMassSetParameters(&mass, 1, 0, 0, 0, dReal(2e-4), dReal(1.6e-3), dReal(1.7e-3), dReal(-2e-5), 0, 0);
    body_ = world_.add(geom, mass);
    dGeomSetOffsetPosition(geom, 0, 0, dReal(0.01));
    dMatrix3 about_x;
    dMatrix3 about_y;
    dMatrix3 attitude;
    dRFromAxisAndAngle(about_x, 1, 0, 0, dReal(0.5 * kDegree));
    dRFromAxisAndAngle(about_y, 0, 1, 0, dReal(0.5 * kDegree));
    dMultiply0_333(attitude, about_x, about_y);
    dBodySetRotation(body_, attitude);
    const dVector3 down = {0, 0, -1, 0};
    dVector3 lowest;
    REQUIRE(snGeomSupport(geom, down, lowest) == 1);
    dBodySetPosition(body_, 0, 0, -lowest[2]);
    const Vec w = spin * third_axis();
    const Vec v = -1.0 * cross(w, to_vec(lowest));
    dBodySetAngularVel(body_, dReal(w[0]), dReal(w[1]), dReal(w[2]));
    dBodySetLinearVel(body_, dReal(v[0]), dReal(v[1]), dReal(v[2]));
  }

  void step(double dt) {
    world_.quick_step(dt);
    const double turned = std::remainder(angle() - yaw_, 2 * std::numbers::pi);
    yaw_ += turned;
  }

  double spin() const { return dot(to_vec(dBodyGetAngularVel(body_)), third_axis()); }  ///< rad/s
  double vertical_spin() const { return dBodyGetAngularVel(body_)[2]; }                 ///< rad/s
  double yaw() const { return yaw_; }                                                   ///< rad, from 0 at the start
  double energy() const { return supernormal::test::energy(body_); }                    ///< J

 private:
  Vec third_axis() const {
    const dReal* const R = dBodyGetRotation(body_);
    return {R[2], R[6], R[10]};
  }
  double angle() const {
    const dReal* const R = dBodyGetRotation(body_);
    return std::atan2(-R[1], R[0]);
  }

  World world_;
  dBodyID body_ = nullptr;
  double yaw_ = 0;
};

constexpr double kEnergy = 0.12388531;  // J

}  // namespace

TEST_CASE("a rattleback turned the wrong way reverses when it should") {
  // "no slip, omega_3 = -5 rad/s: the spin first reverses at 2.3527 s; smallest yaw -6.81015 rad at 2.8150 s; energy 0.12388531 J
  // conserved." omega_3 is the body's, and swings with the rattling; the vertical one reverses at 2.6847 s (the same equations of
  // motion, integrated with Runge and Kutta's method).
  //
  // A step projects the velocity of the last one on the constraint at the new contact point, which runs along the keel with metres
  // a second: what this costs is proportional to the step (0.94, 1.86, 4.6 thousandths of the energy at 2, 4, 10 us).
  OdeSession session;
  Rattleback rattleback(-5);
  CHECK(rattleback.energy() == relative(kEnergy).epsilon(1e-7));
  const double dt = 4e-6;
  double reversal = 0;
  double vertical_reversal = 0;
  double smallest_yaw = 0;
  double most = 0;
  for (int step = 1; step * dt < 2.9; ++step) {
    rattleback.step(dt);
    if (reversal == 0 && rattleback.spin() > 0) reversal = step * dt;
    if (vertical_reversal == 0 && rattleback.vertical_spin() > 0) vertical_reversal = step * dt;
    smallest_yaw = std::min(smallest_yaw, rattleback.yaw());
    most = std::max(most, rattleback.energy());
  }
  CHECK(reversal == relative(2.3527).epsilon(5e-3));
  CHECK(vertical_reversal == relative(2.6847).epsilon(1e-3));
  CHECK(smallest_yaw == relative(-6.81015).epsilon(0.01));
  CHECK(rattleback.energy() > kEnergy * (1 - 2.5e-3));
  CHECK(most < kEnergy * (1 + 1e-6));
}

TEST_CASE("a rattleback turned the right way goes on turning") {
  // "Released at +5 it does not reverse early: yaw 24.767 rad at 5 s."
  OdeSession session;
  Rattleback rattleback(5);
  const double dt = 2e-5;
  double slowest = 5;
  for (int step = 1; step <= 250000; ++step) {
    rattleback.step(dt);
    slowest = std::min(slowest, rattleback.vertical_spin());
  }
  CHECK(slowest > 3);
  CHECK(rattleback.yaw() == relative(24.767).epsilon(1e-3));
  CHECK(rattleback.energy() == relative(kEnergy).epsilon(2e-3));
}
