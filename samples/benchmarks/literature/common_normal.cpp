#include <array>

#include "method.hpp"
#include "newton_step.hpp"

namespace literature {
namespace {

std::array<Vector2, 2> angles_of(const Bodies& bodies, const Vector3& normal) {
  return {bodies.body1.angles_of(normal), bodies.body2.angles_of(-(bodies.rotation.transpose() * normal))};
}

/// The angles of two starting points, in one evaluation: those with normals along Options::first_normal if given, otherwise along
/// the line of the centres.
std::array<Vector2, 2> start_angles(const Bodies& bodies, const Options& options) {
  if (options.first_normal != nullptr) return angles_of(bodies, *options.first_normal);
  const double distance = bodies.offset.norm();
  return angles_of(bodies, distance > 0 ? Vector3(bodies.offset / distance) : Vector3::UnitX());
}

}  // namespace

CommonNormal common_normal_points(const Bodies& bodies, const Options& options) {
  int evaluations = 1;
  const std::array<Vector2, 2> angles = start_angles(bodies, options);
  Vector3 p = bodies.body1.point(angles[0]);  // each in its body's frame
  Vector3 q = bodies.body2.point(angles[1]);
  Eigen::Matrix<double, 6, 1> residual;
  Eigen::Matrix<double, 6, 6> jacobian;
  for (int iteration = 0; iteration < options.max_iterations; ++iteration) {
    const Implicit f1 = bodies.body1.implicit(p);
    const Implicit f2 = bodies.body2.implicit(q);
    ++evaluations;
    const Normalized<3> n1(f1.gradient, f1.hessian);
    const Normalized<3> n2(f2.gradient, f2.hessian);
    if (options.path != nullptr) options.path->push_back(n1.vector);
    const Tangents tangents = tangents_of(n2.vector);
    const Vector3 d = bodies.rotation * q + bodies.offset - p;
    for (int k = 0; k < 2; ++k) {
      const auto which = static_cast<std::size_t>(k);
      const Vector3 t = bodies.rotation * tangents.tangent[which];
      const Matrix3 t_rate = bodies.rotation * tangents.rate[which] * n2.rate;  // by q
      residual[k] = n1.vector.dot(t);
      jacobian.block<1, 3>(k, 0) = t.transpose() * n1.rate;
      jacobian.block<1, 3>(k, 3) = n1.vector.transpose() * t_rate;
      residual[2 + k] = d.dot(t);
      jacobian.block<1, 3>(2 + k, 0) = -t.transpose();
      jacobian.block<1, 3>(2 + k, 3) = t.transpose() * bodies.rotation + d.transpose() * t_rate;
    }
    residual[4] = f1.value;
    residual[5] = f2.value;
    jacobian.row(4) << f1.gradient.transpose(), Eigen::RowVector3d::Zero();
    jacobian.row(5) << Eigen::RowVector3d::Zero(), f2.gradient.transpose();
    const auto step = newton_step(jacobian, residual);
    if (!step) break;
    p -= step->head<3>();
    q -= step->tail<3>();
    const double accuracy = options.tolerance * bodies.size();
    if (step->norm() > accuracy) continue;
    return judged(bodies, p, n1.vector, bodies.rotation * q + bodies.offset, bodies.rotation * n2.vector, accuracy, evaluations);
  }
  return {.evaluations = evaluations};
}

CommonNormal common_normal_angles(const Bodies& bodies, const Options& options) {
  int evaluations = 1;
  std::array<Vector2, 2> angles = start_angles(bodies, options);
  Eigen::Vector4d residual;
  Eigen::Matrix4d jacobian;
  for (int iteration = 0; iteration < options.max_iterations; ++iteration) {
    const SurfacePoint surface1 = bodies.body1.surface(angles[0]);
    const SurfacePoint surface2 = bodies.body2.surface(angles[1]);
    ++evaluations;
    const Normalized<2> n1(surface1.normal, surface1.normal_rate);
    const Normalized<2> n2(surface2.normal, surface2.normal_rate);
    if (options.path != nullptr) options.path->push_back(n1.vector);
    const Tangents tangents = tangents_of(n2.vector);
    const Vector3 point2 = bodies.rotation * surface2.point + bodies.offset;
    const Vector3 d = point2 - surface1.point;
    const Matrix32 d_rate = bodies.rotation * surface2.point_rate;  // by the angles of body 2
    for (int k = 0; k < 2; ++k) {
      const auto which = static_cast<std::size_t>(k);
      const Vector3 t = bodies.rotation * tangents.tangent[which];
      const Matrix32 t_rate = bodies.rotation * (tangents.rate[which] * n2.rate);
      residual[k] = n1.vector.dot(t);
      jacobian.block<1, 2>(k, 0) = t.transpose() * n1.rate;
      jacobian.block<1, 2>(k, 2) = n1.vector.transpose() * t_rate;
      residual[2 + k] = d.dot(t);
      jacobian.block<1, 2>(2 + k, 0) = -t.transpose() * surface1.point_rate;
      jacobian.block<1, 2>(2 + k, 2) = t.transpose() * d_rate + d.transpose() * t_rate;
    }
    const auto step = newton_step(jacobian, residual);
    if (!step) break;
    angles[0] -= step->head<2>();
    angles[1] -= step->tail<2>();
    if (step->norm() > options.tolerance) continue;
    return judged(bodies, surface1.point, n1.vector, point2, bodies.rotation * n2.vector, options.tolerance * bodies.size(),
                  evaluations);
  }
  return {.evaluations = evaluations};
}

}  // namespace literature
