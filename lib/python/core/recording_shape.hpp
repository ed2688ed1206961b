// A shape that records the normals of its evaluations.
#pragma once

#include <vector>

#include "supernormal/shapes/shape.hpp"

namespace supernormal::python {

/// Wraps a shape, returns the same digits, and records the normals of all evaluations. A solver evaluates both bodies once per
/// evaluation of the gap function. So one body records the solver's path, and the library needs no hook.
///
/// It hides that it is a superellipsoid, because two superellipsoids are evaluated together and not by evaluate(). The library
/// promises the same digits either way (Superellipsoid::evaluate_both). Unlike other shapes it is not pure: use it in one thread.
class RecordingShape final : public Shape {
 public:
  /// Keeps references.
  RecordingShape(const Shape& shape, std::vector<Vector3>& normals) : shape_(shape), normals_(normals) {}

  void evaluate(const Vector3& n, Order order, Jet& jet) const override {
    normals_.push_back(n);
    shape_.evaluate(n, order, jet);
  }

  bool has_hessian() const override { return shape_.has_hessian(); }
  Vector3 advance_normal(const Vector3& n, const Jet& jet, const Vector3& dn) const override {
    return shape_.advance_normal(n, jet, dn);
  }
  bool has_flat_faces() const override { return shape_.has_flat_faces(); }
  bool has_axis_aligned_faces() const override { return shape_.has_axis_aligned_faces(); }
  bool has_kinks() const override { return shape_.has_kinks(); }
  void add_active_vertices(const Vector3& n, const Vector3& toward, ActiveVertices& corners) const override {
    shape_.add_active_vertices(n, toward, corners);
  }
  bool crosses_curved_face(const Vector3& from, const Vector3& to, Vector3& face) const override {
    return shape_.crosses_curved_face(from, to, face);
  }
  bool is_round() const override { return shape_.is_round(); }
  bool is_symmetric() const override { return shape_.is_symmetric(); }
  bool surely_contains(const Vector3& point) const override { return shape_.surely_contains(point); }
  Vector3 half_extents() const override { return shape_.half_extents(); }
  double bounding_radius() const override { return shape_.bounding_radius(); }
  double min_curvature_radius_estimate() const override { return shape_.min_curvature_radius_estimate(); }
  double rolling_radius() const override { return shape_.rolling_radius(); }
  MassProperties mass_properties() const override { return shape_.mass_properties(); }

 private:
  const Shape& shape_;
  std::vector<Vector3>& normals_;
};

}  // namespace supernormal::python
