#include "proximity/bounds/branch_and_bound.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "proximity/tuning.hpp"

namespace supernormal {
namespace {

// Of the cuts of a triangle its halves get those that hold its maximum.
constexpr std::size_t kInherited = 3;

}  // namespace

// A shape may be a callback that asks queries of its own: they find the storage taken and use another.
BranchAndBound::BranchAndBound(GapFunction& gap, CuttingPlanes& cuts, Ascent& ascent, const Settings& settings, double tolerance)
    : gap_(gap),
      cuts_(cuts),
      ascent_(ascent),
      settings_(settings),
      rho_(gap.rolling_radius()),
      tolerance_(tolerance),
      storage_(std::exchange(kept_storage(), Storage())) {}

BranchAndBound::~BranchAndBound() { kept_storage() = std::move(storage_); }

BranchAndBound::Storage& BranchAndBound::kept_storage() {
  thread_local Storage storage;
  return storage;
}

bool BranchAndBound::run(const Goal& goal, GapJet& best, double& error, Status& status) {
  goal_ = goal;
  best_ = best;
  error_ = error;
  status_ = status;
  start();
  while (!storage_.cells.empty() && status_ != Status::InvalidInput) {
    const double highest = storage_.cells.front().bound;
    // Without their balls the bodies are apart: a climb has shown it, and found the only maximum.
    if (best_.s + rho_ > 0 || !(excess_of(highest) > width())) break;
    if (gap_.evaluations() >= goal_.max_evaluations) break;
    refine(pop());
  }
  climb_from_tops();
  const double highest = storage_.cells.empty() ? given_up_ : std::max(given_up_, storage_.cells.front().bound);
  excess_ = best_.s + rho_ > 0 ? error_ : std::max(excess_of(highest), 0.0);
  best = best_;
  error = error_;
  status = status_;
  return excess_ <= width();
}

// An octahedron with a corner at the best normal: where s has a kink there, the triangles around it are done with at once.
void BranchAndBound::start() {
  storage_.cuts.clear();
  storage_.cells.clear();
  top_count_ = 0;
  remember_top(ascent_.candidate());
  given_up_ = -std::numeric_limits<double>::infinity();
  storage_.cuts.add(best_.d + rho_ * best_.n);
  for (const Vector3& d : cuts_.points()) storage_.cuts.add(d);
  const Vector3& x = best_.n;
  const Vector3 y = x.unitOrthogonal(), z = x.cross(y);
  for (const double sign_x : {1.0, -1.0}) {
    for (const double sign_y : {1.0, -1.0}) {
      for (const double sign_z : {1.0, -1.0}) {
        keep(cell_of({sign_x * x, sign_y * y, sign_z * z}, std::numeric_limits<double>::infinity()));
      }
    }
  }
}

BranchAndBound::Cell BranchAndBound::cell_of(const std::array<Vector3, kCorners>& corner, double bound) const {
  Cell cell{corner, {}, {}, bound, Vector3::Zero()};
  for (const Vector3& n : corner) add_cut(cell, storage_.cuts.lowest(n));
  tighten(cell);
  return cell;
}

void BranchAndBound::refine(Cell cell) {
  const double before = excess_of(cell.bound);
  tighten(cell);
  if (excess_of(cell.bound) <= kTuning.split_share * before) return keep(cell);
  add_cut(cell, evaluate(cell.peak));
  if (excess_of(cell.bound) > kTuning.split_share * before) {
    split(cell);
  } else {
    keep(cell);
  }
}

BranchAndBound::Index BranchAndBound::evaluate(const Vector3& direction) {
  gap_.evaluate(direction.normalized(), Order::Point, jet_);
  if (!jet_.is_finite()) status_ = Status::InvalidInput;
  cuts_.add(jet_.d + rho_ * jet_.n);
  storage_.cuts.add(jet_.d + rho_ * jet_.n);
  const Index cut = storage_.cuts.size() - 1;
  if (jet_.s > best_.s + goal_.cutoff && gap_.evaluations() < goal_.max_evaluations) {
    climb_from(jet_.n);
  } else {
    remember_top({jet_.n, jet_.s});
  }
  return cut;
}

// Of a hill the highest normal only.
void BranchAndBound::remember_top(const LocalCandidate& top) {
  const auto is_lower = [](const LocalCandidate& a, const LocalCandidate& b) { return a.s < b.s; };
  const auto end = tops_.begin() + static_cast<std::ptrdiff_t>(top_count_);
  auto place =
      std::find_if(tops_.begin(), end, [&](const LocalCandidate& other) { return other.n.dot(top.n) > kTuning.same_hill_cosine; });
  if (place == end && top_count_ < kMaxTops) {
    tops_[top_count_++] = top;
    return;
  }
  if (place == end) place = std::min_element(tops_.begin(), end, is_lower);
  if (top.s > place->s) *place = top;
}

void BranchAndBound::climb_from_tops() {
  if (goal_.near == 0) return;
  // Bodies with centres of symmetry have s(-n) = s(n) - 2 n.c: about concentric, they may leave one another on either side.
  if (std::abs(2 * best_.n.dot(gap_.offset())) < goal_.near) climb_from(-best_.n);
  const auto end = tops_.begin() + static_cast<std::ptrdiff_t>(top_count_);
  std::sort(tops_.begin(), end, [](const LocalCandidate& a, const LocalCandidate& b) { return a.s > b.s; });
  for (auto top = tops_.begin(); top != end && gap_.evaluations() < settings_.max_evaluations; ++top) {
    if (top->s > best_.s - goal_.near && top->n.dot(best_.n) < kTuning.same_hill_cosine) climb_from(top->n);
  }
}

void BranchAndBound::climb_from(const Vector3& normal) {
  const Status status = ascent_.climb(normal, best_.s);
  const GapJet& top = ascent_.best();
  storage_.cuts.add(top.d + rho_ * top.n);
  if (!(top.s > best_.s)) return;
  best_ = top;
  error_ = ascent_.error();
  status_ = status;
}

// The bounds are linear over the flat triangle, which lies inside the sphere: at a direction of length l <= 1 they bound l (s +
// rho), and a bound that is not positive holds for s + rho as well.
void BranchAndBound::add_cut(Cell& cell, Index cut) const {
  const auto& [a, b, c] = cell.corner;
  const LinearBounds& cuts = storage_.cuts;
  cell.cut[cell.program.add({cuts.at(cut, a), cuts.at(cut, b), cuts.at(cut, c)})] = cut;
  cell.seen = 0;
  double bound = cell.program.value();
  if (bound > 0) bound /= std::abs((b - a).cross(c - a).normalized().dot(a));
  cell.bound = std::min(cell.bound, bound);
  const Vector3& weights = cell.program.weights();
  cell.peak = weights[0] * a + weights[1] * b + weights[2] * c;
}

void BranchAndBound::tighten(Cell& cell) const {
  for (std::size_t k = 0; k < BarycentricLp::kMaxCuts; ++k) {
    const double excess = excess_of(cell.bound);
    if (excess <= width() || cell.seen == storage_.cuts.size()) return;
    const Index lowest = storage_.cuts.lowest(cell.peak, cell.seen);
    if (!(excess_of(storage_.cuts.at(lowest, cell.peak)) < excess)) {
      cell.seen = storage_.cuts.size();
      return;
    }
    add_cut(cell, lowest);
  }
}

// Halves the longest side: the angles stay away from zero.
void BranchAndBound::split(const Cell& cell) {
  Index longest = 0;
  double length = -1;
  for (Index v = 0; v < kCorners; ++v) {
    const double side = (cell.corner[(v + 1) % kCorners] - cell.corner[v]).squaredNorm();
    if (side > length) {
      length = side;
      longest = v;
    }
  }
  const Index next = (longest + 1) % kCorners;
  const Vector3 middle = (cell.corner[longest] + cell.corner[next]).normalized();
  // Those that hold the maximum first: the others hardly change it then.
  std::array<Index, BarycentricLp::kMaxCuts> cuts = cell.cut;
  const Index count = std::min(cell.program.size(), kInherited);
  const auto is_lower_at_peak = [&](Index a, Index b) { return storage_.cuts.at(a, cell.peak) < storage_.cuts.at(b, cell.peak); };
  for (Index k = 0; k < count; ++k) {
    std::iter_swap(cuts.begin() + k, std::min_element(cuts.begin() + k, cuts.begin() + cell.program.size(), is_lower_at_peak));
  }
  for (const Index replaced : {longest, next}) {
    Cell half{cell.corner, {}, {}, cell.bound, Vector3::Zero()};
    half.corner[replaced] = middle;
    for (Index k = 0; k < count; ++k) add_cut(half, cuts[k]);
    tighten(half);
    keep(half);
  }
}

void BranchAndBound::keep(const Cell& cell) {
  if (excess_of(cell.bound) <= width()) {
    given_up_ = std::max(given_up_, cell.bound);
    return;
  }
  storage_.cells.push_back(cell);
  std::push_heap(storage_.cells.begin(), storage_.cells.end(), is_lower);
}

BranchAndBound::Cell BranchAndBound::pop() {
  std::pop_heap(storage_.cells.begin(), storage_.cells.end(), is_lower);
  const Cell cell = storage_.cells.back();
  storage_.cells.pop_back();
  return cell;
}

}  // namespace supernormal
