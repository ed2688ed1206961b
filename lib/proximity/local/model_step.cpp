#include "proximity/local/model_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/finite.hpp"
#include "proximity/gap/tuning.hpp"
#include "proximity/local/strict_complementarity.hpp"

namespace supernormal {
namespace {

// In units of the bodies' size: beyond this, a radius of curvature belongs to a flat face, where a tilt of the normal is only
// rounding error.
constexpr double kFlatRadius = 1e8;

// Sine: a direction this near to the plane of another has no gnomonic coordinates beyond rounding.
constexpr double kBesidePlane = 1e-15;

/// Combines the bodies' proposals u1 and u2, each weighted by the body's radii of curvature: (A1 + A2)^-1 (A1 u1 + A2 u2). It is
/// computed as the flatter body's proposal plus the rounder body's change. At an edge the sum is singular, and the flatter body's
/// proposal counts alone.
Vector2 blend(const Symmetric2& A1, const Symmetric2& A2, const Vector2& u1, const Vector2& u2) {
  const bool is_first_flatter = A1.trace() > A2.trace();
  const Vector2& flat = is_first_flatter ? u1 : u2;
  const Vector2 pull = is_first_flatter ? A2 * (u2 - u1) : A1 * (u1 - u2);
  const Vector2 change = (A1 + A2).solve(pull);
  return all_finite(change) ? Vector2(flat + change) : flat;
}

/// The gnomonic coordinates of a direction. Returns false if it is not on the side of the plane's normal, or is nearly in the
/// plane.
bool to_plane(const TangentPlane& plane, const Vector3& direction, Vector2& u) {
  const double height = direction.dot(plane.n);
  if (!(height > kBesidePlane * direction.norm())) return false;
  u = plane.project(direction) / height;
  return true;
}

/// Whether the body may have flat faces that are not across the axes of its frame.
bool may_be_tilted(const ShapeTraits& traits) { return traits.has_flat_faces && !traits.has_axis_aligned_faces; }

}  // namespace

ModelStep::ModelStep(const GapFunction& gap, VertexCache& vertices, CuttingPlanes& cuts)
    : gap_(gap),
      vertices_(vertices),
      cuts_(cuts),
      has_flat_faces_(gap.has_hessian() && (gap.traits1().has_flat_faces || gap.traits2().has_flat_faces)),
      may_be_tilted_(may_be_tilted(gap.traits1()) || may_be_tilted(gap.traits2())) {}

LocalModel ModelStep::local_model(const GapJet& jet, const BfgsHessian& bfgs) const {
  return gap_.has_hessian() ? LocalModel::of(gap_, jet) : LocalModel::of(gap_, jet, bfgs.matrix());
}

Step ModelStep::propose(const GapJet& jet, const ActiveVertices& active, const BfgsHessian& bfgs, double radius) {
  leaves_face_ = false;
  const LocalModel local = local_model(jet, bfgs);
  return gap_.traits2().has_nonsmooth_points ? nonsmooth_step(jet, local, active, radius) : smooth_step(jet, local, radius);
}

Step ModelStep::smooth_step(const GapJet& jet, const LocalModel& local, double radius) {
  const auto [newton, whole_gain] = local.model.peak(radius, gap_.rounding());
  Step step{jet.n + local.plane1.lift(newton), newton.norm(), std::max(local.model.gain(newton), 0.0),
            kTuning.gain_safety * whole_gain};
  if (has_flat_faces_ && !parametrizations_agree(jet, local, newton)) {
    leaves_face_ = flat_step(jet, local, {0, local.model.g, newton, nullptr}, radius, step) == FlatStep::LeavesFace;
  }
  return step;
}

Step ModelStep::nonsmooth_step(const GapJet& jet, const LocalModel& local, const ActiveVertices& active, double radius) {
  const std::span<const Piece> pieces = vertices_.pieces(jet, active, local.plane1);
  const StrictComplementarity complementarity(gap_.rounding(), gap_.length_unit());
  PiecewiseModel model{pieces, complementarity.reduced_hessian(local.model.A, pieces)};
  bool is_concave = Eigen2(model.A).low > 0;
  PiecewiseModel::Peak peak;
  if (is_concave) {
    peak = model.maximize();
    if (model.A != local.model.A && !complementarity.is_strict(peak, pieces, local.model.A)) {
      model.A = local.model.A;
      is_concave = false;
    }
  }
  // The model is 0 at u = 0. If its matrix is nearly singular, rounding may leave it without a maximum that is at least 0.
  const bool has_maximum = is_concave && peak.gain >= -gap_.rounding();
  const double whole_gain = has_maximum ? std::max(peak.gain, 0.0) : std::numeric_limits<double>::infinity();
  if (!is_concave || peak.u.norm() > radius) peak = model.maximize(radius);

  Target target = target_of(jet, local, peak, pieces);
  const Vector3 normal = vertices_.shared_normal(peak, jet.n + local.plane1.lift(peak.u));
  Step step{normal, peak.u.norm(), std::max(peak.gain, 0.0), kTuning.gain_safety * whole_gain};
  // If the vertices at the peak determine the normal, the radii of curvature do not matter; on a flat face they only hold nearby.
  const bool is_at_face = peak.count == 3 && complementarity.is_strict(peak, pieces, {});
  if (has_flat_faces_ && !is_at_face && flat_step(jet, local, target, radius, step) != FlatStep::Taken) {
    target.newton = peak.u;
    leaves_face_ = flat_step(jet, local, target, radius, step) != FlatStep::Taken;
  }
  Vector3 face;
  if (gap_.shape2().crosses_curved_face(jet.m, -(gap_.rotation().transpose() * step.normal), face)) {
    step.normal = -(gap_.rotation() * face);
  }
  return step;
}

ModelStep::Target ModelStep::target_of(const GapJet& jet, const LocalModel& local, const PiecewiseModel::Peak& peak,
                                       std::span<const Piece> pieces) {
  Target target{0, Vector2::Zero(), peak.u, &peak};
  for (std::size_t i = 0; i < peak.count; ++i) {
    target.value += peak.weight[i] * pieces[peak.active[i]].value;
    target.slope += peak.weight[i] * pieces[peak.active[i]].slope;
    if (peak.count > 1) cuts_.add(vertices_.difference(jet, peak.active[i]) + gap_.rolling_radius() * jet.n);
  }
  if (local.A1.trace() > kFlatRadius * gap_.length_unit()) {
    // On such a flat face the tilt of the normal drowns in the rounding of u, but the displacement of the boundary point does not.
    const Vector2 displacement = target.slope - local.A2 * peak.u - jet.s * peak.u;
    const Vector2 tilt = local.A1.solve(displacement);
    if (all_finite(tilt)) target.newton = tilt;
  }
  return target;
}

// If the flat faces are across the body's axes, the boundary point is a function of the ratios of the normal's components. If the
// ratios hardly change, both steps are the same.
bool ModelStep::parametrizations_agree(const GapJet& jet, const LocalModel& local, const Vector2& newton) const {
  if (may_be_tilted_) return false;
  const auto is_less = [](const Vector3& tilt, const Vector3& normal) {
    return (tilt.array().abs() <= kTuning.same_tilt * normal.array().abs()).all();
  };
  return is_less(local.plane1.lift(newton), jet.n) && is_less(local.plane2.lift(newton), jet.m);
}

ModelStep::FlatStep ModelStep::flat_step(const GapJet& jet, const LocalModel& local, const Target& target, double radius,
                                         Step& step) const {
  const Vector2& newton = target.newton;
  Vector2 u1, u2;
  const Vector3 normal1 = gap_.shape1().advance_normal(jet.n, jet.jet1, local.plane1.lift(newton));
  const Vector3 normal2 = -gap_.shape2().advance_normal(jet.m, jet.jet2, -local.plane2.lift(newton));
  if (!to_plane(local.plane1, normal1, u1) || !to_plane(local.plane2, normal2, u2)) return FlatStep::LeavesFace;
  Vector2 u = blend(local.A1, local.A2, u1, u2);
  if (!all_finite(u)) return FlatStep::None;
  if (target.peak != nullptr && !to_plane(local.plane1, vertices_.shared_normal(*target.peak, jet.n + local.plane1.lift(u)), u)) {
    return FlatStep::LeavesFace;
  }
  const double gain_bound = target.value + target.slope.dot(u);
  if (!(gain_bound > 0)) return FlatStep::None;
  // The cut of this normal bounds the gain of s by the slope times the step, however flat the face.
  step.remaining_gain = std::max(step.remaining_gain, gain_bound);
  const double length = length_of(u.x(), u.y());
  if (length < kTuning.creep * newton.norm() && gain_bound < kTuning.poor_fraction * step.gain) return FlatStep::Taken;
  const double shrink = length > radius ? radius / length : 1;
  u *= shrink;
  step.normal = jet.n + local.plane1.lift(u);
  if (target.peak != nullptr) step.normal = vertices_.shared_normal(*target.peak, step.normal);
  step.length = u.norm();
  step.gain = std::min(step.gain, shrink * gain_bound);
  return FlatStep::Taken;
}

}  // namespace supernormal
