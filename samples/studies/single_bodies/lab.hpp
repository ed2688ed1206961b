// A plane, a few bodies and the effects of an experiment.
#pragma once

#include <numbers>
#include <string>
#include <supernormal/effects.hpp>
#include <vector>

#include "common/ode_world.hpp"

namespace single_bodies {

using supernormal::Vector3;
namespace fx = supernormal::effects;

constexpr double kGravity = 9.81;  // m/s^2
constexpr double kDegree = std::numbers::pi / 180;

class Lab {
 public:
  Lab(const std::vector<fx::Effect>& effects, double step);

  dWorldID world() const { return world_.id(); }
  dSpaceID space() const { return world_.space(); }
  double step_length() const { return step_; }

  /// Adds the plane z = 0, with the friction of the effects.
  void add_floor();
  dBodyID add(dGeomID geom, double density);
  dBodyID add(dGeomID geom, const dMass& mass);

  void step();

 private:
  void add_contacts(dGeomID g1, dGeomID g2);

  double step_;
  common::OdeWorld world_;
  fx::Effects effects_;
};

Vector3 position(dBodyID body);
Vector3 velocity(dBodyID body);
Vector3 spin(dBodyID body);
Vector3 third_axis(dBodyID body);
void set_position(dBodyID body, const Vector3& x);
void set_velocity(dBodyID body, const Vector3& v);
void set_spin(dBodyID body, const Vector3& w);
void turn(dBodyID body, const Vector3& axis, double angle);
Vector3 angular_momentum(dBodyID body);  ///< kg m^2/s, about the centre of mass
double mass_of(dBodyID body);
double translation_energy(dBodyID body);  ///< J
double rotation_energy(dBodyID body);     ///< J

/// One line of the table.
struct Result {
  std::string experiment;
  std::string quantity;
  double ours;
  double reference;
  std::string source;
};
using Results = std::vector<Result>;

Results elastic_gas();
Results rocking();
Results rolling();
Results incline();
Results skipping_bean();
Results rattleback();
Results tippe_top();

}  // namespace single_bodies
