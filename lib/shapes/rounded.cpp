#include "supernormal/shapes/rounded.hpp"

#include <stdexcept>
#include <utility>

#include "base/validation.hpp"

namespace supernormal {

Rounded::Rounded(std::shared_ptr<const Shape> core, double radius) : core_(std::move(core)), radius_(radius) {
  if (!core_) throw std::invalid_argument("core is null; a shape is needed");
  require_in("radius", radius, 0, kMaxLength, "m");
}

ShapeTraits Rounded::traits() const {
  ShapeTraits traits = core_->traits();
  traits.has_axis_aligned_faces = false;
  return traits;
}

void Rounded::evaluate(const Vector3& n, Order order, Jet& jet) const {
  core_->evaluate(n, order, jet);
  jet.h += radius_;
  if (order == Order::Value) return;
  jet.r += radius_ * n;
  if (order == Order::Point || !traits().has_hessian) return;
  jet.H += radius_ * (Matrix3::Identity() - n * n.transpose());
}

Vector3 Rounded::advance_normal(const Vector3& n, const Jet& jet, const Vector3& dn) const {
  if (!traits().has_flat_faces) return Shape::advance_normal(n, jet, dn);
  // The core's point moves by H_core dn, and the sphere's point by radius dn. The sphere's point follows any normal, so the core
  // decides.
  Jet core_jet;
  core_jet.h = jet.h - radius_;
  core_jet.r = jet.r - radius_ * n;
  core_jet.H = jet.H - radius_ * (Matrix3::Identity() - n * n.transpose());
  return core_->advance_normal(n, core_jet, dn);
}

// The sphere's boundary point, radius n, is the same for all active vertices, as in a Capsule. It moves with the normal. So a
// partial list counts as complete here, because a partial list must hold the same points for every normal.
void Rounded::add_active_vertices(const Vector3& n, const Vector3& toward, ActiveVertices& vertices) const {
  ActiveVertices of_core;
  core_->add_active_vertices(n, toward - radius_ * n, of_core);
  for (int k = 0; k < of_core.size(); ++k) vertices.add(of_core[k] + radius_ * n);
}

bool Rounded::crosses_curved_face(const Vector3& from, const Vector3& to, Vector3& face) const {
  return core_->crosses_curved_face(from, to, face);
}

bool Rounded::surely_contains(const Vector3& point) const { return core_->surely_contains(point); }

Vector3 Rounded::half_extents() const { return core_->half_extents() + Vector3::Constant(radius_); }

double Rounded::min_curvature_radius_estimate() const { return core_->min_curvature_radius_estimate() + radius_; }

void Rounded::add_parameter_gradient(const Vector3& n, const Vector3& r, ParameterGradient& gradient) const {
  core_->add_parameter_gradient(n, r - radius_ * n, gradient);
  gradient.add("radius", 1);
}

}  // namespace supernormal
