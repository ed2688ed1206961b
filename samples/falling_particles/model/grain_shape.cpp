#include "grain_shape.hpp"

#include <Eigen/Geometry>
#include <supernormal/shapes/capsule.hpp>
#include <supernormal/shapes/rounded.hpp>
#include <supernormal/shapes/superellipsoid.hpp>
#include <supernormal/shapes/superovoid.hpp>

namespace falling_particles {
namespace {

using supernormal::Vector3;

std::shared_ptr<const supernormal::Shape> core_of(const ConvexBody& body, double scale) {
  const auto [a, b, c] = body.core_half_axes();
  const Vector3 half_axes = scale * Vector3(a, b, c);
  switch (body.shape) {
    case ConvexBody::Shape::Superovoid:
      return std::make_shared<supernormal::Superovoid>(half_axes, body.delta, body.epsilon, body.taper[0], body.taper[1]);
    case ConvexBody::Shape::Capsule:
      return std::make_shared<supernormal::Capsule>(half_axes.x(), half_axes.z() - half_axes.x());
    case ConvexBody::Shape::Superellipsoid:
      break;
  }
  return std::make_shared<supernormal::Superellipsoid>(half_axes, body.delta, body.epsilon);
}

}  // namespace

std::shared_ptr<const supernormal::Shape> shape_of(const ConvexBody& body, double scale) {
  auto core = core_of(body, scale);
  if (body.rounding == 0) return core;
  return std::make_shared<supernormal::Rounded>(std::move(core), scale * body.rounding);
}

supernormal::Matrix3 lammps_inertia(const GrainKind& kind, double scale, const std::array<double, 4>& quaternion) {
  const Vector3 half_axes = scale * Vector3(kind.half_axes[0], kind.half_axes[1], kind.half_axes[2]);
  const auto [w, x, y, z] = quaternion;
  const supernormal::Matrix3 rotation = Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
  const supernormal::MassProperties unit = supernormal::Superellipsoid(half_axes, kind.delta, kind.epsilon).mass_properties();
  return kind.density * rotation * unit.inertia() * rotation.transpose();
}

double mass_of(const GrainKind& kind) {
  if (kind.compound_mass) return kind.compound_mass->mass;
  return kind.density * shape_of(kind.all_components().front().body)->mass_properties().volume;
}

supernormal::Pose pose_of(const Component& component, double scale) {
  const auto [w, x, y, z] = component.quaternion;
  const auto [px, py, pz] = component.position;
  return {scale * Vector3(px, py, pz), Eigen::Quaterniond(w, x, y, z).toRotationMatrix()};
}

}  // namespace falling_particles
