#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>

#include "common/bullet_shape.hpp"
#include "method.hpp"

namespace accuracy_cost {
namespace {

using supernormal::Vector3;
using supernormal::bullet_host::from_bullet;
using supernormal::bullet_host::SmoothShape;
using supernormal::bullet_host::to_bullet;

/// One of our shapes, which it refers to, as a shape of Bullet.
class BulletShape final : public SmoothShape {
 public:
  explicit BulletShape(const supernormal::Shape& shape)
      : SmoothShape(std::shared_ptr<const supernormal::Shape>(std::shared_ptr<const supernormal::Shape>(), &shape)) {}

  int evaluations() const { return evaluations_; }

  btVector3 localGetSupportingVertexWithoutMargin(const btVector3& direction) const override {
    ++evaluations_;
    return SmoothShape::localGetSupportingVertexWithoutMargin(direction);
  }

 private:
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
