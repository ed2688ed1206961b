#include "proximity/search/expanding_polytope.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "base/thread_kept.hpp"
#include "proximity/bounds/minimum_norm_point.hpp"
#include "proximity/gap/tuning.hpp"

namespace supernormal {
namespace {

// If the origin is on a face, an edge or a vertex of the hull of the known points, the search continues around a point beside the
// origin: the first of these vectors, in units of the rounding error of s, that is on none. The bound grows by its length. A round
// body's point in the direction of one vector is in the plane of this vector and an edge, so the next vector is needed.
const std::array<Vector3, 3> kBeside = {Vector3(7, 11, 9), Vector3(-11, 9, 7), Vector3(9, 7, -11)};

}  // namespace

// A shape may be a callback that makes queries of its own. Such a query finds the storage taken and uses another.
ExpandingPolytope::ExpandingPolytope(GapFunction& gap, CuttingPlanes& cuts, Ascent& ascent, const StoppingRule& rule)
    : gap_(gap),
      cuts_(cuts),
      ascent_(ascent),
      rule_(rule),
      rho_(gap.rolling_radius()),
      polytope_(std::exchange(kept_polytope(), InnerPolytope())) {}

ExpandingPolytope::~ExpandingPolytope() { kept_polytope() = std::move(polytope_); }

InnerPolytope& ExpandingPolytope::kept_polytope() {
  thread_local ThreadKept<InnerPolytope> kept;
  return *kept;
}

bool ExpandingPolytope::run(const SearchLimits& limits, GapJet& best, double& error, Status& status) {
  limits_ = limits;
  best_ = best;
  error_ = error;
  status_ = status;
  top_count_ = 0;
  keep_top(ascent_.candidate());
  is_enclosed_ = enclose_origin();
  if (is_enclosed_) expand();
  climb_from_tops();
  const double upper = is_enclosed_ ? -polytope_.inner_radius() : minimum_norm_point(cuts_.points()).norm;
  excess_ = is_apart() ? error_ : std::max(upper - (best_.s + rho_), 0.0);
  best = best_;
  error = error_;
  status = status_;
  return excess_ <= width();
}

// GJK: if the hull of the known points does not contain the origin, the next normal is the direction of the hull's nearest point.
bool ExpandingPolytope::enclose_origin() {
  Vector3 centre = Vector3::Zero();
  std::size_t moves = 0;  // of the centre
  while (!is_apart()) {
    std::array<Vector3, CuttingPlanes::kCapacity> shifted;
    // The centre is no vertex: in symmetric poses the origin is on the line between the centre and a boundary point.
    const std::span<const Vector3> boundary = cuts_.boundary_points(), points(shifted.data(), boundary.size());
    for (std::size_t k = 0; k < points.size(); ++k) shifted[k] = boundary[k] - centre;
    MinimumNormSearch search;
    const MinimumNormPoint nearest = search.update(points);
    if (search.around() && polytope_.start(*search.around(), centre)) break;
    if (nearest.norm <= gap_.rounding()) {
      if (moves == kBeside.size()) return false;
      centre = gap_.rounding() * kBeside[moves++];
      continue;
    }
    if (!may_continue()) return false;
    cuts_.keep_lowest_at(nearest.normal);
    const std::span<const Vector3> triangle = search.simplex();
    const Vector3 point = evaluate(nearest.normal) - centre;
    climb_if_higher();
    // The triangle of a thin body may pass nearer to the centre than the determinants of the search resolve. The heights of the
    // polytope's facets have more digits.
    if (triangle.size() == 3 && polytope_.start({triangle[0], triangle[1], triangle[2], point}, centre)) break;
    if (!(nearest.normal.dot(point) < nearest.norm - gap_.rounding())) return false;
  }
  if (is_apart()) return false;
  set_goal();
  if (gap_.traits1().is_symmetric && gap_.traits2().is_symmetric) polytope_.set_symmetry(gap_.offset());
  polytope_.offer(best_.d + rho_ * best_.n);
  for (const Vector3& point : cuts_.boundary_points()) polytope_.offer(point);
  return true;
}

// The rounding keeps the facets at the goal itself in the order that expand() asks for.
void ExpandingPolytope::set_goal() { polytope_.set_goal(-(best_.s + rho_) - width() + gap_.rounding()); }

void ExpandingPolytope::expand() {
  while (may_continue() && !is_apart()) {
    const InnerPolytope::Nearest facet = polytope_.nearest();
    if (!(-facet.distance - (best_.s + rho_) > width())) return;
    // A facet through the origin itself is a sliver.
    if (facet.normal.isZero(0)) {
      polytope_.give_up(facet);
      continue;
    }
    const Vector3 point = evaluate(-facet.normal);
    if (!polytope_.add(point, facet) && !polytope_.add(point)) polytope_.give_up(facet);
    climb_if_higher();
  }
}

Vector3 ExpandingPolytope::evaluate(const Vector3& normal) {
  gap_.evaluate(normal.normalized(), Order::Point, jet_);
  if (!jet_.is_finite()) status_ = Status::InvalidInput;
  const Vector3 point = jet_.d + rho_ * jet_.n;
  cuts_.add(point);
  return point;
}

void ExpandingPolytope::climb_if_higher() {
  if (jet_.s > best_.s + limits_.cutoff && rule_.with_at_most(limits_.max_evaluations).may_evaluate()) {
    climb_from(jet_.n);
  } else {
    keep_top({jet_.n, jet_.s});
  }
}

// Keeps only the highest normal of each basin of attraction.
void ExpandingPolytope::keep_top(const LocalCandidate& top) {
  const auto is_lower = [](const LocalCandidate& a, const LocalCandidate& b) { return a.s < b.s; };
  const auto end = tops_.begin() + static_cast<std::ptrdiff_t>(top_count_);
  auto place =
      std::find_if(tops_.begin(), end, [&](const LocalCandidate& other) { return other.n.dot(top.n) > kTuning.same_basin_cosine; });
  if (place == end && top_count_ < kMaxTops) {
    tops_[top_count_++] = top;
    return;
  }
  if (place == end) place = std::min_element(tops_.begin(), end, is_lower);
  if (top.s > place->s) *place = top;
}

void ExpandingPolytope::climb_from_tops() {
  if (limits_.near == 0) return;
  // Point-symmetric bodies have s(-n) = s(n) - 2 n.c. If they are nearly concentric, they may separate on either side.
  if (rule_.may_evaluate() && std::abs(2 * best_.n.dot(gap_.offset())) < limits_.near) climb_from(-best_.n);
  const auto end = tops_.begin() + static_cast<std::ptrdiff_t>(top_count_);
  // Equal ones stay in their order, which std::sort may change.
  const auto is_higher = [](const LocalCandidate& a, const LocalCandidate& b) { return a.s > b.s; };
  for (auto next = tops_.begin(); next != end; ++next)
    std::rotate(std::upper_bound(tops_.begin(), next, *next, is_higher), next, next + 1);
  for (auto top = tops_.begin(); top != end && rule_.may_evaluate(); ++top) {
    if (top->s > best_.s - limits_.near && top->n.dot(best_.n) < kTuning.same_basin_cosine) climb_from(top->n);
  }
}

void ExpandingPolytope::climb_from(const Vector3& normal) {
  const Status status = ascent_.climb(normal, best_.s);
  const GapJet& top = ascent_.best();
  if (is_enclosed_) polytope_.offer(top.d + rho_ * top.n);
  if (!(top.s > best_.s)) return;
  best_ = top;
  error_ = ascent_.error();
  status_ = status;
  set_goal();
}

}  // namespace supernormal
