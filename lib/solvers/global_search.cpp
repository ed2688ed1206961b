#include "solvers/global_search.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>

namespace supernormal {
namespace {

// Blaschke's theorem is certain up to a depth of one radius. In random pairs (exponents 6...200) no second maximum won below four
// radii at overlaps of up to 10 %, so shallow queries are spared the search; at 30 % three radii miss 1.2 % of the boxes, two 0.15
// %. Where the centre of one body is about that of the other, all the ways out are of like length and nothing is spared.
constexpr double kShallowDepthPerRadius = 4;
constexpr double kDeepDepthPerRadius = 2;
constexpr double kCertainDepthPerRadius = 1;
constexpr double kDeep = 0.15;         // of the smallest half-extent
constexpr double kAboutCentred = 0.5;  // likewise

// A candidate is worth a climb if it comes this near to the best, in shares of the depth and of the roundness of the bodies: the
// maximum lies beside the polytope's separating axis, by as much as the boundary lies beside the polytope. From a sweep over the
// reference pairs.
constexpr double kSlackPerDepth = 0.6;
constexpr double kSlackPerRoundness = 0.4;

// Climbs that are tried, beside the first. Five miss twice as many of the octahedral pairs, twelve find no more than eight.
constexpr std::size_t kMaxClimbs = 8;

// Starts closer than five degrees lead up the same hill.
constexpr double kSameHillCosine = 0.9962;

// Of a polytope, the edges of this many of its most promising sides are tried as well.
constexpr int kSidesSearched = 4;

// Edges closer to parallel than this (radians) have no cross product worth trying.
constexpr double kParallel = 1e-6;

}  // namespace

bool may_have_other_maxima(const SharpFeatures& features1, const SharpFeatures& features2, double depth, double length_unit,
                           bool has_kinks) {
  const double radii = has_kinks || depth > kAboutCentred * length_unit ? kCertainDepthPerRadius
                       : depth > kDeep * length_unit                    ? kDeepDepthPerRadius
                                                                        : kShallowDepthPerRadius;
  return depth > radii * (features1.radius + features2.radius);
}

GlobalSearch::GlobalSearch(GapFunction& gap, CuttingPlanes& cuts, Ascent& ascent, const Settings& settings)
    : gap_(gap), cuts_(cuts), ascent_(ascent), settings_(settings) {}

void GlobalSearch::add(const Vector3& direction) {
  // Of the two signs the one towards body 2 separates better: both bodies look alike from both sides.
  const double length = direction.norm();
  add_exact(direction * (direction.dot(gap_.offset()) < 0 ? -1 / length : 1 / length));
}

void GlobalSearch::add_exact(const Vector3& normal) {
  const double bound = cuts_.upper_bound(normal);
  auto place = candidates_.begin() + count_;
  if (count_ < kMaxCandidates) {
    ++count_;
  } else {
    place = std::min_element(candidates_.begin() + evaluated_, candidates_.end(),
                             [](const Candidate& a, const Candidate& b) { return a.bound < b.bound; });
    if (place == candidates_.end() || bound <= place->bound) return;
  }
  *place = {normal, bound, 0};
}

void GlobalSearch::collect(const SharpFeatures& features1, const SharpFeatures& features2) {
  count_ = 0;
  evaluated_ = 0;
  const Matrix3& R = gap_.rotation();
  for (int i = 0; i < features1.face_count; ++i) add(features1.face_normals[static_cast<std::size_t>(i)]);
  for (int j = 0; j < features2.face_count; ++j) add(R * features2.face_normals[static_cast<std::size_t>(j)]);
  for (int i = 0; i < features1.edge_count; ++i) {
    const Vector3& edge1 = features1.edges[static_cast<std::size_t>(i)];
    for (int j = 0; j < features2.edge_count; ++j) {
      const Vector3 edge2 = R * features2.edges[static_cast<std::size_t>(j)];
      const Vector3 direction = edge1.cross(edge2);
      if (direction.norm() > kParallel * edge1.norm() * edge2.norm()) add(direction);
    }
  }
}

// A polytope looks different from every side: its faces come one by one, and of its edges those near a normal.
void GlobalSearch::collect_faces_of_polytope() {
  for (const Vector3& face : gap_.shape2().face_normals()) add_exact(-(gap_.rotation() * face));
}

void GlobalSearch::collect_edges_of_polytope(const SharpFeatures& features1, const Vector3& normal) {
  const Matrix3& R = gap_.rotation();
  const Vector3 m = -(R.transpose() * normal);
  Corners corners;
  gap_.shape2().add_corners(m, m, corners);
  for (int j = 0; j < corners.size(); ++j) {
    for (int k = 0; k < j; ++k) {
      const Vector3 edge2 = R * (corners[j] - corners[k]);
      for (int i = 0; i < features1.edge_count; ++i) {
        const Vector3& edge1 = features1.edges[static_cast<std::size_t>(i)];
        const Vector3 direction = edge1.cross(edge2);
        const double length = direction.norm();
        if (!(length > kParallel * edge1.norm() * edge2.norm())) continue;
        add_exact(direction / length);
        add_exact(-direction / length);
      }
    }
  }
}

void GlobalSearch::evaluate_candidates(double threshold) {
  GapJet jet;
  while (evaluated_ < count_ && gap_.evaluations() < settings_.max_evaluations) {
    const auto rest = candidates_.begin() + evaluated_;
    const auto end = candidates_.begin() + count_;
    std::iter_swap(rest, std::max_element(rest, end, [](const Candidate& a, const Candidate& b) { return a.bound < b.bound; }));
    if (rest->bound <= threshold) break;
    gap_.evaluate(rest->normal, Order::Point, jet);
    cuts_.add(jet.d);
    rest->s = jet.s;
    ++evaluated_;
    for (auto other = rest + 1; other != end; ++other) other->bound = std::min(other->bound, other->normal.dot(jet.d));
  }
}

void GlobalSearch::sort_evaluated() {
  std::sort(candidates_.begin(), candidates_.begin() + evaluated_,
            [](const Candidate& a, const Candidate& b) { return a.s > b.s; });
}

Status GlobalSearch::improve(const SharpFeatures& features1, const SharpFeatures& features2, Status status, GapJet& best,
                             double& error) {
  const double slack = kSlackPerDepth * std::abs(best.s) + kSlackPerRoundness * (features1.roundness + features2.roundness);
  collect(features1, features2);
  collect_faces_of_polytope();
  const bool is_polytope = gap_.shape2().has_kinks() && features2.edge_count == 0;
  if (is_polytope) collect_edges_of_polytope(features1, best.n);
  evaluate_candidates(best.s - slack);
  sort_evaluated();
  for (int i = 0; is_polytope && i < std::min(evaluated_, kSidesSearched); ++i) {
    collect_edges_of_polytope(features1, candidates_[static_cast<std::size_t>(i)].normal);
  }
  evaluate_candidates(best.s - slack);
  if (gap_.evaluations() >= settings_.max_evaluations) return Status::EvaluationLimit;
  sort_evaluated();
  const auto end = candidates_.begin() + evaluated_;

  std::array<Vector3, kMaxClimbs + 1> starts;
  std::size_t start_count = 0;
  starts[start_count++] = best.n;
  for (auto candidate = candidates_.begin(); candidate != end && start_count <= kMaxClimbs; ++candidate) {
    if (cuts_.upper_bound(candidate->normal) <= best.s - slack) continue;
    const auto leads_up_same_hill = [&](const Vector3& n) { return n.dot(candidate->normal) > kSameHillCosine; };
    if (std::any_of(starts.begin(), starts.begin() + start_count, leads_up_same_hill)) continue;
    if (gap_.evaluations() >= settings_.max_evaluations) return Status::EvaluationLimit;
    starts[start_count++] = candidate->normal;
    const Status climb_status = ascent_.climb(candidate->normal, best.s);
    if (climb_status == Status::EvaluationLimit) status = climb_status;
    if (ascent_.best().s <= best.s) continue;
    best = ascent_.best();
    error = ascent_.error();
    status = climb_status;
  }
  return status;
}

}  // namespace supernormal
