// The path of a solver for a pair.
#pragma once

#include <optional>
#include <string>
#include <supernormal/proximity/gap_function.hpp>
#include <supernormal/proximity/proximity.hpp>
#include <vector>

#include "pair/pair.hpp"

namespace explain_pair {

/// The gap function at one normal, in the world frame.
struct Evaluation {
  Vector3 n;  ///< unit, from body 1 to body 2
  double s;   ///< m
  Vector3
      cut;  ///< m; supporting half-space: d' = d + rho n: s(m) + rho <= m.d' for every unit m (lib/proximity/README.md, lemma 1)
};

/// A proved bound after some evaluations: the maximum of s is in [lower, upper], m.
struct ProvedInterval {
  int evaluations;
  double lower, upper;
};

struct SolverPath {
  std::string name;
  std::optional<supernormal::Solver> solver;  ///< empty for a literature method
  supernormal::Proximity answer;              ///< in the world frame
  std::vector<Evaluation> evaluations;        ///< in order
  std::vector<ProvedInterval> intervals;      ///< after each evaluation, or after some of many
};

/// s at a unit normal in the world frame.
class WorldGap {
 public:
  explicit WorldGap(const Pair& pair)
      : gap_(*pair.body1.shape, pair.body1.pose, *pair.body2.shape, pair.body2.pose), rotation_(pair.body1.pose.rotation) {}

  double s(const Vector3& n);
  Evaluation evaluate(const Vector3& n) { return evaluate_in_body1(rotation_.transpose() * n); }
  /// The normal is in the frame of body 1, the frame of the solvers.
  Evaluation evaluate_in_body1(const Vector3& n);
  const supernormal::GapFunction& function() const { return gap_; }

 private:
  supernormal::GapFunction gap_;
  Matrix3 rotation_;
  supernormal::GapJet jet_;
};

const char* name_of(supernormal::Solver solver);

/// Whether the library has this solver for the pair. All but the hybrid need smooth bodies; Newton's method needs a Hessian.
bool is_solver_for(supernormal::Solver solver, const Pair& pair);

/// Runs the solver of the settings and records its path. The interval after k evaluations is the result of a library query that is
/// limited to k evaluations.
SolverPath solver_path(const Pair& pair, const supernormal::Settings& settings);

}  // namespace explain_pair
