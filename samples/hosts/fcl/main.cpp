// The core below a broad phase that exists: FCL's dynamic AABB tree. It moves bodies and reports which overlap. Needs only the
// core, not ODE.
#include <fcl/fcl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <memory>
#include <random>
#include <supernormal/supernormal.hpp>
#include <utility>
#include <vector>

namespace {

using namespace supernormal;

struct Placed {
  std::shared_ptr<const Shape> shape;
  Pose pose;
};

/// A shape of ours as a geometry of FCL's broad phase.
class SmoothShape : public fcl::ShapeBased {
 public:
  explicit SmoothShape(std::shared_ptr<const Shape> shape) : shape_(std::move(shape)) { SmoothShape::computeLocalAABB(); }

  void computeLocalAABB() override {
    const Vector3 most = shape_->half_extents();
    aabb_local = fcl::AABBd(-most, most);
    aabb_center = aabb_local.center();
    aabb_radius = most.norm();
  }
  fcl::NODE_TYPE getNodeType() const override { return fcl::GEOM_CONVEX; }

 private:
  std::shared_ptr<const Shape> shape_;
};

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
      auto object = std::make_unique<fcl::CollisionObjectd>(std::make_shared<SmoothShape>(body.shape));
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

  const std::vector<Placed>& bodies() const { return bodies_; }

  int pairs = 0, overlaps = 0, evaluations = 0;
  double deepest = 0;  // m

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

/// Whether the tree misses no overlap.
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
  std::printf("without the tree %d pairs overlap\n", every_pair);
  return every_pair == scene.overlaps && scene.overlaps > 0;
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
