// FCL with our bodies, and our solver for shapes that have only a support function. Needs only the core, not ODE.
#pragma once

#include <fcl/fcl.h>

#include <memory>
#include <supernormal/supernormal.hpp>
#include <utility>

namespace supernormal::fcl_host {

/// A shape of ours as a geometry of FCL. FCL's broad phase accepts it like any other. FCL's narrow phase looks shapes up in its own
/// table, so call it with the shape's type: fcl::detail::GJKSolver_libccd<double>().shapeDistance(shape, pose, …).
class SmoothShape : public fcl::ShapeBased {
 public:
  explicit SmoothShape(std::shared_ptr<const Shape> shape) : shape_(std::move(shape)) { SmoothShape::computeLocalAABB(); }

  const Shape& shape() const { return *shape_; }

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

inline Pose pose_of(const fcl::Transform3d& transform) { return {transform.translation(), transform.linear()}; }

/// Gap, witness points and common normal of two of our shapes, by our solver, for a callback of FCL's broad phase.
inline Proximity proximity(const SmoothShape& shape1, const fcl::Transform3d& pose1, const SmoothShape& shape2,
                           const fcl::Transform3d& pose2) {
  return find_proximity(shape1.shape(), pose_of(pose1), shape2.shape(), pose_of(pose2));
}

}  // namespace supernormal::fcl_host

namespace fcl::detail {

/// The support function of a shape of ours, for FCL's GJK and EPA.
template <>
class GJKInitializer<double, supernormal::fcl_host::SmoothShape> {
 public:
  using SmoothShape = supernormal::fcl_host::SmoothShape;
  struct Placed {
    const supernormal::Shape* shape;
    Transform3d pose;
  };

  // NOLINTBEGIN(readability-identifier-naming): the names that FCL calls
  static GJKSupportFunction getSupportFunction() {
    return [](const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
      const auto& [shape, pose] = *static_cast<const Placed*>(object);
      const Vector3d n = Vector3d(direction->v[0], direction->v[1], direction->v[2]).normalized();
      const Vector3d found = pose * shape->point(pose.linear().transpose() * n);
      ccdVec3Set(point, found.x(), found.y(), found.z());
    };
  }
  static GJKCenterFunction getCenterFunction() {
    return [](const void* object, ccd_vec3_t* centre) {
      const Vector3d found = static_cast<const Placed*>(object)->pose.translation();
      ccdVec3Set(centre, found.x(), found.y(), found.z());
    };
  }
  static void* createGJKObject(const SmoothShape& shape, const Transform3d& pose) { return new Placed{&shape.shape(), pose}; }
  static void deleteGJKObject(void* object) { delete static_cast<Placed*>(object); }
  // NOLINTEND(readability-identifier-naming)
};

}  // namespace fcl::detail
