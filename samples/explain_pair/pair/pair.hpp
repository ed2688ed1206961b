// The two bodies that a picture explains.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <supernormal/proximity/pose.hpp>
#include <supernormal/shapes/shape.hpp>

namespace explain_pair {

using supernormal::Matrix3;
using supernormal::Pose;
using supernormal::Shape;
using supernormal::Vector3;

/// A body in its place.
struct PlacedBody {
  std::string description;
  std::shared_ptr<const Shape> shape;
  Pose pose;

  /// m; how far the body reaches from the world's origin along the unit vector.
  double reach(const Vector3& direction) const {
    return pose.position.dot(direction) + shape->support(pose.rotation.transpose() * direction);
  }
  /// m, world frame; the boundary point with that outward unit normal, which is in the world frame, too.
  Vector3 point(const Vector3& normal) const {
    return pose.position + pose.rotation * shape->point(pose.rotation.transpose() * normal);
  }
};

struct Pair {
  std::string title;
  PlacedBody body1, body2;
  std::optional<Vector3> first_normal = {};  ///< unit, body 1's frame; where the solvers start, if it is prescribed
};

}  // namespace explain_pair
