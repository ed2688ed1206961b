// Other local maxima of the gap function of two overlapping bodies.
#pragma once

#include "solvers/ascent.hpp"

namespace supernormal {

/// Whether two bodies that overlap by `depth` (m) may have a better local maximum than the one found. If a ball with the radius of
/// the depth rolls freely inside the difference of the bodies, the maximum is the only one (Blaschke's rolling theorem); the
/// smallest radii of curvature of the bodies add.
bool may_have_other_maxima(const SharpFeatures& features1, const SharpFeatures& features2, double depth, double length_unit,
                           bool has_kinks);

/// Looks for a better local maximum than `best` and puts it there. Starts from the separating axes of the polytopes that the
/// bodies resemble: face normals of both and cross products of their edges, the highest first, unless the cuts rule them out.
/// Returns the status of the climb that found the result.
class GlobalSearch {
 public:
  GlobalSearch(GapFunction& gap, CuttingPlanes& cuts, Ascent& ascent, const Settings& settings);

  Status improve(const SharpFeatures& features1, const SharpFeatures& features2, Status status, GapJet& best, double& error);

 private:
  struct Candidate {
    Vector3 normal;
    double bound;  // m; s cannot be larger
    double s;      // m; once evaluated
  };
  // 4 + 4 face normals, 6 x 6 pairs of edges, and the most promising faces and edges of a polytope.
  static constexpr int kMaxCandidates = 64;

  void collect(const SharpFeatures& features1, const SharpFeatures& features2);
  void collect_faces_of_polytope();
  void collect_edges_of_polytope(const SharpFeatures& features1, const Vector3& normal);
  void sort_evaluated();
  void add(const Vector3& direction);
  void add_exact(const Vector3& normal);
  void evaluate_candidates(double threshold);

  GapFunction& gap_;
  CuttingPlanes& cuts_;
  Ascent& ascent_;
  const Settings& settings_;
  std::array<Candidate, kMaxCandidates> candidates_;
  int count_ = 0;
  int evaluated_ = 0;  // candidates_[0, evaluated_) have been evaluated
};

}  // namespace supernormal
