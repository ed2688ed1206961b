// A shape that records the normals of its evaluations.
#pragma once

#include <vector>

#include "supernormal/shapes/shape.hpp"

namespace supernormal::python {

/// Wraps a shape, returns the same digits, and records the normals of all evaluations. A solver evaluates both bodies once per
/// evaluation of the gap function. So one body records the solver's path, and the library needs no hook.
///
/// A pair of superellipsoids is evaluated together and not by evaluate(), with the same digits
/// (lib/shapes/superellipsoid_batch.hpp). This class is none, so its evaluate() is called. Unlike other shapes it is not pure: use
/// it in one thread.
class RecordingShape final : public Shape {
 public:
  /// Keeps references.
  RecordingShape(const Shape& shape, std::vector<Vector3>& normals) : shape_(shape), normals_(normals) {}

  void evaluate(const Vector3& n, Order order, Jet& jet) const override {
    normals_.push_back(n);
    shape_.evaluate(n, order, jet);
  }

  supernormal::ShapeTraits traits() const override { return shape_.traits(); }
  Vector3 advance_normal(const Vector3& n, const Jet& jet, const Vector3& dn) const override {
    return shape_.advance_normal(n, jet, dn);
  }
  void add_active_vertices(const Vector3& n, const Vector3& toward, ActiveVertices& corners) const override {
    shape_.add_active_vertices(n, toward, corners);
  }
  bool crosses_curved_face(const Vector3& from, const Vector3& to, Vector3& face) const override {
    return shape_.crosses_curved_face(from, to, face);
  }
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
