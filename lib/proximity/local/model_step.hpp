// The step that a local model of the gap function proposes.
#pragma once

#include "proximity/bounds/cutting_planes.hpp"
#include "proximity/local/bfgs_hessian.hpp"
#include "proximity/local/local_model.hpp"
#include "proximity/local/vertex_cache.hpp"
#include "supernormal/proximity/gap_function.hpp"

namespace supernormal {

/// A normal to evaluate, and what is expected there.
struct Step {
  Vector3 normal;         ///< not normalised
  double length;          ///< in gnomonic coordinates
  double gain;            ///< m; promised
  double remaining_gain;  ///< m; estimate of what is left to the local maximum from where the step begins; infinite where unknown
};

/// Proposes steps from an evaluated normal. Each
///   1. is Newton's step within a trust region, from the Hessians of the shapes or a secant estimate of their sum; where body 2 has
///      faces or straight edges, the step to the maximum over all vertices near: the normal of an edge or a face where it lies on
///      one;
///   2. where a body is flat, goes on as the step that puts the flat body's boundary point opposite the other's: there the normal
///   is
///      a smooth function of the boundary point, not the other way round.
class ModelStep {
 public:
  /// Keeps references. `cuts` learns the points of an edge or a face that the step goes to.
  ModelStep(const GapFunction& gap, VertexCache& vertices, CuttingPlanes& cuts);

  /// The step from `jet`, evaluated with Hessians or with the estimate `bfgs` of them, and with the `active` vertices of body 2,
  /// within the gnomonic `radius`. No usable step has a remaining_gain that is infinite and leads beyond a flat face, where the
  /// model ends.
  Step propose(const GapJet& jet, const ActiveVertices& active, const BfgsHessian& bfgs, double radius);

  /// Whether the last step leads beyond a flat face: it is not to be trusted.
  bool leaves_face() const { return leaves_face_; }

  LocalModel local_model(const GapJet& jet, const BfgsHessian& bfgs) const;

 private:
  /// What body 2 looks like from the normal to first order: its boundary point, or a mean of those that share a normal.
  struct Target {
    double value;                      ///< m; s there is at most s + value + slope.u, but for the curvature of body 1
    Vector2 slope;                     ///< m
    Vector2 newton;                    ///< where the model has its maximum
    const PiecewiseModel::Peak* peak;  ///< null for a smooth body 2
  };

  Step smooth_step(const GapJet& jet, const LocalModel& local, double radius);
  Step kinked_step(const GapJet& jet, const LocalModel& local, const ActiveVertices& active, double radius);
  Target target_of(const GapJet& jet, const LocalModel& local, const PiecewiseModel::Peak& peak, std::span<const Piece> pieces);
  enum class FlatStep {
    Taken,
    None,        ///< the bodies' proposals do not agree on one
    LeavesFace,  ///< it turns the normal by a right angle or more
  };
  FlatStep flat_step(const GapJet& jet, const LocalModel& local, const Target& target, double radius, Step& step) const;
  bool parametrizations_agree(const GapJet& jet, const LocalModel& local, const Vector2& newton) const;

  const GapFunction& gap_;
  VertexCache& vertices_;
  CuttingPlanes& cuts_;
  const bool has_flat_faces_;
  const bool may_be_tilted_;  // the flat faces, across no axis of their body
  bool leaves_face_ = false;
};

}  // namespace supernormal
