// Bullet with our bodies. Needs only the core, not ODE.
#pragma once

#include <BulletCollision/CollisionShapes/btConvexInternalShape.h>
#include <LinearMath/btTransform.h>

#include <memory>
#include <supernormal/supernormal.hpp>
#include <utility>

namespace supernormal::bullet_host {

inline btVector3 to_bullet(const Vector3& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

inline btTransform to_bullet(const Pose& pose) {
  btMatrix3x3 basis;
  for (int row = 0; row < 3; ++row) basis[row] = to_bullet(Vector3(pose.rotation.row(row).transpose()));
  return btTransform(basis, to_bullet(pose.position));
}

inline Vector3 from_bullet(const btVector3& v) {
  return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}

/// A shape of ours as a shape of Bullet, by its support function, without a margin.
class SmoothShape : public btConvexInternalShape {
 public:
  explicit SmoothShape(std::shared_ptr<const Shape> shape) : shape_(std::move(shape)) {
    m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;
    m_collisionMargin = 0;
  }

  btVector3 localGetSupportingVertexWithoutMargin(const btVector3& direction) const override {
    Jet jet;
    shape_->evaluate(from_bullet(direction), Order::Point, jet);  // any length gives the same point
    return to_bullet(jet.r);
  }
  btVector3 localGetSupportingVertex(const btVector3& direction) const override {
    return localGetSupportingVertexWithoutMargin(direction);
  }
  void batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* directions, btVector3* points, int count) const override {
    for (int i = 0; i < count; ++i) points[i] = localGetSupportingVertexWithoutMargin(directions[i]);
  }
  void getAabb(const btTransform& pose, btVector3& low, btVector3& high) const override {
    low = high = pose.getOrigin();
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 direction = from_bullet(pose.getBasis()[axis]);
      low[axis] -= static_cast<btScalar>(shape_->support(-direction));
      high[axis] += static_cast<btScalar>(shape_->support(direction));
    }
  }
  void calculateLocalInertia(btScalar mass, btVector3& inertia) const override {
    const MassProperties properties = shape_->mass_properties();
    inertia = mass * to_bullet(Vector3(properties.inertia().diagonal() / properties.volume));
  }
  const char* getName() const override { return "Supernormal"; }

 private:
  std::shared_ptr<const Shape> shape_;
};

}  // namespace supernormal::bullet_host
