#include "proximity/bounds/inner_polytope.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "proximity/bounds/minimum_norm_point.hpp"

namespace supernormal {
namespace {

// Relative to the longest vertex: a point is beyond a facet if it is beyond it by more than this.
constexpr double kBeyond = 8 * std::numeric_limits<double>::epsilon();

// rad; if the two shorter sides of a triangle are this nearly parallel, its plane is only rounding error.
constexpr double kThin = 1e-8;

/// The unit normal of a triangle, counter-clockwise as seen from outside. Zero if the triangle is too thin. Uses the two shorter
/// sides, because the digits of longer sides would cancel.
Vector3 normal_of(const Vector3& a, const Vector3& b, const Vector3& c) {
  const std::array<Vector3, 3> sides = {b - a, c - b, a - c};
  const std::array<double, 3> squares = {sides[0].squaredNorm(), sides[1].squaredNorm(), sides[2].squaredNorm()};
  const std::size_t longest = squares[0] > squares[1] ? (squares[0] > squares[2] ? 0 : 2) : (squares[1] > squares[2] ? 1 : 2);
  const std::size_t next = (longest + 1) % 3, last = (longest + 2) % 3;
  const Vector3 normal = sides[next].cross(sides[last]);
  const double area = normal.squaredNorm();
  return area > kThin * kThin * squares[next] * squares[last] ? Vector3(normal / std::sqrt(area)) : Vector3(Vector3::Zero());
}

/// The next side of a triangle.
std::uint32_t next(std::uint32_t side) { return side == 2 ? 0 : side + 1; }

}  // namespace

bool InnerPolytope::start(const std::array<Vector3, 4>& tetrahedron, const Vector3& centre) {
  centre_ = centre;
  vertices_.clear();
  facets_.clear();
  heap_.clear();
  offered_.clear();
  reserve();
  symmetry_.reset();
  visit_ = 0;
  goal_ = beyond_goal_ = std::numeric_limits<double>::infinity();
  given_up_ = std::numeric_limits<double>::infinity();
  length_ = 0;
  for (const Vector3& vertex : tetrahedron) add_vertex(vertex);
  const auto& [a, b, c, d] = tetrahedron;
  if ((b - a).cross(c - a).dot(d - a) > 0) std::swap(vertices_[1], vertices_[2]);
  const std::array<std::array<Index, 3>, 4> faces = {{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
  for (const auto& [i, j, k] : faces) {
    const Index facet = add_facet({i, j, k}, normal_of(vertices_[i].point, vertices_[j].point, vertices_[k].point));
    if (!(facets_[facet].height > 0)) return false;
  }
  const std::array<std::array<Index, 3>, 4> neighbours = {{{1, 2, 3}, {3, 2, 0}, {1, 3, 0}, {2, 1, 0}}};
  for (std::size_t k = 0; k < 4; ++k) facets_[k].neighbour = neighbours[k];
  return true;
}

// A point adds about six facets. So a thread allocates in its first search, and later only in a longer one.
void InnerPolytope::reserve() {
  constexpr std::size_t kVertices = 256;  // more than Tuning::search_evaluations and the cuts
  vertices_.reserve(kVertices);
  facets_.reserve(6 * kVertices);
  heap_.reserve(6 * kVertices);
  offered_.reserve(kMostOffers);
  horizon_.reserve(kVertices);
  visible_.reserve(kVertices);
}

double InnerPolytope::height_above(Index facet, const Vector3& point) const {
  return facets_[facet].normal.dot(point) - facets_[facet].height;
}

bool InnerPolytope::add(const Vector3& point) {
  const Vector3 vertex = point - centre_;
  Index seen = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (Index k = 0; k < facets_.size(); ++k) {
    const double height = facets_[k].is_removed ? most : height_above(k, vertex);
    if (!(height > most)) continue;
    most = height;
    seen = k;
  }
  return most > kBeyond * length_ && replace_visible(vertex, seen);
}

// The plane of a thin facet may be unknown. The plane across the direction of its nearest point is known.
bool InnerPolytope::is_beyond(const Vector3& vertex, const Nearest& facet) const {
  return facet.normal.dot(vertex) - (facet.distance + centre_.norm()) > kBeyond * length_;
}

bool InnerPolytope::add(const Vector3& point, const Nearest& facet) {
  const Vector3 vertex = point - centre_;
  return is_beyond(vertex, facet) && replace_visible(vertex, facet.facet);
}

bool InnerPolytope::replace_visible(const Vector3& vertex, Index seen) {
  // A vertex on an edge of the horizon would make a triangle without area. In this case the facet beyond that edge is removed too:
  // it is coplanar, or it is thin.
  if (!find_horizon(vertex, seen, 0) && !find_horizon(vertex, seen, -kBeyond * length_)) return false;
  for (const Index facet : visible_) facets_[facet].is_removed = true;
  const auto apex = static_cast<Index>(vertices_.size());
  add_vertex(vertex);
  const auto first = static_cast<Index>(facets_.size());
  const auto count = static_cast<Index>(horizon_.size());
  for (Index k = 0; k < count; ++k) {
    const Edge& edge = horizon_[k];
    const Index facet = add_facet({edge.from, edge.to, apex}, edge.normal);
    facets_[facet].neighbour = {edge.outer, first + (k + 1 < count ? k + 1 : 0), first + (k > 0 ? k : count) - 1};
    facets_[edge.outer].neighbour[edge.outer_side] = facet;
  }
  return true;
}

// Collects the facets that the point is beyond by more than `level`, starting with `seen`, and the edges around them in order.
// Returns false if the triangles between the point and these edges would not go around the origin as the facets do.
bool InnerPolytope::find_horizon(const Vector3& point, Index seen, double level) {
  ++visit_;
  horizon_.clear();
  visible_.assign(1, seen);
  facets_[seen].visit = visit_;
  for (std::size_t side = 0; side < 3; ++side) walk(point, level, seen, static_cast<Index>(side));
  return is_closed_cone(point);
}

void InnerPolytope::walk(const Vector3& point, double level, Index facet, Index across) {
  const Index other = facets_[facet].neighbour[across];
  Facet& there = facets_[other];
  if (there.visit == visit_) return;
  const Index from = there.neighbour[0] == facet ? 0 : there.neighbour[1] == facet ? 1 : 2;
  if (!(height_above(other, point) > level)) {
    horizon_.push_back({facets_[facet].vertex[across], facets_[facet].vertex[next(across)], other, from, Vector3::Zero()});
    return;
  }
  there.visit = visit_;
  visible_.push_back(other);
  walk(point, level, other, next(from));
  walk(point, level, other, next(next(from)));
}

bool InnerPolytope::is_closed_cone(const Vector3& apex) {
  const std::size_t count = horizon_.size();
  if (count < 3) return false;
  for (std::size_t k = 0; k < count; ++k) {
    Edge& edge = horizon_[k];
    if (edge.to != horizon_[k + 1 < count ? k + 1 : 0].from) return false;
    edge.normal = normal_of(vertices_[edge.from].point, vertices_[edge.to].point, apex);
    if (!(edge.normal.dot(apex) > 0)) return false;
  }
  return true;
}

void InnerPolytope::add_vertex(const Vector3& point) {
  vertices_.push_back({point, point.squaredNorm()});
  length_ = std::max(length_, std::sqrt(vertices_.back().squared));
}

InnerPolytope::Index InnerPolytope::add_facet(const std::array<Index, 3>& vertex, const Vector3& normal) {
  // The height of the nearest vertex has the most digits.
  const auto is_nearer = [&](Index i, Index j) { return vertices_[i].squared < vertices_[j].squared; };
  const Index nearest = *std::min_element(vertex.begin(), vertex.end(), is_nearer);
  const auto index = static_cast<Index>(facets_.size());
  const Facet& facet = facets_.emplace_back(Facet{vertex, {}, normal, normal.dot(vertices_[nearest].point), false, 0});
  if (facet.height >= goal_) {
    beyond_goal_ = std::min(beyond_goal_, facet.height);
    return index;
  }
  heap_.push_back({std::max(facet.height, 0.0), index, false});
  std::push_heap(heap_.begin(), heap_.end(), is_farther);
  return index;
}

void InnerPolytope::drop_removed() {
  while (!heap_.empty() && facets_[heap_.front().facet].is_removed) {
    std::pop_heap(heap_.begin(), heap_.end(), is_farther);
    heap_.pop_back();
  }
}

bool InnerPolytope::is_foot_inside(const Facet& facet) const {
  const Vector3 foot = facet.height * facet.normal;
  const auto is_left = [&](std::size_t side) {
    const Vector3& from = vertices_[facet.vertex[side]].point;
    const Vector3& to = vertices_[facet.vertex[(side + 1) % 3]].point;
    return facet.normal.dot((to - from).cross(foot - from)) >= 0;
  };
  return facet.height > 0 && is_left(0) && is_left(1) && is_left(2);
}

InnerPolytope::Nearest InnerPolytope::nearest() {
  while (true) {
    const Nearest facet = nearest_of_heap();
    Vector3 vertex;
    if (!(facet.distance < goal_) || !take_offer(facet, vertex)) return facet;
    replace_visible(vertex, facet.facet);
  }
}

// The farthest offered point over the facet, less the centre. Each point is taken once, so that nearest() ends whatever rounding
// does. The mirror image of the lowest point is the highest image.
bool InnerPolytope::take_offer(const Nearest& facet, Vector3& vertex) {
  if (offered_.empty()) return false;
  Offer *highest = offered_.data(), *lowest = offered_.data();
  double most = facet.normal.dot(highest->point), least = most;
  for (Offer& other : offered_) {
    const double height = facet.normal.dot(other.point);
    if (height > most) {
      most = height;
      highest = &other;
    } else if (height < least) {
      least = height;
      lowest = &other;
    }
  }
  const bool is_mirrored = symmetry_ && 2 * facet.normal.dot(*symmetry_) - least > most;
  bool& is_taken = is_mirrored ? lowest->is_mirror_taken : highest->is_taken;
  vertex = (is_mirrored ? Vector3(2 * *symmetry_ - lowest->point) : highest->point) - centre_;
  if (is_taken || !(facet.normal.dot(vertex) >= goal_) || !is_beyond(vertex, facet)) return false;
  is_taken = true;
  return true;
}

// A facet's plane is no farther than the facet itself. So a facet's own distance is only computed when its plane is the nearest.
InnerPolytope::Nearest InnerPolytope::nearest_of_heap() {
  const double error = centre_.norm();
  while (true) {
    drop_removed();
    if (heap_.empty()) return {0, std::numeric_limits<double>::infinity(), Vector3::Zero()};
    const Entry entry = heap_.front();
    const Facet& facet = facets_[entry.facet];
    if (is_foot_inside(facet)) return {entry.facet, facet.height - error, facet.normal};
    const std::array<Vector3, 3> triangle = {vertices_[facet.vertex[0]].point, vertices_[facet.vertex[1]].point,
                                             vertices_[facet.vertex[2]].point};
    const MinimumNormPoint nearest = minimum_norm_point(triangle);
    if (entry.is_exact) return {entry.facet, nearest.norm - error, nearest.normal};
    std::pop_heap(heap_.begin(), heap_.end(), is_farther);
    heap_.back() = {nearest.norm, entry.facet, true};
    std::push_heap(heap_.begin(), heap_.end(), is_farther);
  }
}

void InnerPolytope::give_up(const Nearest& facet) {
  given_up_ = std::min(given_up_, facet.distance);
  std::erase_if(heap_, [&](const Entry& entry) { return entry.facet == facet.facet; });
  std::make_heap(heap_.begin(), heap_.end(), is_farther);
}

double InnerPolytope::inner_radius() {
  const double distance = nearest().distance;  // which may put facets beyond the goal
  return std::min({given_up_, beyond_goal_ - centre_.norm(), distance});
}

}  // namespace supernormal
