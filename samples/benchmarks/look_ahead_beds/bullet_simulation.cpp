#include <btBulletDynamicsCommon.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "bed.hpp"

namespace look_ahead_beds {
namespace {

// Bullet uses single precision and absolute lengths: its GJK ends when two support points are within 0.01. With a smallest
// half-axis of 0.5 units this is an overlap of 2e-3 half-axes at every step; with 20 units, 1e-5. Gravity is in this unit, so times
// are the same.
constexpr double kUnit = 0.05 * kSmallestHalfAxis;  // m

// The margin of Bullet in smallest half-axes. The bodies without the margin do not overlap, so that GJK suffices without EPA. They
// are convex as long as the margin is below the smallest radius of curvature, half of this half-axis.
constexpr double kMargin = 0.2;

btScalar scalar(double value) { return static_cast<btScalar>(value); }

class Ellipsoid final : public btConvexInternalShape {
 public:
  explicit Ellipsoid(const std::array<double, 3>& half_axes)
      : axes_(scalar(half_axes[0] / kUnit), scalar(half_axes[1] / kUnit), scalar(half_axes[2] / kUnit)) {
    m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;
    m_collisionMargin = scalar(kMargin) * axes_.z();
  }

  btVector3 localGetSupportingVertexWithoutMargin(const btVector3& direction) const override {
    const btVector3 scaled = axes_ * direction;
    const btScalar length = scaled.length();
    if (!(length > 0)) return {0, 0, axes_.z() - m_collisionMargin};
    return axes_ * scaled / length - m_collisionMargin * direction.normalized();
  }
  void batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* directions, btVector3* points, int count) const override {
    for (int i = 0; i < count; ++i) points[i] = localGetSupportingVertexWithoutMargin(directions[i]);
  }
  void getAabb(const btTransform& pose, btVector3& low, btVector3& high) const override {
    btVector3 half;
    for (int k = 0; k < 3; ++k) half[k] = (pose.getBasis()[k] * axes_).length();
    low = pose.getOrigin() - half;
    high = pose.getOrigin() + half;
  }
  void calculateLocalInertia(btScalar mass, btVector3& inertia) const override {
    const btVector3 square = axes_ * axes_;
    inertia = mass / 5 * btVector3(square.y() + square.z(), square.z() + square.x(), square.x() + square.y());
  }
  const char* getName() const override { return "ellipsoid"; }

 private:
  btVector3 axes_;  // half-axes, units
};

class BulletSimulation final : public Simulation {
 public:
  BulletSimulation(const Bed& bed, const Settings& settings) : step_(scalar(settings.step)) {
    if (bed.exponent != 2) throw std::invalid_argument("Bullet has ellipsoids only, exponent 2");
    world_.setGravity({0, 0, scalar(-kGravity / kUnit)});
    world_.getSolverInfo().m_numIterations = settings.iterations;
    for (const Grain& grain : bed.grains) {
      const auto [a, b, c] = grain.half_axes;
      const Pose& start = grain.start;
      btTransform pose;
      pose.setOrigin(btVector3(scalar(start.position[0]), scalar(start.position[1]), scalar(start.position[2])) / scalar(kUnit));
      pose.setRotation(
          {scalar(start.quaternion[1]), scalar(start.quaternion[2]), scalar(start.quaternion[3]), scalar(start.quaternion[0])});
      shapes_.push_back(std::make_unique<Ellipsoid>(grain.half_axes));
      add(scalar(kDensity * 4 / 3 * std::numbers::pi * a * b * c), pose);
    }
    for (const auto& w : bed.walls()) {
      const btVector3 normal(scalar(w[0]), scalar(w[1]), scalar(w[2]));
      shapes_.push_back(std::make_unique<btStaticPlaneShape>(normal, scalar(w[3] / kUnit)));
      shapes_.back()->setMargin(0);
      add(0, btTransform::getIdentity());
    }
  }

  ~BulletSimulation() override {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }

  void step() override { world_.stepSimulation(step_, 0); }

  Pose pose(std::size_t grain) const override {
    const btTransform& pose = bodies_[grain]->getCenterOfMassTransform();
    const btVector3 p = pose.getOrigin();
    const btQuaternion q = pose.getRotation();
    return {{kUnit * double{p.x()}, kUnit * double{p.y()}, kUnit * double{p.z()}},
            {double{q.w()}, double{q.x()}, double{q.y()}, double{q.z()}}};
  }

 private:
  void add(btScalar mass, const btTransform& pose) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shapes_.back()->calculateLocalInertia(mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shapes_.back().get(), inertia);
    info.m_startWorldTransform = pose;
    info.m_friction = scalar(std::sqrt(kFriction));  // the coefficient of a pair is the product
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    bodies_.back()->setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(bodies_.back().get());
  }

  btScalar step_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broad_phase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broad_phase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

}  // namespace

std::unique_ptr<Simulation> start_bullet(const Bed& bed, const Settings& settings) {
  return std::make_unique<BulletSimulation>(bed, settings);
}

}  // namespace look_ahead_beds
