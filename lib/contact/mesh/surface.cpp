#include "contact/mesh/surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace supernormal {
namespace {

// A triangle whose height is less than this fraction of its longest side has no reliable normal.
constexpr double kNoHeight = 1e-12;

// The normal of a contact with a vertex is known to the square root of its gap's tolerance, rad. With 0, bodies on slopes that are
// uneven by 1e-4 of a cell have up to 1 % more contacts.
constexpr double kLevel = 1e-5;

// The relative error of a coordinate in the world: a few roundings of doubles by the rotation of the mesh.
constexpr double kDigits = 4 * std::numeric_limits<double>::epsilon();

// Upper limit of a triangle's size in body sizes, so that cracks which the body might notice remain.
constexpr double kLargestFace = 1e3;

// Whether the rounding of the vertices explains the angle between two faces. It tilts a face by twice the rounding over the height.
bool may_be_flat(const Face& one, const Face& other) {
  const auto tilt_of = [](const Face& face) { return face.rounding * face.longest / face.area; };
  return one.normal.cross(other.normal).norm() <= tilt_of(one) + tilt_of(other);
}

// Whether the face rises out of the tangent plane by more than the contact tolerance and the seams. Without the rounding of the
// vertices, bricks on a sliver 1 km from the origin of the mesh lose 3 % of their contacts.
bool rises(const Face& face, const Vector3& normal, const Vector3& from, double contact_tolerance) {
  return std::any_of(face.vertices.begin(), face.vertices.end(), [&](const Vector3& vertex) {
    const Vector3 reach = vertex - from;
    return normal.dot(reach) > contact_tolerance + 4 * face.rounding + kLevel * reach.norm();
  });
}

// A plane through vertices of which each may be off by `rounding`. It grows by faces.
class RoundedPlane {
 public:
  explicit RoundedPlane(const Face& first) : origin_(first.vertices[0]) { add(first); }

  Vector3 normal() const { return sum_.normalized(); }
  double height() const { return normal().dot(origin_) + normal().dot(middle_); }

  // Whether the rounding of the vertices explains how far they are from the plane.
  bool may_have(const Face& face) const {
    const Vector3 normal = sum_.normalized();
    // Of the plane: rounding over its height. Without it, 11 of 1200 bricks on slopes of a sliver and a large triangle have
    // contacts with two normals, with it none.
    const double tilt = 2 * rounding_ * extent_ / area_;
    return normal.dot(face.normal) > 0 && std::all_of(face.vertices.begin(), face.vertices.end(), [&](const Vector3& vertex) {
             const Vector3 reach = vertex - origin_ - middle_;
             return std::abs(normal.dot(reach)) <= rounding_ + face.rounding + tilt * reach.norm();
           });
  }

  void add(const Face& face) {
    const std::array<Vector3, 3>& v = face.vertices;
    area_ += face.area;
    sum_ += face.area * face.normal;
    middle_ += face.area / area_ * (((v[0] - origin_) + (v[1] - origin_) + (v[2] - origin_)) / 3 - middle_);
    rounding_ = std::max(rounding_, face.rounding);
    for (const Vector3& vertex : v) extent_ = std::max(extent_, (vertex - origin_ - middle_).norm());
  }

 private:
  Vector3 sum_ = Vector3::Zero();     // m^2; of the normals times the areas
  Vector3 origin_;                    // m; so that a level plane has the height of its vertices
  Vector3 middle_ = Vector3::Zero();  // m; from the origin
  double area_ = 0;                   // m^2
  double extent_ = 0;                 // m; largest distance of a vertex from the middle
  double rounding_ = 0;               // m
};

}  // namespace

void Surface::build(std::span<const MeshTriangle> triangles, const Vector3& origin, double length_unit) {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  faces_.clear();
  largest_ = 0;
  for (const MeshTriangle& triangle : triangles) append(triangle, origin, length_unit);
  rounding_ = 1e-12 * length_unit + 8 * kEpsilon * (largest_ + origin.lpNorm<Eigen::Infinity>());
  contact_tolerance_ = 1e-7 * length_unit + rounding_;
  number_corners();
  match_edges();
  collect_patches();
  level_faces();
  join_parts();
}

void Surface::append(const MeshTriangle& triangle, const Vector3& origin, double length_unit) {
  if (!is_usable(triangle)) return;
  Face face;
  double longest = 0;
  double farthest = 0;
  for (int k = 0; k < 3; ++k) {
    face.vertices[at(k)] = triangle.vertices[at(k)] - origin;
    farthest = std::max(farthest, face.vertices[at(k)].lpNorm<Eigen::Infinity>());
  }
  std::array<Vector3, 3> edges;
  for (int k = 0; k < 3; ++k) {
    edges[at(k)] = face.vertices[at(next_corner(k))] - face.vertices[at(k)];
    longest = std::max(longest, edges[at(k)].norm());
  }
  const Vector3 area = edges[0].cross(edges[1]);  // twice the area times the normal
  const double length = area.norm();
  if (!(length > kNoHeight * longest * longest) || !std::isfinite(length)) return;
  face.normal = area / length;
  face.area = 0.5 * length;
  face.longest = longest;
  largest_ = std::max(largest_, farthest);
  face.rounding = triangle.rounding + kDigits * (farthest + origin.lpNorm<Eigen::Infinity>());
  // Vertices that should be one differ by their roundings. Without these, 702 of 1200 bricks on slopes of such triangles have
  // contacts with two normals, with them 230.
  face.seam = kSeam * std::min(longest, kLargestFace * length_unit) + 2 * face.rounding;
  face.triangle = triangle.index;
  face.corner = {-1, -1, -1};
  face.neighbour = {-1, -1, -1};
  face.convexity = {EdgeConvexity::Border, EdgeConvexity::Border, EdgeConvexity::Border};
  face.crack = {face.seam, face.seam, face.seam};
  face.patch = -1;
  face.next_in_patch = -1;
  faces_.push_back(face);
}

void Surface::number_corners() {
  // A grid has few vertices at one height along it. Its length is below 1, so that no distance along it exceeds the true one.
  const Vector3 direction(0.754, 0.569, 0.324);
  places_.clear();
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    for (int k = 0; k < 3; ++k) places_.push_back({direction.dot(faces_[f].vertices[at(k)]), static_cast<int>(f), k});
  }
  std::sort(places_.begin(), places_.end(), [](const Place& a, const Place& b) {
    return a.along != b.along ? a.along < b.along : std::pair(a.face, a.k) < std::pair(b.face, b.k);
  });
  corner_count_ = 0;
  for (auto place = places_.begin(); place != places_.end(); ++place) {
    Face& face = faces_[at(place->face)];
    int& corner = face.corner[at(place->k)];
    for (auto before = place; corner < 0 && before != places_.begin() && (--before)->along >= place->along - face.seam;) {
      const Face& other = faces_[at(before->face)];
      const double seam = std::min(face.seam, other.seam);
      const double squared = (other.vertices[at(before->k)] - face.vertices[at(place->k)]).squaredNorm();
      if (squared <= seam * seam) corner = other.corner[at(before->k)];
    }
    if (corner < 0) corner = corner_count_++;
  }
}

void Surface::match_edges() {
  uses_.clear();
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const std::array<int, 3>& corner = faces_[f].corner;
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(corner[at(k)], corner[at(next_corner(k))]);
      uses_.push_back(
          {std::uint64_t{static_cast<std::uint32_t>(low)} << 32U | static_cast<std::uint32_t>(high), static_cast<int>(f), k});
    }
  }
  std::sort(uses_.begin(), uses_.end(),
            [](const EdgeUse& a, const EdgeUse& b) { return a.edge != b.edge ? a.edge < b.edge : a.face < b.face; });
  for (auto begin = uses_.begin(); begin != uses_.end();) {
    const auto end = std::find_if(begin, uses_.end(), [&](const EdgeUse& use) { return use.edge != begin->edge; });
    match_uses({begin, end});
    begin = end;
  }
}

// The neighbour of a face traverses the edge in the opposite direction. Of several such faces the flattest is taken. The others are
// found when a contact is checked. Until there are patches, an edge is flat or not.
void Surface::match_uses(std::span<EdgeUse> uses) {
  for (const EdgeUse& use : uses) {
    Face& face = faces_[at(use.face)];
    double best = -std::numeric_limits<double>::infinity();
    for (const EdgeUse& other : uses) {
      const Face& candidate = faces_[at(other.face)];
      // The face itself, or one with the opposite winding.
      if (other.face == use.face || candidate.corner[at(other.side)] == face.corner[at(use.side)]) continue;
      const double flatness = face.normal.dot(candidate.normal);
      if (flatness <= best) continue;
      best = flatness;
      face.neighbour[at(use.side)] = other.face;
      face.convexity[at(use.side)] = flatness > 0 && may_be_flat(face, candidate) ? EdgeConvexity::Flat : EdgeConvexity::Convex;
      const double crack1 = (face.vertices[at(use.side)] - candidate.vertices[at(next_corner(other.side))]).norm();
      const double crack2 = (face.vertices[at(next_corner(use.side))] - candidate.vertices[at(other.side)]).norm();
      face.crack[at(use.side)] = std::max(crack1, crack2);
    }
  }
}

EdgeConvexity Surface::convexity_between(const Face& face, int side, const Face& neighbour) const {
  if (face.patch == neighbour.patch) return EdgeConvexity::Flat;
  // The faces may be back to back: the two sides of a sheet.
  const bool is_sheet = neighbour.normal.dot(face.normal) < 0 && may_be_flat(face, neighbour);
  return is_sheet || neighbour.normal.dot(face.outward[at(side)]) > 0 ? EdgeConvexity::Convex : EdgeConvexity::Concave;
}

// The faces of a patch have its plane, so the rounding of a small face tilts no contact.
void Surface::level_faces() {
  for (Face& face : faces_) {
    face.normal = patches_[at(face.patch)].normal;
    for (int k = 0; k < 3; ++k) {
      face.outward[at(k)] = (face.vertices[at(next_corner(k))] - face.vertices[at(k)]).cross(face.normal).normalized();
    }
  }
  for (Face& face : faces_) {
    for (int k = 0; k < 3; ++k) {
      if (face.neighbour[at(k)] >= 0) face.convexity[at(k)] = convexity_between(face, k, faces_[at(face.neighbour[at(k)])]);
    }
  }
}

void Surface::collect_patches() {
  patches_.clear();
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (faces_[f].patch < 0) grow_patch(static_cast<int>(f));
  }
}

void Surface::grow_patch(int seed) {
  const int number = static_cast<int>(patches_.size());
  RoundedPlane plane(faces_[at(seed)]);
  faces_[at(seed)].patch = number;
  int last = seed;
  for (int f = seed; f >= 0; f = faces_[at(f)].next_in_patch) {
    const Face& face = faces_[at(f)];
    for (std::size_t k = 0; k < 3; ++k) {
      if (face.convexity[k] != EdgeConvexity::Flat) continue;
      Face& neighbour = faces_[at(face.neighbour[k])];
      // Many nearly flat edges make a bend: compare with the plane of all.
      if (neighbour.patch >= 0 || !plane.may_have(neighbour)) continue;
      plane.add(neighbour);
      neighbour.patch = number;
      faces_[at(last)].next_in_patch = face.neighbour[k];
      last = face.neighbour[k];
    }
  }
  patches_.push_back({plane.normal(), plane.height(), seed, number});
}

void Surface::join_parts() {
  for (const Face& face : faces_) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (face.convexity[k] != EdgeConvexity::Convex && face.convexity[k] != EdgeConvexity::Flat) continue;
      const int part1 = find_part(face.patch);
      const int part2 = find_part(faces_[at(face.neighbour[k])].patch);
      patches_[at(std::max(part1, part2))].part = std::min(part1, part2);
    }
  }
  for (std::size_t p = 0; p < patches_.size(); ++p) patches_[p].part = find_part(static_cast<int>(p));
}

int Surface::find_part(int patch) {
  while (patches_[at(patch)].part != patch) {
    patches_[at(patch)].part = patches_[at(patches_[at(patch)].part)].part;
    patch = patches_[at(patch)].part;
  }
  return patch;
}

bool Surface::is_over(const Face& face, const Vector3& point) const {
  for (std::size_t k = 0; k < 3; ++k) {
    if (face.outward[k].dot(point - face.vertices[k]) > rounding_ + face.crack[k]) return false;
  }
  return true;
}

double Surface::rise_over_patch(const Face& face, const Vector3& point) const {
  const CoplanarPatch& patch = patches_[at(face.patch)];
  double rise = 0;
  for (int k = 0; k < 3; ++k) {
    const int side = next_corner(k);  // opposite to the vertex
    const Vector3& across = face.outward[at(side)];
    const Vector3& start = face.vertices[at(side)];
    const double weight = across.dot(start - point) / across.dot(start - face.vertices[at(k)]);
    rise += weight * (patch.normal.dot(face.vertices[at(k)]) - patch.height);
  }
  return rise;
}

Vector3 Surface::nearest_on_rim(const CoplanarPatch& patch, const Vector3& point, int& face_there, int& side_there) const {
  Vector3 nearest = Vector3::Zero();
  double least = std::numeric_limits<double>::infinity();
  face_there = patch.first_face;
  side_there = 0;
  for (int f = patch.first_face; f >= 0; f = faces_[at(f)].next_in_patch) {
    const Face& face = faces_[at(f)];
    for (int k = 0; k < 3; ++k) {
      if (face.convexity[at(k)] == EdgeConvexity::Flat) continue;
      const Vector3& start = face.vertices[at(k)];
      const Vector3 edge = face.vertices[at(next_corner(k))] - start;
      const double share = std::clamp(edge.dot(point - start) / edge.squaredNorm(), 0.0, 1.0);
      const Vector3 candidate = start + share * edge;
      const double squared = (candidate - point).squaredNorm();
      if (squared >= least) continue;
      least = squared;
      nearest = candidate;
      face_there = f;
      side_there = k;
    }
  }
  return nearest;
}

// Without the rounding of the vertices, 13 of 1200 balls on slopes of triangles with vertices of their own have two contacts, with
// it 9.
bool Surface::touches(const Face& face, const Vector3& point) const {
  const double near = std::max(contact_tolerance_, face.seam) + 2 * face.rounding;
  if (std::abs(face.normal.dot(point - face.vertices[0])) > near) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    if (face.outward[k].dot(point - face.vertices[k]) > near) return false;
  }
  return true;
}

bool Surface::is_on_face_at(int corner, const Vector3& point) const {
  return std::any_of(faces_.begin(), faces_.end(), [&](const Face& face) {
    return std::find(face.corner.begin(), face.corner.end(), corner) != face.corner.end() && touches(face, point);
  });
}

// Whether `point` is behind a face that touches `at`, and not in its plane up to a seam. Without the rounding of the vertices,
// bodies on slopes that are uneven by 1e-4 of a cell have 1 % more contacts.
bool Surface::is_behind(const Face& face, const Vector3& at, const Vector3& point) const {
  const Vector3 reach = point - at;
  return face.normal.dot(reach) < -(rounding_ + 2 * face.rounding + kLevel * reach.norm());
}

bool Surface::has_wall(const Vector3& normal, const Vector3& at, const Vector3& beyond) const {
  return std::any_of(faces_.begin(), faces_.end(), [&](const Face& face) {
    return is_behind(face, at, beyond) && touches(face, at) && rises(face, normal, at, contact_tolerance_);
  });
}

bool Surface::violates_normal_cone(const Vector3& normal, const Vector3& at, const Vector3& foot) const {
  return std::any_of(faces_.begin(), faces_.end(), [&](const Face& face) {
    return touches(face, at) && rises(face, normal, at, contact_tolerance_) && !is_behind(face, at, foot);
  });
}

// The fraction of the segment, 0...1, at which it meets the face. Infinite if it does not.
double Surface::share_to(const Face& face, const Vector3& start, const Vector3& end) const {
  constexpr double kNowhere = std::numeric_limits<double>::infinity();
  const double height1 = face.normal.dot(start - face.vertices[0]);
  const double height2 = face.normal.dot(end - face.vertices[0]);
  if (std::min(height1, height2) > rounding_ || std::max(height1, height2) < -rounding_) return kNowhere;
  const double rise = height2 - height1;
  const double share = rise == 0 ? 0.5 : std::clamp(-height1 / rise, 0.0, 1.0);
  if (!is_over(face, start + share * (end - start))) return kNowhere;
  return share;
}

bool Surface::is_crossed(const Vector3& start, const Vector3& end, int first) const {
  return share_to(faces_[at(first)], start, end) <= 1 ||
         std::any_of(faces_.begin(), faces_.end(), [&](const Face& face) { return share_to(face, start, end) <= 1; });
}

bool Surface::exits_solid(const Vector3& start, const Vector3& end) const {
  double least = std::numeric_limits<double>::infinity();
  bool is_outward = false;
  for (const Face& face : faces_) {
    const double share = share_to(face, start, end);
    if (!(share < least)) continue;
    least = share;
    is_outward = face.normal.dot(end - start) > 0;
  }
  return is_outward;
}

}  // namespace supernormal
