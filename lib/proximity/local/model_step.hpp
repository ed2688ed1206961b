// The step that a local model of the gap function proposes.
#pragma once

#include "proximity/bounds/cutting_planes.hpp"
#include "proximity/local/bfgs_hessian.hpp"
#include "proximity/local/local_model.hpp"
#include "proximity/local/vertex_cache.hpp"
#include "supernormal/proximity/gap_function.hpp"

namespace supernormal {

/// A normal to evaluate, and the expected result.
struct Step {
  Vector3 normal;  ///< not normalised
  double length;   ///< in gnomonic coordinates
  double gain;     ///< m; predicted by the model
  /// m; estimate of what is left to the local maximum from the start of the step; infinite if unknown.
  double remaining_gain;
};

/// Proposes steps from an evaluated normal, in two stages.
///   1. Newton's step within a trust region. It uses the Hessians of the shapes, or a secant estimate of their sum. If body 2 has
///   faces
///      or straight edges, the step goes to the maximum over all nearby vertices: to the exact normal of an edge or a face if that
///      is where the maximum is.
///   2. If a body is flat, the step that puts the flat body's boundary point opposite the other's. There the normal is a smooth
///   function
///      of the boundary point, but not the other way round.
class ModelStep {
 public:
  /// Keeps references. Adds to `cuts` the vertices of an edge or a face that the step goes to.
  ModelStep(const GapFunction& gap, VertexCache& vertices, CuttingPlanes& cuts);

  /// The step from `jet`, which was evaluated with Hessians or has the estimate `bfgs`. `active` are the active vertices of body 2.
  /// `radius` is gnomonic. If there is no usable step, remaining_gain is infinite and leaves_face() is true.
  Step propose(const GapJet& jet, const ActiveVertices& active, const BfgsHessian& bfgs, double radius);

  /// Whether the last step leads beyond a flat face, where the model is not valid.
  bool leaves_face() const { return leaves_face_; }

  LocalModel local_model(const GapJet& jet, const BfgsHessian& bfgs) const;

 private:
  /// Body 2 at this normal, to first order: its boundary point, or a mean of the vertices that share a normal.
  struct Target {
    double value;                      ///< m; s is at most s + value + slope.u there, up to the curvature of body 1
    Vector2 slope;                     ///< m
    Vector2 newton;                    ///< the model's maximum
    const PiecewiseModel::Peak* peak;  ///< null for a smooth body 2
  };

  Step smooth_step(const GapJet& jet, const LocalModel& local, double radius);
  Step kinked_step(const GapJet& jet, const LocalModel& local, const ActiveVertices& active, double radius);
  Target target_of(const GapJet& jet, const LocalModel& local, const PiecewiseModel::Peak& peak, std::span<const Piece> pieces);
  enum class FlatStep {
    Taken,
    None,        ///< the bodies' proposals do not agree on a step
    LeavesFace,  ///< the step rotates the normal by a right angle or more
  };
  FlatStep flat_step(const GapJet& jet, const LocalModel& local, const Target& target, double radius, Step& step) const;
  bool parametrizations_agree(const GapJet& jet, const LocalModel& local, const Vector2& newton) const;

  const GapFunction& gap_;
  VertexCache& vertices_;
  CuttingPlanes& cuts_;
  const bool has_flat_faces_;
  const bool may_be_tilted_;  // whether a flat face may be across no axis of its body
  bool leaves_face_ = false;
};

}  // namespace supernormal
