#include "kernel/particle_shape.hpp"

#include <algorithm>
#include <cmath>

namespace granular {

double bounding_radius(const Vector3& half_axes, double delta, double epsilon) {
  return farthest(farthest(half_axes.x(), half_axes.y(), delta), half_axes.z(), epsilon);
}

ParticleShape::ParticleShape(const Vector3& half_axes, double delta, double epsilon)
    : body(half_axes, delta, epsilon),
      bounding_radius(granular::bounding_radius(half_axes, delta, epsilon)),
      width(half_axes.mean()),
      least_half_axis(half_axes.minCoeff()),
      faces(find_faces(body)),
      sides(find_sides(body)) {
  const supernormal::MassProperties mass = body.mass_properties();
  volume = mass.volume;
  unit_inertia = mass.inertia().diagonal() / mass.volume;
  for (const Face& face : faces) {
    bulge = std::max(bulge, face.bulge);
    for (int k = 0; k < face.count; ++k) {
      bounding_radius = std::max(bounding_radius, std::hypot(face.height, face.vertices.at(static_cast<std::size_t>(k)).norm()));
    }
  }
  for (const Side& side : sides) {
    bulge = std::max(bulge, side.bulge);
    const double reach = side.across == side.along
                             ? std::hypot(farthest(half_axes.x(), half_axes.y(), delta), side.reach)
                             : farthest(std::hypot(half_axes[side.across], side.reach), half_axes.z(), epsilon);
    bounding_radius = std::max(bounding_radius, reach);
  }
}

Eigen::Quaterniond rotate_freely(const Eigen::Quaterniond& orientation, const Vector3& angular_momentum, const Vector3& inertia,
                                 double step) {
  Eigen::Quaterniond q = orientation;
  Vector3 momentum = q.conjugate() * angular_momentum;  // in the body's frame
  const auto turn = [&](int axis, double duration) {
    const Eigen::Quaterniond part(Eigen::AngleAxisd(duration * momentum[axis] / inertia[axis], Vector3::Unit(axis)));
    q = q * part;
    momentum = part.conjugate() * momentum;
  };
  turn(0, 0.5 * step);
  turn(1, 0.5 * step);
  turn(2, step);
  turn(1, 0.5 * step);
  turn(0, 0.5 * step);
  return q.normalized();
}

}  // namespace granular
