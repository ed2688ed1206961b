// The core below a broad phase that exists: FCL's dynamic AABB tree. It moves bodies and reports which overlap, and how far smooth
// bodies are apart by FCL's GJK with our support functions and by our solver with only a support function.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "smooth_shape.hpp"

namespace {

using namespace supernormal;

struct Placed {
  std::shared_ptr<const Shape> shape;
  Pose pose;
};

/// Whether distances by other means have all their digits: the boundary has neither faces nor edges.
bool is_smooth(const Shape& shape) {
  return dynamic_cast<const Ellipsoid*>(&shape) != nullptr || dynamic_cast<const Superellipsoid*>(&shape) != nullptr ||
         dynamic_cast<const Superovoid*>(&shape) != nullptr;
}

/// A shape with only its support function and boundary point.
CallbackShape without_hessian(const Shape& shape) {
  return {[&shape](const Vector3& n) { return shape.support(n); }, [&shape](const Vector3& n) { return shape.point(n); }};
}

std::vector<Placed> draw_bodies(int count) {
  const std::array<std::shared_ptr<const Shape>, 6> kinds = {
      std::make_shared<Ellipsoid>(Vector3(0.5, 0.3, 0.2)),
      std::make_shared<Superellipsoid>(Vector3(0.3, 0.3, 0.2), 6, 4),
      std::make_shared<Superovoid>(Vector3(0.3, 0.3, 0.4), 2, 2, 0.3, 0.3),
      std::make_shared<Box>(Vector3(0.4, 0.2, 0.1)),
      std::make_shared<Rounded>(std::make_shared<Cylinder>(0.2, 0.2), 0.05),
      std::make_shared<MinkowskiSum>(std::make_shared<Capsule>(0.1, 0.3), std::make_shared<Box>(Vector3(0.1, 0.1, 0))),
  };
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> uniform(-2.5, 2.5);
  std::normal_distribution<double> gauss;
  std::vector<Placed> bodies;
  for (int k = 0; k < count; ++k) {
    Pose pose;
    pose.position = {uniform(engine), uniform(engine), uniform(engine)};
    pose.rotation = Eigen::Quaterniond(gauss(engine), gauss(engine), gauss(engine), gauss(engine)).normalized().toRotationMatrix();
    bodies.push_back({kinds[static_cast<std::size_t>(k) % kinds.size()], pose});
  }
  return bodies;
}

/// The bodies in FCL's tree, and the last normal of each pair.
class Scene {
 public:
  explicit Scene(std::vector<Placed> bodies) : bodies_(std::move(bodies)) {
    for (Placed& body : bodies_) {
      auto object = std::make_unique<fcl::CollisionObjectd>(std::make_shared<fcl_host::SmoothShape>(body.shape));
      object->setUserData(&body);
      move(*object, body.pose);
      tree_.registerObject(object.get());
      objects_.push_back(std::move(object));
    }
    tree_.setup();
  }

  /// Rotates every body by a small angle about the vertical axis through the origin, the faster the farther outside.
  void stir(double angle) {
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      Pose& pose = bodies_[k].pose;
      const Matrix3 turn = Eigen::AngleAxisd(angle * pose.position.norm(), Vector3::UnitZ()).toRotationMatrix();
      pose = {turn * pose.position, turn * pose.rotation};
      move(*objects_[k], pose);
    }
    tree_.update();
  }

  void collide() {
    pairs = overlaps = evaluations = 0;
    deepest = 0;
    tree_.collide(this, [](fcl::CollisionObjectd* one, fcl::CollisionObjectd* other, void* scene) {
      static_cast<Scene*>(scene)->collide(*static_cast<Placed*>(one->getUserData()), *static_cast<Placed*>(other->getUserData()));
      return false;  // go on
    });
  }

  /// Compares the distances of smooth bodies with those by FCL's GJK, and by our solver without Hessians.
  void compare() {
    tree_.collide(this, [](fcl::CollisionObjectd* one, fcl::CollisionObjectd* other, void* scene) {
      static_cast<Scene*>(scene)->compare(*one, *other);
      return false;  // go on
    });
  }

  const std::vector<Placed>& bodies() const { return bodies_; }

  int pairs = 0, overlaps = 0, evaluations = 0;
  double deepest = 0;  // m
  int compared = 0;
  double worst_to_gjk = 0, worst_to_callback = 0;  // m

 private:
  static void move(fcl::CollisionObjectd& object, const Pose& pose) {
    object.setTransform(pose.rotation, pose.position);
    object.computeAABB();
  }

  void collide(const Placed& one, const Placed& other) {
    const Placed* const first = std::min(&one, &other);
    const Placed* const second = std::max(&one, &other);
    // The normal of the last step, in the frame of the first body, is where this query starts. Who only asks about overlaps stops
    // at the first normal that separates.
    const auto known = normals_.find({first, second});
    const Vector3* const start = known == normals_.end() ? nullptr : &known->second;
    const Settings settings{.stop_when_apart = true};
    const Proximity found = find_proximity(*first->shape, first->pose, *second->shape, second->pose, settings, start);
    normals_[{first, second}] = first->pose.rotation.transpose() * found.normal;
    ++pairs;
    evaluations += found.evaluations;
    if (found.gap < 0) ++overlaps;
    deepest = std::max(deepest, -found.gap);
  }

  void compare(const fcl::CollisionObjectd& one, const fcl::CollisionObjectd& other) {
    const auto& shape1 = static_cast<const fcl_host::SmoothShape&>(*one.collisionGeometry());
    const auto& shape2 = static_cast<const fcl_host::SmoothShape&>(*other.collisionGeometry());
    if (!is_smooth(shape1.shape()) || !is_smooth(shape2.shape())) return;
    const fcl::Transform3d &pose1 = one.getTransform(), &pose2 = other.getTransform();
    const Proximity ours = fcl_host::proximity(shape1, pose1, shape2, pose2);
    const Proximity bare = find_proximity(without_hessian(shape1.shape()), fcl_host::pose_of(pose1),
                                          without_hessian(shape2.shape()), fcl_host::pose_of(pose2));
    worst_to_callback = std::max(worst_to_callback, std::abs(ours.gap - bare.gap));
    if (!(ours.gap > 0)) return;
    ++compared;
    fcl::detail::GJKSolver_libccd<double> gjk;
    gjk.distance_tolerance = 1e-9;
    double distance = 0;
    gjk.shapeDistance(shape1, pose1, shape2, pose2, &distance);
    worst_to_gjk = std::max(worst_to_gjk, std::abs(distance - ours.gap));
  }

  std::vector<Placed> bodies_;
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects_;
  fcl::DynamicAABBTreeCollisionManagerd tree_;
  std::map<std::pair<const Placed*, const Placed*>, Vector3> normals_;
};

/// Overlaps without a broad phase: every pair.
int count_overlaps(const std::vector<Placed>& bodies) {
  int overlaps = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const auto found =
          find_proximity(*bodies[i].shape, bodies[i].pose, *bodies[j].shape, bodies[j].pose, {.stop_when_apart = true});
      if (found.gap < 0) ++overlaps;
    }
  }
  return overlaps;
}

/// Whether the tree misses no overlap, and FCL's GJK agrees.
bool run() {
  const std::vector<Placed> drawn = draw_bodies(500);
  Scene scene(drawn);
  for (int step = 0; step < 5; ++step) {
    scene.collide();
    std::printf("step %d: %d of %zu pairs have boxes that meet, %d overlap, the deepest by %.4f m; %.2f evaluations a pair\n", step,
                scene.pairs, drawn.size() * (drawn.size() - 1) / 2, scene.overlaps, scene.deepest,
                double(scene.evaluations) / scene.pairs);
    if (step < 4) scene.stir(0.002);
  }
  const int every_pair = count_overlaps(scene.bodies());
  scene.compare();
  std::printf(
      "without the tree %d pairs overlap\n%d smooth pairs apart: largest difference to FCL's GJK %.1e m, to our solver "
      "without Hessians %.1e m\n",
      every_pair, scene.compared, scene.worst_to_gjk, scene.worst_to_callback);
  const bool agree = scene.worst_to_gjk < 1e-5 && scene.worst_to_callback < 1e-8;
  return agree && every_pair == scene.overlaps && scene.overlaps > 0;
}

}  // namespace

int main() {
  try {
    return run() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fcl_host: %s\n", error.what());
    return 2;
  }
}
