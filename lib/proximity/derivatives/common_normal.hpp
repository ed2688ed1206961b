// A common normal to rounding, with what its derivatives need.
#pragma once

#include <cmath>

#include "proximity/derivatives/tangent_response.hpp"
#include "proximity/local/piecewise_model.hpp"
#include "supernormal/proximity/gap_function.hpp"

namespace supernormal {

/// The common normal near an answer's normal, by Newton's method over the pieces of both bodies.
class CommonNormal {
 public:
  /// Starts at the unit normal `start` (body 1's frame). Both shapes need a Hessian.
  CommonNormal(GapFunction& gap, const Vector3& start);

  bool is_converged() const { return is_converged_; }  ///< whether the last step was small enough
  bool has_active_set() const { return active_set_; }  ///< whether a witness point is on a face or edge of several vertices
  bool is_strict() const { return is_strict_; }        ///< whether all multipliers are positive, and no other vertex is tied
  /// Whether a rotation by kNearby may change more than the response says: both bodies may be flat, a point is near a border, or
  /// both bodies are sharp.
  bool may_change_nearby() const { return may_change_nearby_; }
  bool is_sharp() const { return is_sharp_; }  ///< whether the normal rotates much faster than a body
  const TangentResponse& response() const { return response_; }
  const TangentPlane& plane() const { return plane_; }  ///< at the normal of the last evaluation, whose radii the response has
  const Symmetric2& radii1() const { return radii1_; }  ///< m; body 1's radii of curvature in this plane, across edges
  const Symmetric2& radii2() const { return radii2_; }  ///< m

  // In body 1's frame, after the last step, which needs no evaluation. It is at most kSmallStep.
  Vector3 normal() const { return n_; }
  Vector3 point1() const { return point1_; }  ///< m
  Vector3 lever2() const { return lever2_; }  ///< m; witness point 2 relative to the origin of body 2's frame
  double gap() const { return s_; }           ///< m

 private:
  /// What is known at one normal.
  struct Place {
    GapJet jet;
    TangentPlane plane;
    BodyCurvature body1, body2;
    PiecewiseModel::Peak peak;                                   // over the pieces, if there are several
    Vector3 point1 = Vector3::Zero(), point2 = Vector3::Zero();  // m; each in its body's frame
    TangentResponse response;
    Vector2 across = Vector2::Zero();  // m; point 2 - point 1 across the normal
    Vector2 step = Vector2::Zero();    // of the normal, gnomonic
    double rest = 0;                   // m; about twice what the gap would gain by the step
    bool has_active_set = false, is_strict = true, is_near_border = false;

    /// m; how far the witness points slide along an edge or a face per rad of the normal's rotation.
    double slide() const { return body1.A.trace() + body2.A.trace() + std::abs(jet.s); }
  };

  bool look_at(const Vector3& n, Place& place);
  bool keeps_radii(const Place& place, double rounding) const;
  bool is_settled(const Place& place) const;
  void add_flat_step(const BodyCurvature& body, const Matrix3& H, const Matrix3& to_body, Place& place) const;
  void find_active_set(Place& place) const;
  Vector3 moved(const Place& place, double part) const;
  void finish(const Place& place);
  void choose_points(const Place& place);

  GapFunction& gap_;
  const bool has_nonsmooth_points_, has_flat_faces_;
  TangentPlane plane_;
  TangentResponse response_;
  Symmetric2 radii1_, radii2_;
  Vector3 n_ = Vector3::UnitX(), point1_ = Vector3::Zero(), lever2_ = Vector3::Zero();
  double s_ = 0;
  bool is_converged_ = false, active_set_ = false, is_strict_ = true, is_sharp_ = false, may_change_nearby_ = false;
};

}  // namespace supernormal
