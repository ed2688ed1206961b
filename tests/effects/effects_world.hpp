// A session of ODE, and a world with effects, stepped as in a program.
#pragma once

#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "supernormal/effects.hpp"
#include "support/ode_world.hpp"

namespace supernormal::test {

namespace fx = supernormal::effects;

inline constexpr double kStep = 5e-4;        ///< s
inline constexpr double kLongStep = 1e-3;    ///< s
inline constexpr double kBallRadius = 0.05;  ///< m
inline constexpr double kRadius = 0.01;      ///< m, of small balls
inline constexpr double kDensity = 2500;     ///< kg/m^3

/// The force and torque of a joint on the first of its bodies.
struct Load {
  Vec force;   ///< N
  Vec torque;  ///< N m, about the contact point
  Vec normal;
};

class EffectsWorld {
  OdeSession session_;  // outlives the world

 public:
  static constexpr int kRoom = 8;

  EffectsWorld(const std::vector<fx::Effect>& list, double step, dSpaceID space = nullptr)
      : world(space != nullptr ? space : dHashSpaceCreate(nullptr)),
        effects(list, step),
        step_(step),
        joints_(dJointGroupCreate(0)) {
    feedback_.reserve(4000);
    dWorldSetGravity(id(), 0, 0, 0);  // no gravity unless it is listed
    // ODE's default in double precision. The default in single precision, 1e-5, softens rigid contacts: a ball of 0.5 kg that
    // should gain 1.12 m/s in a step of 50 us gains 0.11 m/s less.
    dWorldSetCFM(id(), dReal(1e-10));
    effects.set_up(id());
  }
  ~EffectsWorld() { dJointGroupDestroy(joints_); }
  EffectsWorld(const EffectsWorld&) = delete;
  EffectsWorld(EffectsWorld&&) = delete;
  EffectsWorld& operator=(const EffectsWorld&) = delete;
  EffectsWorld& operator=(EffectsWorld&&) = delete;

  dWorldID id() const { return world.id(); }

  /// Adds a body of a density (kg/m^3) at a position.
  dBodyID add(dGeomID geom, double density, const Vec& at) {
    const dBodyID body = world.add(geom, density);
    dBodySetPosition(body, dReal(at[0]), dReal(at[1]), dReal(at[2]));
    effects.add_body(body);
    return body;
  }
  dBodyID add_ball(double radius, double density, const Vec& at) { return add_body({radius, radius, radius}, 2, density, at); }
  /// A superellipsoid with equal exponents.
  dBodyID add_body(const Vec& half_axes, double exponent, double density, const Vec& at) {
    const auto a = dReal(half_axes[0]), b = dReal(half_axes[1]), c = dReal(half_axes[2]), e = dReal(exponent);
    return add(exponent == 2 ? snCreateEllipsoid(world.space(), a, b, c) : snCreateSuperellipsoid(world.space(), a, b, c, e, e),
               density, at);
  }

  void step() {
    loads.clear();
    feedback_.clear();
    depth = 0;
    dSpaceCollide(world.space(), this, near_callback);
    effects.apply_forces();
    dWorldQuickStep(id(), dReal(step_));
    for (std::size_t i = 0; i < feedback_.size(); ++i) read(i);
    dJointGroupEmpty(joints_);
  }

  /// Steps until a condition holds, or for a time at most (s); returns the time.
  double run_until(
      double longest, const std::function<bool()>& is_over = [] { return false; }) {
    int steps = 0;
    do {
      step();
      ++steps;
    } while (steps * step_ < longest && !is_over());
    return steps * step_;
  }

  World world;
  fx::Effects effects;
  std::function<fx::Material(dGeomID)> material_of = [](dGeomID) { return 0; };
  std::map<dGeomID, dBodyID>
      other_body;           ///< bodies of walls whose geoms have no body; contacts are then set up with the bodies of both sides
  std::vector<Load> loads;  ///< loads in the last step
  double depth = 0;         ///< m, of the deepest contact in the last step

 private:
  struct Attached {
    dJointFeedback feedback;
    Vec point;
    Vec normal;
    bool is_first;  ///< whether body 1 of the joint is the body of geom.g1
    Vec centre;
  };

  static void near_callback(void* self, dGeomID o1, dGeomID o2) { static_cast<EffectsWorld*>(self)->collide(o1, o2); }

  void collide(dGeomID o1, dGeomID o2) {
    if (dGeomIsSpace(o1) != 0 || dGeomIsSpace(o2) != 0) return dSpaceCollide2(o1, o2, this, near_callback);
    std::array<dContact, kRoom> found{};
    const int count = dCollide(o1, o2, kRoom, &found[0].geom, sizeof(dContact));
    if (count == 0) return;
    const auto geom = found[0].geom;
    const auto contacts = std::span(found).first(static_cast<std::size_t>(count));
    const int kept = other_body.empty() ? effects.set_up_contacts(contacts, material_of(geom.g1), material_of(geom.g2))
                                        : effects.set_up_contacts(contacts, {material_of(geom.g1), body_of(geom.g1)},
                                                                  {material_of(geom.g2), body_of(geom.g2)});
    for (int i = 0; i < kept; ++i) attach(found[static_cast<std::size_t>(i)]);
  }

  dBodyID body_of(dGeomID geom) const {
    const auto found = other_body.find(geom);
    return found == other_body.end() ? dGeomGetBody(geom) : found->second;
  }

  void attach(const dContact& contact) {
    const dBodyID body1 = body_of(contact.geom.g1);
    const dBodyID body2 = body_of(contact.geom.g2);
    const dJointID joint = dJointCreateContact(id(), joints_, &contact);
    dJointAttach(joint, body1, body2);
    const dBodyID first = body1 != nullptr ? body1 : body2;
    REQUIRE(feedback_.size() < feedback_.capacity());
    feedback_.push_back(
        {{}, to_vec(contact.geom.pos), to_vec(contact.geom.normal), body1 != nullptr, to_vec(dBodyGetPosition(first))});
    dJointSetFeedback(joint, &feedback_.back().feedback);
    depth = std::max(depth, double{contact.geom.depth});
  }

  // ODE writes the force on the only body into f1, even if it is the second body.
  void read(std::size_t i) {
    const Attached& joint = feedback_[i];
    const Vec force = to_vec(joint.feedback.f1);
    const Vec lever = joint.point - joint.centre;
    const Vec torque = to_vec(joint.feedback.t1) - cross(lever, force);
    loads.push_back({force, torque, joint.is_first ? joint.normal : -1.0 * joint.normal});
  }
  static Vec cross(const Vec& a, const Vec& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }

  double step_;
  dJointGroupID joints_;
  std::vector<Attached> feedback_;  // ODE keeps pointers to its elements, so it does not grow
};

/// A world with the plane z = 0.
struct OnPlane : EffectsWorld {
  OnPlane(const std::vector<fx::Effect>& list, double step) : EffectsWorld(list, step) { world.add_plane(); }
};

/// Gives the body a velocity before a step, which its look-ahead has to know.
inline void throw_body(dBodyID body, const Vec& velocity) {
  dBodySetLinearVel(body, dReal(velocity[0]), dReal(velocity[1]), dReal(velocity[2]));
  dGeomMoved(dBodyGetFirstGeom(body));
}

/// The sum of a quantity of bodies.
inline double sum_of(const std::vector<dBodyID>& bodies, double (*quantity)(dBodyID)) {
  double sum = 0;
  for (const dBodyID body : bodies) sum += quantity(body);
  return sum;
}

inline fx::Cost cost_of(const fx::Effects& effects, const std::string& name) {
  for (const fx::Cost& cost : effects.costs()) {
    if (cost.name == name) return cost;
  }
  FAIL("no such cost: ", name);
  return {};
}

inline fx::Gravity earth() { return {{0, 0, -kGravity}}; }

}  // namespace supernormal::test
