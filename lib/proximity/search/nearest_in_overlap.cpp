#include "proximity/search/nearest_in_overlap.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <span>

#include "proximity/bounds/minimum_norm_point.hpp"
#include "supernormal/shapes/polytope.hpp"

namespace supernormal {
namespace {

// The determinant of the cosines between two or three tangent planes; for two it is the squared sine. Below this, their common line
// or point is only rounding error.
constexpr double kSameLine = 1e-12;

// Relative to the smallest half-extent: from this radius on, a ball that rolls inside a body is as thick as the body.
constexpr double kBall = 0.99;

constexpr int kMostMoves = 1000;  // if all vertices of both bodies are known, a move costs no evaluation

// Relative to the distance to a body: the distance is known if a tangent plane covers all but this fraction of it. The place then
// moves the whole distance.
constexpr double kRough = 0.1;

// Relative to the distance to the farthest plane: a place counts as behind a plane if no more than this is left.
constexpr double kBehind = 0.01;

/// Known points of one body, in body 1's frame, for queries from a place.
class SampledBody {
 public:
  SampledBody(const Shape& shape, const Vector3& position, const Matrix3& rotation)
      : shape_(&shape), position_(position), rotation_(rotation) {}

  bool is_full() const { return count_ == kCapacity; }
  void add(const Vector3& point) { points_[count_++] = point; }
  bool has(const Vector3& point) const {
    const auto end = points_.begin() + static_cast<std::ptrdiff_t>(count_);
    return std::find(points_.begin(), end, point) != end;
  }

  /// Adds active vertices of a body with faces, without an evaluation. `n` is the body's unit normal in its frame.
  void add_vertices(const Vector3& n, const Vector3& place) {
    ActiveVertices vertices;
    shape_->add_active_vertices(n, in_frame(place), vertices);
    for (int k = 0; k < vertices.size(); ++k) add(position_ + rotation_ * vertices[k]);
  }

  /// Whether the known points span the whole body, so that no evaluation adds a point.
  bool is_known() const {
    const auto* polytope = dynamic_cast<const Polytope*>(shape_);
    return polytope != nullptr && polytope->points().size() <= ActiveVertices::kCapacity;
  }

  /// m; from the place to the nearest point of the hull. Zero if the body surely contains the place.
  const MinimumNormPoint& look_from(const Vector3& place) {
    nearest_ = {Vector3::Zero(), 0, Vector3::Zero()};
    if (shape_->surely_contains(in_frame(place))) return nearest_;
    std::array<Vector3, kCapacity> shifted;
    for (std::size_t k = 0; k < count_; ++k) shifted[k] = points_[k] - place;
    return nearest_ = minimum_norm_point({shifted.data(), count_});
  }

  const MinimumNormPoint& nearest() const { return nearest_; }

 private:
  static constexpr std::size_t kCapacity = 256;

  Vector3 in_frame(const Vector3& place) const { return rotation_.transpose() * (place - position_); }

  const Shape* shape_;
  Vector3 position_;
  Matrix3 rotation_;
  std::array<Vector3, kCapacity> points_;
  std::size_t count_ = 0;
  MinimumNormPoint nearest_{};
};

/// A tangent plane, relative to the place.
struct Plane {
  Vector3 normal;   // unit, towards the body
  double distance;  // m, along the normal; negative if the place is behind the plane
};

/// The latest tangent planes of one body at its points nearest to the place: three, because three meet in a vertex.
class Planes {
 public:
  void add(const Plane& plane) { planes_[added_++ % planes_.size()] = plane; }
  void move(const Vector3& displacement) {
    for (std::size_t k = 0; k < size(); ++k) planes_[k].distance -= planes_[k].normal.dot(displacement);
  }
  std::size_t size() const { return std::min(added_, planes_.size()); }
  const Plane& operator[](std::size_t k) const { return planes_[k]; }

 private:
  std::array<Plane, 3> planes_;
  std::size_t added_ = 0;
};

/// m; from the place to the nearest common point of up to three planes. Empty if that is not also the nearest point behind them.
std::optional<Vector3> displacement_to(std::span<const Plane* const> planes) {
  Matrix3 cosines = Matrix3::Identity();
  Vector3 distances = Vector3::Zero();
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    distances[row] = planes[i]->distance;
    for (std::size_t j = 0; j < i; ++j) {
      const auto column = static_cast<Eigen::Index>(j);
      cosines(row, column) = cosines(column, row) = planes[i]->normal.dot(planes[j]->normal);
    }
  }
  if (!(cosines.determinant() > kSameLine)) return std::nullopt;
  const Vector3 pull = cosines.inverse() * distances;
  if (!(pull.minCoeff() >= 0)) return std::nullopt;
  Vector3 displacement = Vector3::Zero();
  for (std::size_t i = 0; i < planes.size(); ++i) displacement += pull[static_cast<Eigen::Index>(i)] * planes[i]->normal;
  return displacement;
}

/// m; from the place to the nearest point behind all planes. This point is on one, two or three of them; three dimensions need no
/// more. If rounding hides it, the displacement leads behind the farthest plane.
Vector3 displacement_behind(const Planes& planes1, const Planes& planes2) {
  std::array<const Plane*, 6> all{};
  std::size_t count = 0;
  for (const Planes* planes : {&planes1, &planes2}) {
    for (std::size_t k = 0; k < planes->size(); ++k) all[count++] = &(*planes)[k];
  }
  const Plane& farthest = **std::max_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count),
                                             [](const Plane* a, const Plane* b) { return a->distance < b->distance; });
  std::optional<Vector3> best;
  for (unsigned subset = 1; subset < 1U << count; ++subset) {
    if (std::popcount(subset) > 3) continue;
    std::array<const Plane*, 3> chosen{};
    std::size_t chosen_count = 0;
    for (std::size_t k = 0; k < count; ++k) {
      if ((subset >> k & 1U) != 0) chosen[chosen_count++] = all[k];
    }
    const std::optional<Vector3> displacement = displacement_to({chosen.data(), chosen_count});
    if (!displacement || (best && best->squaredNorm() <= displacement->squaredNorm())) continue;
    const bool is_behind = std::all_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count), [&](const Plane* plane) {
      return plane->distance - plane->normal.dot(*displacement) <= kBehind * farthest.distance;
    });
    if (is_behind) best = displacement;
  }
  return best.value_or(farthest.distance * farthest.normal);
}

}  // namespace

bool is_in_overlap(const GapFunction& gap, const Place& place, double near) {
  const auto is_inside = [&](const Shape& shape, const Vector3& centre, auto&& in_its_frame) {
    return (place.point - centre).norm() <= shape.rolling_radius() + near || shape.surely_contains(in_its_frame());
  };
  return is_inside(gap.shape1(), place.centre1, [&] { return place.point; }) &&
         is_inside(gap.shape2(), place.centre2,
                   [&]() -> Vector3 { return gap.rotation().transpose() * (place.point - gap.offset()); });
}

bool move_into_ball(const GapFunction& gap, Place& place, double near) {
  const auto nearest = [&](const Shape& shape, const Vector3& centre) {
    Place moved = place;
    const double radius = shape.rolling_radius(), distance = (place.point - centre).norm();
    const bool is_ball = radius >= kBall * shape.half_extents().minCoeff();
    if (is_ball && distance > radius) moved.point = centre + radius / distance * (place.point - centre);
    return moved;
  };
  for (const Place& moved : {nearest(gap.shape1(), place.centre1), nearest(gap.shape2(), place.centre2)}) {
    if (!is_in_overlap(gap, moved, near)) continue;
    place = moved;
    return true;
  }
  return false;
}

Vector3 nearest_in_overlap(GapFunction& gap, const GapJet& jet, Vector3 place, double near, const StoppingRule& rule) {
  std::array<SampledBody, 2> bodies = {SampledBody(gap.shape1(), Vector3::Zero(), Matrix3::Identity()),
                                       SampledBody(gap.shape2(), gap.offset(), gap.rotation())};
  bodies[0].add(jet.jet1.r);
  bodies[1].add(jet.jet1.r + jet.d);
  bodies[0].add_vertices(jet.n, place);
  bodies[1].add_vertices(jet.m, place);
  const MinimumNormPoint &nearest1 = bodies[0].nearest(), &nearest2 = bodies[1].nearest();
  // Whether the nearest known point of the body is, to the tolerance, the nearest point of the body.
  std::array<bool, 2> is_settled{};
  GapJet trial;
  std::array<Planes, 2> planes;
  int moves = 0;
  while (true) {
    for (std::size_t k = 0; k < 2; ++k) {
      if (bodies[k].look_from(place).norm <= near || bodies[k].is_known()) is_settled[k] = true;
    }
    if (is_settled[0] && is_settled[1]) {
      if (std::max(nearest1.norm, nearest2.norm) <= near || ++moves > kMostMoves) return place;
      for (std::size_t k = 0; k < 2; ++k) {
        if (const MinimumNormPoint& nearest = bodies[k].nearest(); nearest.norm > 0) planes[k].add({nearest.normal, nearest.norm});
      }
      const Vector3 displacement = displacement_behind(planes[0], planes[1]);
      place += displacement;
      for (Planes& each : planes) each.move(displacement);
      is_settled = {};
      continue;
    }
    if (!rule.may_evaluate() || bodies[0].is_full() || bodies[1].is_full()) return place;
    const std::size_t open = is_settled[0] || (!is_settled[1] && nearest2.norm > nearest1.norm) ? 1 : 0;
    const MinimumNormPoint nearest = bodies[open].nearest();
    gap.evaluate(open == 0 ? Vector3(-nearest.normal) : nearest.normal, Order::Point, trial);
    if (!trial.is_finite()) return place;
    const Vector3 point = open == 0 ? trial.jet1.r : Vector3(trial.jet1.r + trial.d);
    // From near by, the direction to an edge of a large body has few digits. So its points are returned again.
    is_settled[open] =
        nearest.normal.dot(point - place) >= nearest.norm - std::max(near, kRough * nearest.norm) || bodies[open].has(point);
    bodies[0].add(trial.jet1.r);
    bodies[1].add(trial.jet1.r + trial.d);
  }
}

}  // namespace supernormal
