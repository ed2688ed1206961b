// Support points of a body in the frame of the surface that it touches.
#pragma once

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The point of the body farthest against a normal of the surface: the deepest point over a plane with this normal.
struct DeepestPoint {
  Vector3 point;      ///< m
  double height = 0;  ///< m; normal . point
};

/// Evaluates support points and counts the evaluations. The frame has the axes of the world and the origin of the body. So a large
/// distance from the world's origin costs no digits, and the normals of a level floor stay exact.
class SupportProbe {
 public:
  SupportProbe(const Shape& shape, const Matrix3& rotation) : shape_(&shape), rotation_(rotation) {}

  /// `normal`: unit, out of the surface. Does the operations of find_plane_proximity() in the same order, for equal digits.
  DeepestPoint deepest(const Vector3& normal) {
    Jet jet;
    shape_->evaluate(-(rotation_.transpose() * normal), Order::Point, jet);
    ++evaluations_;
    return {rotation_ * jet.r, -jet.h};
  }

  const Shape& shape() const { return *shape_; }
  const Matrix3& rotation() const { return rotation_; }

  int evaluations() const { return evaluations_; }
  void count(int evaluations) { evaluations_ += evaluations; }

 private:
  const Shape* shape_;
  Matrix3 rotation_;
  int evaluations_ = 0;
};

}  // namespace supernormal
