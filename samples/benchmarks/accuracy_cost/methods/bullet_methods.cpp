#include <BulletCollision/CollisionShapes/btConvexInternalShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>

#include "method.hpp"

namespace accuracy_cost {
namespace {

using supernormal::Vector3;

btVector3 to_bullet(const Vector3& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

Vector3 from_bullet(const btVector3& v) {
  return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}

btTransform to_bullet(const supernormal::Pose& pose) {
  btMatrix3x3 basis;
  for (int row = 0; row < 3; ++row) basis[row] = to_bullet(Vector3(pose.rotation.row(row).transpose()));
  return btTransform(basis, to_bullet(pose.position));
}

/// A Supernormal shape as a Bullet shape without a margin.
class BulletShape final : public btConvexInternalShape {
 public:
  explicit BulletShape(const supernormal::Shape& shape) : shape_(shape) {
    m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;
    m_collisionMargin = 0;
  }

  int evaluations() const { return evaluations_; }

  btVector3 localGetSupportingVertexWithoutMargin(const btVector3& direction) const override {
    ++evaluations_;
    supernormal::Jet jet;
    shape_.evaluate(from_bullet(direction), supernormal::Order::Point, jet);  // any length: the point is the same
    return to_bullet(jet.r);
  }
  btVector3 localGetSupportingVertex(const btVector3& direction) const override {
    return localGetSupportingVertexWithoutMargin(direction);
  }
  void batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* directions, btVector3* points, int count) const override {
    for (int i = 0; i < count; ++i) points[i] = localGetSupportingVertexWithoutMargin(directions[i]);
  }
  void getAabb(const btTransform& /*pose*/, btVector3& low, btVector3& high) const override {
    const Vector3 half = shape_.half_extents();
    low = to_bullet(-half);
    high = to_bullet(half);
  }
  void calculateLocalInertia(btScalar /*mass*/, btVector3& inertia) const override { inertia.setZero(); }
  const char* getName() const override { return "Supernormal"; }

 private:
  const supernormal::Shape& shape_;
  mutable int evaluations_ = 0;
};

class BulletGjkEpa final : public Method {
 public:
  BulletGjkEpa() : Method(sizeof(btScalar) == sizeof(float) ? "Bullet GJK+EPA (float)" : "Bullet GJK+EPA (double)") {}

  Answer query(const Pair& pair) const override {
    const BulletShape shape1(*pair.shape1);
    const BulletShape shape2(*pair.shape2);
    btGjkEpaSolver2::sResults results;
    const btVector3 guess = to_bullet(Vector3(pair.pose1.position - pair.pose2.position));
    const bool found =
        btGjkEpaSolver2::SignedDistance(&shape1, to_bullet(pair.pose1), &shape2, to_bullet(pair.pose2), guess, results);
    const double evaluations = 0.5 * (shape1.evaluations() + shape2.evaluations());
    const bool is_apart = results.status == btGjkEpaSolver2::sResults::Separated;
    if (!found && !is_apart) return {Answer::Kind::None, 0, Vector3::UnitX(), evaluations};
    const Vector3 point1 = from_bullet(results.witnesses[0]);
    const Vector3 point2 = from_bullet(results.witnesses[1]);
    // The normal of Bullet points from body 2 to body 1 if the bodies are apart, but its two branches are not consistent. So use
    // the points.
    const Vector3 normal = (is_apart ? 1 : -1) * (point2 - point1).normalized();
    return {Answer::Kind::Gap, static_cast<double>(results.distance), normal, evaluations, 0.5 * (point1 + point2)};
  }
};

}  // namespace

Methods bullet_methods() {
  Methods methods;
  methods.push_back(std::make_unique<BulletGjkEpa>());
  return methods;
}

}  // namespace accuracy_cost
