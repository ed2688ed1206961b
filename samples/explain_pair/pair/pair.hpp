// The two bodies in a picture.
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

/// A body in its pose.
struct PlacedBody {
  std::string description;
  std::shared_ptr<const Shape> shape;
  Pose pose;

  /// The extent of the body from the world's origin along a unit vector, m.
  double reach(const Vector3& direction) const {
    return pose.position.dot(direction) + shape->support(pose.rotation.transpose() * direction);
  }
  /// The boundary point with this outward unit normal, m. Both are in the world frame.
  Vector3 point(const Vector3& normal) const {
    return pose.position + pose.rotation * shape->point(pose.rotation.transpose() * normal);
  }
};

struct Pair {
  std::string title;
  PlacedBody body1, body2;
  std::optional<Vector3> first_normal = {};  ///< unit, frame of body 1; the start of the solvers, if prescribed
};

}  // namespace explain_pair
