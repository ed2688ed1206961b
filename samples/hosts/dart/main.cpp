// Bodies at rest on a floor in DART, with its own ODE detector and with ours. Half-axes of (0.2, 0.1, 0.1) m rest at 0.1 m.
#include <cmath>
#include <cstdio>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/simulation/World.hpp>
#include <string>
#include <utility>

#include "supernormal_detector.hpp"

namespace {

using dart::dynamics::ShapePtr;
using namespace supernormal::dart_host;

dart::dynamics::SkeletonPtr make_floor() {
  auto skeleton = dart::dynamics::Skeleton::create("floor");
  auto* node = skeleton->createJointAndBodyNodePair<dart::dynamics::WeldJoint>().second;
  node->createShapeNodeWith<dart::dynamics::CollisionAspect, dart::dynamics::DynamicsAspect>(
      std::make_shared<dart::dynamics::BoxShape>(Eigen::Vector3d(10, 10, 0.2)));
  Eigen::Isometry3d below = Eigen::Isometry3d::Identity();
  below.translation().z() = -0.1;
  node->getParentJoint()->setTransformFromParentBodyNode(below);
  return skeleton;
}

dart::dynamics::SkeletonPtr make_body(const ShapePtr& shape, double height) {
  auto skeleton = dart::dynamics::Skeleton::create("body");
  auto [joint, node] = skeleton->createJointAndBodyNodePair<dart::dynamics::FreeJoint>();
  node->createShapeNodeWith<dart::dynamics::CollisionAspect, dart::dynamics::DynamicsAspect>(shape);
  dart::dynamics::Inertia inertia;
  inertia.setMass(1);
  inertia.setMoment(shape->computeInertia(1));
  node->setInertia(inertia);
  Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  start.translation().z() = height;
  joint->setRelativeTransform(start);
  return skeleton;
}

/// The height, m, of a body two seconds after its release slightly above its rest.
double rest_height(const ShapePtr& shape, const dart::collision::CollisionDetectorPtr& detector) {
  auto world = dart::simulation::World::create();
  world->getConstraintSolver()->setCollisionDetector(detector);
  world->setTimeStep(1e-3);
  world->addSkeleton(make_floor());
  const auto body = make_body(shape, 0.11);
  world->addSkeleton(body);
  for (int step = 0; step < 2000; ++step) world->step();
  return body->getBodyNode(0)->getTransform().translation().z();
}

bool rests_at(const char* name, const ShapePtr& shape, double expected) {
  const double theirs = rest_height(shape, dart::collision::OdeCollisionDetector::create());
  const double ours = rest_height(shape, SupernormalDetector::create());
  std::printf("%-34s rests at %.4f m (DART's own detector: %.4f m); expected: %.4f m\n", name, ours, theirs, expected);
  return std::abs(ours - expected) < 1e-3;
}

}  // namespace

int main() {
  const auto ellipsoid = std::make_shared<dart::dynamics::EllipsoidShape>(Eigen::Vector3d(0.4, 0.2, 0.2));  // diameters
  const auto brick = std::make_shared<SuperellipsoidShape>(Eigen::Vector3d(0.2, 0.1, 0.1), 20, 20);
  const bool all_rest =
      rests_at("ellipsoid (0.2, 0.1, 0.1) m", ellipsoid, 0.1) & rests_at("superellipsoid, exponents 20", brick, 0.1);
  // DART's detectors have released their references on ODE by now. Ours still holds one.
  dGeomID sphere = snCreateEllipsoid(nullptr, 1, 1, 1);
  const bool survives = sphere != nullptr;
  if (survives) dGeomDestroy(sphere);
  std::puts(survives ? "a geom can still be made when DART has closed ODE" : snLastError());
  return all_rest && survives ? 0 : 1;
}
