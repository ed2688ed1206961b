#include "shapes/convex_hull.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace supernormal {
namespace {

LatticePoint difference(const LatticePoint& a, const LatticePoint& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

LatticePoint cross(const LatticePoint& a, const LatticePoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

std::int64_t dot(const LatticePoint& a, const LatticePoint& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector3 to_vector(const LatticePoint& v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

}  // namespace

void ConvexHull::build(std::span<const LatticePoint> points) {
  points_.assign(points.begin(), points.end());
  std::sort(points_.begin(), points_.end());
  points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
  faces_.clear();
  next_outside_.assign(points_.size(), kNone);
  face_from_.assign(points_.size(), kNone);
  if (!start()) return;
  for (std::size_t face = 0; face < faces_.size(); ++face) {
    if (!faces_[face].is_removed && faces_[face].first_outside != kNone) grow(face);
  }
}

// Builds a tetrahedron of points that are far apart. Returns false if there is none: then faces_ is already the hull.
bool ConvexHull::start() {
  const auto farthest = [&](auto&& measure) {
    std::size_t best = 0;
    auto most = measure(points_[0]);
    for (std::size_t k = 1; k < points_.size(); ++k) {
      const auto value = measure(points_[k]);
      if (value > most) {
        most = value;
        best = k;
      }
    }
    return best;
  };
  if (points_.size() < 3) return false;
  const LatticePoint origin = points_[0];
  const std::size_t b = farthest([&](const LatticePoint& p) { return dot(difference(p, origin), difference(p, origin)); });
  const LatticePoint along = difference(points_[b], origin);
  const std::size_t c =
      farthest([&](const LatticePoint& p) { return to_vector(cross(along, difference(p, origin))).squaredNorm(); });
  const LatticePoint normal = cross(along, difference(points_[c], origin));
  if (normal == LatticePoint{0, 0, 0}) return false;
  const std::size_t d = farthest([&](const LatticePoint& p) { return std::abs(dot(normal, difference(p, origin))); });
  const std::int64_t height_of_d = dot(normal, difference(points_[d], origin));
  if (height_of_d == 0) {
    add_face(0, b, c);
    add_face(0, c, b);
    faces_[0].neighbours = {1, 1, 1};
    faces_[1].neighbours = {0, 0, 0};
    return false;
  }
  const std::size_t left = height_of_d > 0 ? c : b;
  const std::size_t right = height_of_d > 0 ? b : c;
  add_face(0, left, right);  // d is behind this face
  add_face(0, d, left);
  add_face(left, d, right);
  add_face(right, d, 0);
  faces_[0].neighbours = {1, 2, 3};
  faces_[1].neighbours = {3, 2, 0};
  faces_[2].neighbours = {1, 3, 0};
  faces_[3].neighbours = {2, 1, 0};
  for (std::size_t point = 0; point < points_.size(); ++point) hand_over(point, 0);
  return true;
}

std::size_t ConvexHull::add_face(std::size_t a, std::size_t b, std::size_t c) {
  Face face{};
  face.vertices = {a, b, c};
  face.neighbours = {kNone, kNone, kNone};
  face.normal = cross(difference(points_[b], points_[a]), difference(points_[c], points_[a]));
  face.first_outside = kNone;
  faces_.push_back(face);
  return faces_.size() - 1;
}

std::int64_t ConvexHull::height(const Face& face, std::size_t point) const {
  return dot(face.normal, difference(points_[point], points_[face.vertices[0]]));
}

// Assigns the point to the first face, from `first_face` on, that it is in front of. A point in front of no face is inside the
// hull.
void ConvexHull::hand_over(std::size_t point, std::size_t first_face) {
  for (std::size_t k = first_face; k < faces_.size(); ++k) {
    if (height(faces_[k], point) <= 0) continue;
    next_outside_[point] = faces_[k].first_outside;
    faces_[k].first_outside = point;
    return;
  }
}

std::size_t ConvexHull::farthest_outside(const Face& face) const {
  std::size_t farthest = face.first_outside;
  std::int64_t most = height(face, farthest);
  for (std::size_t point = next_outside_[farthest]; point != kNone; point = next_outside_[point]) {
    const std::int64_t value = height(face, point);
    if (value <= most) continue;
    most = value;
    farthest = point;
  }
  return farthest;
}

// Collects the faces that are visible from the point, starting with `face`, and the edges around them: the horizon.
void ConvexHull::collect_visible(std::size_t face, std::size_t point) {
  visible_.assign(1, face);
  horizon_.clear();
  faces_[face].is_removed = true;
  for (std::size_t k = 0; k < visible_.size(); ++k) {
    const Face& seen = faces_[visible_[k]];
    for (std::size_t side = 0; side < 3; ++side) {
      const std::size_t beyond = seen.neighbours[side];
      if (faces_[beyond].is_removed) continue;
      if (height(faces_[beyond], point) > 0) {
        faces_[beyond].is_removed = true;
        visible_.push_back(beyond);
        continue;
      }
      const auto& back = faces_[beyond].neighbours;
      const auto there = static_cast<std::size_t>(std::find(back.begin(), back.end(), visible_[k]) - back.begin());
      horizon_.push_back({seen.vertices[side], seen.vertices[(side + 1) % 3], beyond, there});
    }
  }
}

// Adds the farthest point in front of a face. New faces from the point to the horizon replace the visible faces.
void ConvexHull::grow(std::size_t face) {
  const std::size_t apex = farthest_outside(faces_[face]);
  collect_visible(face, apex);
  const std::size_t first_new = faces_.size();
  for (const Edge& edge : horizon_) {
    const std::size_t added = add_face(edge.from, edge.to, apex);
    faces_[added].neighbours[0] = edge.beyond;
    faces_[edge.beyond].neighbours[edge.side] = added;
    face_from_[edge.from] = added;
  }
  for (std::size_t added = first_new; added < faces_.size(); ++added) {
    const std::size_t next = face_from_[faces_[added].vertices[1]];
    faces_[added].neighbours[1] = next;
    faces_[next].neighbours[2] = added;
  }
  for (const std::size_t seen : visible_) {
    for (std::size_t point = faces_[seen].first_outside; point != kNone;) {
      const std::size_t next = next_outside_[point];
      if (point != apex) hand_over(point, first_new);
      point = next;
    }
  }
}

}  // namespace supernormal
