// DART with real ellipsoids and superellipsoids. Its ODE detector replaces unknown shapes by spheres of 1 cm.
#pragma once

#include <supernormal/supernormal.h>

#include <dart/collision/ode/ode.hpp>
#include <dart/dynamics/dynamics.hpp>
#include <memory>

namespace supernormal::dart_host {

/// A shape that DART does not have; half-axes in m, exponents as in snCreateSuperellipsoid. DART takes its inertia from
/// computeInertia().
class SuperellipsoidShape : public dart::dynamics::Shape {
 public:
  SuperellipsoidShape(const Eigen::Vector3d& half_axes, double delta, double epsilon);

  static const std::string& static_type();
  const std::string& getType() const override { return static_type(); }
  Eigen::Matrix3d computeInertia(double mass) const override;

  /// A geom of this shape, in no space. Throws std::runtime_error with the library's message if the library refuses the parameters.
  dGeomID create_geom() const;

 protected:
  void updateBoundingBox() const override;
  void updateVolume() const override;

 private:
  Eigen::Vector3d half_axes_;
  double delta_, epsilon_;
};

/// DART's ODE detector, except for EllipsoidShape and SuperellipsoidShape. Their geoms are replaced by ours, on the same body, in
/// the same space. Use it like DART's own: world->getConstraintSolver()->setCollisionDetector(SupernormalDetector::create()).
class SupernormalDetector : public dart::collision::OdeCollisionDetector {
 public:
  static std::shared_ptr<SupernormalDetector> create();
  std::unique_ptr<dart::collision::CollisionGroup> createCollisionGroup() override;
  std::shared_ptr<dart::collision::CollisionDetector> cloneWithoutCollisionObjects() const override { return create(); }
};

}  // namespace supernormal::dart_host
