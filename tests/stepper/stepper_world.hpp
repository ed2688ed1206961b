// A world whose bodies a stepper moves, as in a program.
#pragma once

#include <vector>

#include "support/ode_world.hpp"

namespace supernormal::test {

class StepperWorld {
  OdeSession session_;  // outlives the world

 public:
  /// Bodies that are created from now on look ahead by a step (s).
  explicit StepperWorld(double step, dSpaceID (*create_space)(dSpaceID) = dHashSpaceCreate)
      : world(create_space(nullptr)), step_(step), stepper(snStepperCreate(world.id())) {
    REQUIRE(stepper != nullptr);
    REQUIRE(snSetDefaultLookAhead(dReal(step)) == 1);
    surface.mode = dContactApprox1;
  }
  ~StepperWorld() { snStepperDestroy(stepper); }
  StepperWorld(const StepperWorld&) = delete;
  StepperWorld(StepperWorld&&) = delete;
  StepperWorld& operator=(const StepperWorld&) = delete;
  StepperWorld& operator=(StepperWorld&&) = delete;

  template <typename Mass>  // a density or a dMass
  dBodyID add(dGeomID geom, const Mass& mass, const Vec& at) {
    const dBodyID body = world.add(geom, mass);
    dBodySetPosition(body, dReal(at[0]), dReal(at[1]), dReal(at[2]));
    REQUIRE(snStepperAddBody(stepper, body) == 1);
    return body;
  }
  dBodyID add_ball(double radius, const Vec& at) {
    return add(snCreateEllipsoid(world.space(), dReal(radius), dReal(radius), dReal(radius)), 1000, at);
  }
  /// Half-axes (0.1, 0.07, 0.05) m.
  dBodyID add_brick(double exponent, double density, const Vec& at) {
    const auto e = dReal(exponent);
    return add(snCreateSuperellipsoid(world.space(), dReal(0.1), dReal(0.07), dReal(0.05), e, e), density, at);
  }
  /// ODE's own, as long; its contacts are found once it overlaps.
  dBodyID add_box(double density, const Vec& at) {
    dMass mass;
    dMassSetBox(&mass, dReal(density), dReal(0.2), dReal(0.14), dReal(0.1));
    return add(dCreateBox(world.space(), dReal(0.2), dReal(0.14), dReal(0.1)), mass, at);
  }

  /// Bricks of exponent 8, one on another.
  std::vector<dBodyID> add_tower(int bricks) {
    std::vector<dBodyID> tower(std::size_t(bricks), nullptr);
    for (std::size_t i = 0; i < tower.size(); ++i) tower[i] = add_brick(8, 1000, {0, 0, 0.05 + 0.1 * double(i)});
    return tower;
  }
  /// What has been slow for 0.2 s falls asleep.
  void let_sleep() const {
    dWorldSetAutoDisableFlag(world.id(), 1);
    dWorldSetAutoDisableTime(world.id(), dReal(0.2));
    dWorldSetAutoDisableAverageSamplesCount(world.id(), 5);
  }

  void collide() {
    contacts = 0;
    dSpaceCollide(world.space(), this, near_callback);
  }

  /// A whole step, in parts if it ends early.
  void step() { step(step_); }
  void step(double left) {
    parts = 0;
    for (; left > 0; ++parts) {
      collide();
      const double done = snStepperStep(stepper, dReal(left));
      REQUIRE(done > 0);
      left = done >= left ? 0 : left - done;
    }
  }
  void run(double time) {
    for (int i = 0; i < std::lround(time / step_); ++i) step();
  }

  World world;

 private:
  double step_;  // s

 public:
  snStepperID stepper;
  dSurfaceParameters surface{};  ///< parameters of every contact; Approx1 and frictionless unless set
  int contacts = 0;              ///< of the last call
  int parts = 0;                 ///< of the last step

 private:
  static void near_callback(void* self, dGeomID o1, dGeomID o2) {
    StepperWorld& scene = *static_cast<StepperWorld*>(self);
    const dBodyID body1 = dGeomGetBody(o1);
    const dBodyID body2 = dGeomGetBody(o2);
    if (body1 == nullptr && body2 == nullptr) return;
    std::array<dContact, World::kRoom> found{};
    const int count = dCollide(o1, o2, World::kRoom, &found[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      dContact& contact = found[static_cast<std::size_t>(i)];
      contact.surface = scene.surface;
      REQUIRE(snStepperAddContact(scene.stepper, &contact, body1, body2) == 1);
    }
    scene.contacts += count;
  }
};

/// A world with the plane z = 0.
struct OnFloor : StepperWorld {
  explicit OnFloor(double step, double friction = 0.5) : StepperWorld(step) {
    surface.mu = dReal(friction);
    world.add_plane();
  }
};

inline void set_velocity(dBodyID body, const Vec& v) { dBodySetLinearVel(body, dReal(v[0]), dReal(v[1]), dReal(v[2])); }
inline void set_spin(dBodyID body, const Vec& w) { dBodySetAngularVel(body, dReal(w[0]), dReal(w[1]), dReal(w[2])); }
inline Vec place_of(dBodyID body) { return to_vec(dBodyGetPosition(body)); }
inline Vec velocity_of(dBodyID body) { return to_vec(dBodyGetLinearVel(body)); }
inline Vec spin_of(dBodyID body) { return to_vec(dBodyGetAngularVel(body)); }
inline void tilt_gravity(const StepperWorld& scene, double angle) {
  dWorldSetGravity(scene.world.id(), dReal(kGravity * std::sin(angle)), 0, dReal(-kGravity * std::cos(angle)));
}

}  // namespace supernormal::test
