#include "effects/body_forces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "effects/motion.hpp"
#include "ode/geom/body.hpp"
#include "supernormal/shapes/silhouette.hpp"

namespace supernormal::effects {
namespace {

/// Applies a drag of `coefficient` (N s/m) against the velocity at the end of the step. So the drag brings the body to rest at
/// most.
void add_drag(dBodyID body, double coefficient, double step) {
  dMass mass;
  dBodyGetMass(body, &mass);
  const Vector3 velocity = ode::to_vector(dBodyGetLinearVel(body)) + step * acceleration_of(body);
  const Vector3 force = -coefficient / (1 + step * coefficient / mass.mass) * velocity;
  dBodyAddForce(body, ode::to_real(force.x()), ode::to_real(force.y()), ode::to_real(force.z()));
}

/// The unit direction of motion in the geom's frame; the x-axis for a body at rest.
Vector3 heading(dBodyID body, dGeomID geom) {
  const Vector3 velocity = ode::to_vector(dBodyGetLinearVel(body));
  const double speed = velocity.norm();
  if (!(speed > 1e-150)) return Vector3::UnitX();
  return ode::to_rotation(dGeomGetRotation(geom)).transpose() * (velocity / speed);
}

}  // namespace

BodyForces::BodyForces(const std::vector<Effect>& list, double step) : step_(step) {
  EffectIndex drag = 0;
  EffectIndex stokes = 0;
  for (const Effect& effect : list) {
    if (const auto* e = std::get_if<Gravity>(&effect)) gravity_ = e->acceleration;
    if (const auto* e = std::get_if<QuadraticDrag>(&effect)) quadratic_drag_ = *e, drag = effect.index();
    if (const auto* e = std::get_if<StokesDrag>(&effect)) stokes_drag_ = *e, stokes = effect.index();
    if (const auto* e = std::get_if<Buoyancy>(&effect)) {
      buoyancy_ = *e;
      passes_.push_back({effect.index(), &BodyForces::apply_buoyancy});
    }
  }
  // Drag passes come after buoyancy, because drag acts on the velocity that results from the other forces.
  if (quadratic_drag_) passes_.push_back({drag, &BodyForces::apply_quadratic_drag});
  if (stokes_drag_) passes_.push_back({stokes, &BodyForces::apply_stokes_drag});
}

void BodyForces::add(dBodyID body) {
  remove(body);
  Entry entry{body, {}};
  for (dGeomID geom = dBodyGetFirstGeom(body); geom != nullptr; geom = dBodyGetNextGeom(geom)) {
    const ode::Body* const ours = ode::find_body(geom);
    if (ours == nullptr) continue;
    Part part{geom, &ours->shape(), 0, std::nullopt};
    if (stokes_drag_) part.surface = surface_area(ours->shape());
    if (buoyancy_) part.submerged_volume.emplace(ours->shape());
    entry.parts.push_back(std::move(part));
  }
  if (entry.parts.empty()) throw std::invalid_argument("the body has no geom made by snCreate…, but must have one");
  bodies_.push_back(std::move(entry));
}

void BodyForces::remove(dBodyID body) {
  std::erase_if(bodies_, [&](const Entry& entry) { return entry.body == body; });
}

template <typename Force>
unsigned long long BodyForces::visit(const Force& force) {
  unsigned long long visited = 0;
  for (const Entry& entry : bodies_) {
    // ODE would keep the forces on a sleeping body until it wakes.
    if (dBodyIsEnabled(entry.body) == 0) continue;
    ++visited;
    force(entry);
  }
  return visited;
}

unsigned long long BodyForces::apply_buoyancy() {
  const double g = gravity_.norm();
  if (!(g > 0)) return 0;
  const Vector3 up = -gravity_ / g;
  return visit([&](const Entry& entry) {
    for (const Part& part : entry.parts) {
      const Pose pose = ode::pose_of(part.geom);
      const Submerged submerged =
          part.submerged_volume->below(pose.rotation.transpose() * up, buoyancy_->level - up.dot(pose.position));
      if (submerged.volume == 0) continue;
      const Vector3 force = -buoyancy_->density * submerged.volume * gravity_;
      const Vector3 at = pose.rotation * submerged.centre + pose.position;
      add_force(entry.body, force, at);
    }
  });
}

unsigned long long BodyForces::apply_quadratic_drag() {
  return visit([&](const Entry& entry) {
    double area = 0;
    for (const Part& part : entry.parts) area += projected_area(*part.shape, heading(entry.body, part.geom));
    const double speed = ode::to_vector(dBodyGetLinearVel(entry.body)).norm();
    add_drag(entry.body, 0.5 * quadratic_drag_->density * quadratic_drag_->coefficient * area * speed, step_);
  });
}

unsigned long long BodyForces::apply_stokes_drag() {
  return visit([&](const Entry& entry) {
    double coefficient = 0;
    for (const Part& part : entry.parts) {
      const double area = projected_area(*part.shape, heading(entry.body, part.geom));
      const double diameter = std::sqrt(4 * area / std::numbers::pi) / 3 + 2 * std::sqrt(part.surface / std::numbers::pi) / 3;
      coefficient += 3 * std::numbers::pi * stokes_drag_->viscosity * diameter;
    }
    add_drag(entry.body, coefficient, step_);
  });
}

}  // namespace supernormal::effects
