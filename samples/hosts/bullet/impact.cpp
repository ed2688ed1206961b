// Times of impact by Bullet's three convex casts, beside ours (../impact/comparison.hpp).
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <cstdio>
#include <stdexcept>

#include "../impact/comparison.hpp"
#include "common/bullet_shape.hpp"

namespace {

using namespace supernormal;
using namespace supernormal::bullet_host;
using namespace supernormal::impact_hosts;

btScalar scalar(double value) { return static_cast<btScalar>(value); }

/// Bullet's own shape if it has one, `scale` times as large.
std::shared_ptr<btConvexShape> shape_of(const Shape& shape, double scale) {
  if (const auto* ball = dynamic_cast<const Sphere*>(&shape)) {
    return std::make_shared<btSphereShape>(scalar(scale * ball->radius()));
  }
  if (const auto* capsule = dynamic_cast<const Capsule*>(&shape)) {
    return std::make_shared<btCapsuleShapeZ>(scalar(scale * capsule->radius()), scalar(2 * scale * capsule->half_length()));
  }
  if (const auto* body = dynamic_cast<const Ellipsoid*>(&shape)) {
    return std::make_shared<SmoothShape>(std::make_shared<Ellipsoid>(scale * body->half_axes()));
  }
  if (const auto* body = dynamic_cast<const Superellipsoid*>(&shape)) {
    return std::make_shared<SmoothShape>(
        std::make_shared<Superellipsoid>(scale * body->half_axes(), body->delta(), body->epsilon()));
  }
  std::shared_ptr<btConvexShape> sharp;
  if (const auto* box = dynamic_cast<const Box*>(&shape)) {
    sharp = std::make_shared<btBoxShape>(to_bullet(scale * box->half_lengths()));
  } else if (const auto* can = dynamic_cast<const Cylinder*>(&shape)) {
    sharp = std::make_shared<btCylinderShapeZ>(to_bullet(scale * Vector3(can->radius(), can->radius(), can->half_length())));
  } else {
    throw std::logic_error("no shape of Bullet for this class of shape");
  }
  sharp->setMargin(0);  // with a margin, Bullet would round its edges
  return sharp;
}

struct BulletBody {
  BulletBody(const MovingBody& body, double scale)
      : shape(shape_of(*body.shape, scale)), first(scaled(body.at(0), scale)), last(scaled(body.at(kHorizon), scale)) {}

  static btTransform scaled(Pose pose, double scale) {
    pose.position *= scale;
    return to_bullet(pose);
  }

  std::shared_ptr<btConvexShape> shape;
  btTransform first, last;
};

double time_by(btConvexCast& cast, const BulletBody& one, const BulletBody& other) {
  btConvexCast::CastResult result;
  const bool hits = cast.calcTimeOfImpact(one.first, one.last, other.first, other.last, result);
  return hits ? static_cast<double>(result.m_fraction) * kHorizon : kNoImpact;
}

double time_by_continuous(const BulletBody& one, const BulletBody& other) {
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver depth;
  btContinuousConvexCollision cast(one.shape.get(), other.shape.get(), &simplex, &depth);
  return time_by(cast, one, other);
}

template <class Cast>
double time_by_straight(const BulletBody& one, const BulletBody& other) {
  btVoronoiSimplexSolver simplex;
  Cast cast(one.shape.get(), other.shape.get(), &simplex);
  return time_by(cast, one, other);
}

/// Bullet stops at a gap of 1e-3 of its unit of length. `scale` is the number of these units in a metre.
Contestant contestant(const char* name, double (*search)(const BulletBody&, const BulletBody&), double scale, bool follows_turns) {
  return {name,
          [=](const MovingPair& pair) {
            return [=, one = BulletBody(pair.one, scale), other = BulletBody(pair.other, scale)] { return search(one, other); };
          },
          follows_turns};
}

}  // namespace

int main() {
  std::printf("Bullet in %s precision\n", sizeof(btScalar) == sizeof(float) ? "single" : "double");
  constexpr Bodies kKinds[] = {Bodies::Colliders, Bodies::Ellipsoids, Bodies::Superellipsoids};
  return compare(kKinds, {contestant("btContinuousConvexCollision", time_by_continuous, 1, true),
                          contestant("the same in millimetres", time_by_continuous, 1000, true),
                          contestant("btGjkConvexCast", time_by_straight<btGjkConvexCast>, 1, false),
                          contestant("btSubsimplexConvexCast", time_by_straight<btSubsimplexConvexCast>, 1, false)})
             ? 0
             : 1;
}
