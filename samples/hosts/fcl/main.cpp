// Random pairs of superellipsoids through FCL's broad phase. The distances come from FCL's GJK with our support functions, and from
// our solver, also with only a support function.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <vector>

#include "smooth_shape.hpp"

namespace {

using namespace supernormal;
using fcl_host::SmoothShape;

struct Found {
  int pairs = 0, apart = 0;
  double worst_to_gjk = 0, worst_to_callback = 0;
};

/// A shape with only its support function and boundary point.
CallbackShape without_hessian(const Shape& shape) {
  return {[&shape](const Vector3& n) { return shape.support(n); }, [&shape](const Vector3& n) { return shape.point(n); }};
}

bool compare(fcl::CollisionObjectd* object1, fcl::CollisionObjectd* object2, void* data) {
  auto& found = *static_cast<Found*>(data);
  const auto& shape1 = static_cast<const SmoothShape&>(*object1->collisionGeometry());
  const auto& shape2 = static_cast<const SmoothShape&>(*object2->collisionGeometry());
  const fcl::Transform3d &pose1 = object1->getTransform(), &pose2 = object2->getTransform();
  const Proximity ours = fcl_host::proximity(shape1, pose1, shape2, pose2);
  const Proximity bare = find_proximity(without_hessian(shape1.shape()), fcl_host::pose_of(pose1), without_hessian(shape2.shape()),
                                        fcl_host::pose_of(pose2));
  ++found.pairs;
  found.worst_to_callback = std::max(found.worst_to_callback, std::abs(ours.gap - bare.gap));
  if (!(ours.gap > 0)) return false;
  ++found.apart;
  fcl::detail::GJKSolver_libccd<double> gjk;
  gjk.distance_tolerance = 1e-9;
  double distance = 0;
  gjk.shapeDistance(shape1, pose1, shape2, pose2, &distance);
  found.worst_to_gjk = std::max(found.worst_to_gjk, std::abs(distance - ours.gap));
  return false;  // continue
}

}  // namespace

int main() {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> uniform;
  std::normal_distribution<double> normal;
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects;
  fcl::DynamicAABBTreeCollisionManagerd manager;
  for (int k = 0; k < 300; ++k) {
    const Vector3 axes = Vector3::Constant(0.5) + Vector3(uniform(engine), uniform(engine), uniform(engine));
    const auto shape = std::make_shared<Superellipsoid>(axes, 1.5 + 4 * uniform(engine), 1.5 + 4 * uniform(engine));
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    pose.linear() =
        Eigen::Quaterniond(normal(engine), normal(engine), normal(engine), normal(engine)).normalized().toRotationMatrix();
    pose.translation() = 12 * Vector3(uniform(engine), uniform(engine), uniform(engine));
    objects.push_back(std::make_unique<fcl::CollisionObjectd>(std::make_shared<SmoothShape>(shape), pose));
    manager.registerObject(objects.back().get());
  }
  manager.setup();
  Found found;
  manager.collide(&found, compare);
  std::printf(
      "%d pairs whose boxes meet, %d of them apart: largest difference to FCL's GJK %.1e m, to our solver without Hessians %.1e "
      "m\n",
      found.pairs, found.apart, found.worst_to_gjk, found.worst_to_callback);
  return found.pairs > 100 && found.worst_to_gjk < 1e-5 && found.worst_to_callback < 1e-8 ? 0 : 1;
}
