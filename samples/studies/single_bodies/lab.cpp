#include "lab.hpp"

#include <array>
#include <span>

namespace single_bodies {
namespace {

constexpr int kContactsPerPair = 5;

dReal real(double value) { return static_cast<dReal>(value); }
Vector3 vector(const dReal* v) { return Vector3(v[0], v[1], v[2]); }

dMass mass_properties(dBodyID body) {
  dMass mass;
  dBodyGetMass(body, &mass);
  return mass;
}

}  // namespace

Lab::Lab(const std::vector<fx::Effect>& effects, double step)
    : step_(step), world_(dHashSpaceCreate(nullptr)), effects_(effects, step) {
  dRandSetSeed(1);  // quickstep shuffles its rows with ODE's global generator
  effects_.set_up(world());
}

void Lab::add_floor() { dCreatePlane(space(), 0, 0, 1, 0); }

dBodyID Lab::add(dGeomID geom, double density) {
  dMass mass;
  snMassSet(&mass, real(density), geom);
  return add(geom, mass);
}

dBodyID Lab::add(dGeomID geom, const dMass& mass) {
  const dBodyID body = world_.add(geom, mass);
  effects_.add_body(body);
  return body;
}

void Lab::step() {
  world_.collide([this](dGeomID g1, dGeomID g2) { add_contacts(g1, g2); });
  effects_.apply_forces();
  world_.step(step_);
}

void Lab::add_contacts(dGeomID g1, dGeomID g2) {
  std::array<dContact, kContactsPerPair> contacts;
  int count = dCollide(g1, g2, kContactsPerPair, &contacts[0].geom, sizeof(dContact));
  count = effects_.set_up_contacts(std::span(contacts).first(static_cast<std::size_t>(count)));
  for (int i = 0; i < count; ++i) world_.join(contacts[static_cast<std::size_t>(i)]);
}

Vector3 position(dBodyID body) { return vector(dBodyGetPosition(body)); }
Vector3 velocity(dBodyID body) { return vector(dBodyGetLinearVel(body)); }
Vector3 spin(dBodyID body) { return vector(dBodyGetAngularVel(body)); }
Vector3 third_axis(dBodyID body) {
  const dReal* const R = dBodyGetRotation(body);
  return Vector3(R[2], R[6], R[10]);
}
void set_position(dBodyID body, const Vector3& x) { dBodySetPosition(body, real(x.x()), real(x.y()), real(x.z())); }
void set_velocity(dBodyID body, const Vector3& v) { dBodySetLinearVel(body, real(v.x()), real(v.y()), real(v.z())); }
void set_spin(dBodyID body, const Vector3& w) { dBodySetAngularVel(body, real(w.x()), real(w.y()), real(w.z())); }

void turn(dBodyID body, const Vector3& axis, double angle) {
  dMatrix3 R;
  dRFromAxisAndAngle(R, real(axis.x()), real(axis.y()), real(axis.z()), real(angle));
  dBodySetRotation(body, R);
}

Vector3 angular_momentum(dBodyID body) {
  const dMass mass = mass_properties(body);
  const dReal* const w = dBodyGetAngularVel(body);
  dVector3 spin_in_body;
  dBodyVectorFromWorld(body, w[0], w[1], w[2], spin_in_body);
  dVector3 momentum;
  dMultiply0_331(momentum, mass.I, spin_in_body);
  dVector3 world;
  dBodyVectorToWorld(body, momentum[0], momentum[1], momentum[2], world);
  return vector(world);
}

double mass_of(dBodyID body) { return mass_properties(body).mass; }
double translation_energy(dBodyID body) { return 0.5 * mass_of(body) * velocity(body).squaredNorm(); }
double rotation_energy(dBodyID body) { return 0.5 * spin(body).dot(angular_momentum(body)); }

}  // namespace single_bodies
