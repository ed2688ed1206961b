#include "kernel/face_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernel/fading.hpp"

namespace granular {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;  // rad

// The sine of the angle between edges that count as parallel: such corners have no weight, up to rounding, by which their
// derivative would be divided. 0, a quarter and four times: all tests of faces hold.
constexpr double kParallel = 1e-9;

double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

auto& at(auto& array, int k) { return array[static_cast<std::size_t>(k)]; }

/// A directed edge of one of the polygons, in the plane of face 2.
struct Edge {
  Vector2 start;
  Vector2 direction;  // unit for face 1
  double rise;        // of the edge above face 2, by its length in the plane; 0 for edges of face 2
};

/// A corner of the region, with the edges before and after it.
struct Corner {
  Vector2 place;
  int in, out;
};

/// The region in which two faces overlap, in the plane of face 2: x and y in the plane, z out of body 2. Face 1 is a sloped plane.
/// All depths are those of its points below z = 0.
class Region {
 public:
  static constexpr int kFirstOfTwo = Face::kMostVertices;  // edges from here on belong to face 2

  Region(const FacePose& face1, const Matrix3& frame, const Vector3& origin) : frame_(frame), origin_(origin) {
    const Vector3 normal = frame.transpose() * face1.frame.col(2);
    const Vector3 centre = frame.transpose() * (face1.centre - origin);
    slope_ = normal.head<2>() / normal.z();
    depth_ = -centre.z() - slope_.dot(centre.head<2>());
    const Eigen::Matrix<double, 3, 2> sides = frame.transpose() * face1.frame.leftCols<2>();
    std::array<Vector3, Face::kMostVertices> vertices;
    // Seen from outside of body 2, face 1 is clockwise.
    const int count = face1.face->count;
    for (int k = 0; k < count; ++k) at(vertices, k) = sides * at(face1.face->vertices, count - 1 - k) + centre;
    for (int k = 0; k < count; ++k) {
      const int next = (k + 1) % count;
      const Vector3 along = at(vertices, next) - at(vertices, k);
      const double length = along.head<2>().norm();
      at(edges_, k) = {at(vertices, k).head<2>(), along.head<2>() / length, along.z() / length};
      at(corners_, k) = {at(vertices, k).head<2>(), (k + count - 1) % count, k};
    }
    count_ = count;
  }

  /// Cuts away what is not above face 2.
  void clip(const Patch& face2) {
    const int count = static_cast<int>(face2.size());
    for (int k = 0; k < count && count_ > 0; ++k) {
      const Vector2& start = at(face2, k);
      const Vector2 along = at(face2, (k + 1) % count) - start;
      at(edges_, kFirstOfTwo + k) = {start, along, 0};
      clip(kFirstOfTwo + k);
    }
  }

  Eigen::AlignedBox2d box() const {
    Eigen::AlignedBox2d box;
    for (int k = 0; k < count_; ++k) box.extend(at(corners_, k).place);
    return box;
  }

  double area() const {
    double twice = 0;
    for (int k = 1; k + 1 < count_; ++k) {
      twice += cross(at(corners_, k).place - at(corners_, 0).place, at(corners_, k + 1).place - at(corners_, 0).place);
    }
    return 0.5 * twice;
  }

  /// Adds corners, means and their derivatives.
  void add_corners(FaceContact& contact) const {
    Vector3 turning = Vector3::Zero(), turning_of_mean = Vector3::Zero();
    for (int k = 0; k < count_; ++k) {
      const Corner& corner = at(corners_, k);
      const double depth = depth_at(corner.place);
      if (depth <= 0) continue;
      const double weight = turning_angle(corner) / kTurn;
      at(contact.corners, contact.count++) = {lift(corner.place), -frame_.col(2), frame_ * lateral(corner), depth, weight};
      contact.mean_square += weight * depth * depth;
      contact.mean += weight * depth;
      const Vector3 growth = (rotation_of(corner.out) - rotation_of(corner.in)) / kTurn;  // of the weight
      turning += depth * depth * growth;
      turning_of_mean += depth * growth;
    }
    contact.turning = frame_ * turning;
    contact.turning_of_mean = frame_ * turning_of_mean;
  }

  /// The derivatives of the area by a displacement and a rotation (about the origin) of body 1.
  void add_area_derivatives(double factor, Vector3& by_way, Vector3& by_turn) const {
    for (int k = 0; k < count_; ++k) {
      const Corner &here = at(corners_, k), &next = at(corners_, (k + 1) % count_);
      if (here.out >= kFirstOfTwo) continue;
      const Vector2 along = next.place - here.place;
      const Vector3 growth = factor * (frame_ * Vector3(along.y(), -along.x(), 0));
      by_way += growth;
      by_turn += (lift(0.5 * (here.place + next.place)) - origin_).cross(growth);
    }
  }

 private:
  double depth_at(const Vector2& place) const { return depth_ + slope_.dot(place); }

  Vector3 lift(const Vector2& place) const { return origin_ + frame_ * Vector3(place.x(), place.y(), -depth_at(place)); }

  /// Sutherland and Hodgman's clipping by one edge. The new corners name their edges, so an edge of no length is harmless.
  void clip(int by) {
    const Edge& edge = at(edges_, by);
    std::array<Corner, FaceContact::kMostCorners> kept;
    int count = 0;
    for (int k = 0; k < count_; ++k) {
      const Corner &here = at(corners_, k), &next = at(corners_, (k + 1) % count_);
      const double inside = cross(edge.direction, here.place - edge.start),
                   next_inside = cross(edge.direction, next.place - edge.start);
      if (inside >= 0) at(kept, count++) = here;
      if ((inside >= 0) == (next_inside >= 0)) continue;
      const Vector2 place = here.place + inside / (inside - next_inside) * (next.place - here.place);
      at(kept, count++) = inside >= 0 ? Corner{place, here.out, by} : Corner{place, by, here.out};
    }
    std::copy_n(kept.begin(), count, corners_.begin());
    count_ = count;
  }

  double turning_angle(const Corner& corner) const {
    const Vector2 &in = at(edges_, corner.in).direction, &out = at(edges_, corner.out).direction;
    const double angle = std::atan2(cross(in, out), in.dot(out));
    return angle < -0.25 * kTurn ? angle + kTurn : angle;
  }

  /// d(angle of an edge) by a rotation of body 1.
  Vector3 rotation_of(int edge) const {
    if (edge >= kFirstOfTwo) return Vector3::Zero();
    const Edge& moved = at(edges_, edge);
    return {-moved.rise * moved.direction.x(), -moved.rise * moved.direction.y(), 1};
  }

  /// How the depth of a corner depends on a displacement along the plane.
  Vector3 lateral(const Corner& corner) const {
    const bool in_of_one = corner.in < kFirstOfTwo, out_of_one = corner.out < kFirstOfTwo;
    if (in_of_one && out_of_one) return Vector3::Zero();  // a vertex of face 1 moves with it
    Vector2 by_way = -slope_;                             // a vertex of face 2 stands, and face 1 moves past it
    if (in_of_one != out_of_one) {
      // A crossing moves along the edge of face 2.
      const Vector2& edge1 = at(edges_, in_of_one ? corner.in : corner.out).direction;
      const Vector2 edge2 = at(edges_, in_of_one ? corner.out : corner.in).direction.normalized();
      const Vector2 outwards(edge1.y(), -edge1.x());
      const double sine = edge2.dot(outwards);
      if (std::abs(sine) > kParallel) by_way += slope_.dot(edge2) / sine * outwards;
    }
    return {by_way.x(), by_way.y(), 0};
  }

  Matrix3 frame_;
  Vector3 origin_;
  Vector2 slope_;  // of the depth
  double depth_;   // m; at the origin
  std::array<Edge, std::size_t{2} * Face::kMostVertices> edges_;
  std::array<Corner, FaceContact::kMostCorners> corners_;
  int count_ = 0;
};

/// The face of a body whose outward normal is nearest to `direction`.
std::optional<FacePose> find_face(const Body& body, const Vector3& direction) {
  const Vector3 own = body.pose.rotation.transpose() * direction;
  int axis = 0;
  own.cwiseAbs().maxCoeff(&axis);
  const auto face = std::find_if(body.faces.begin(), body.faces.end(), [&](const Face& one) { return one.axis == axis; });
  if (face == body.faces.end()) return std::nullopt;
  return FacePose(*face, own[axis] > 0 ? 1 : -1, body.pose);
}

/// The same contact with the bodies exchanged.
void exchange(FaceContact& contact) {
  contact.turning = -contact.turning;
  contact.turning_of_mean = -contact.turning_of_mean;
  contact.share_by_way = -contact.share_by_way;
  contact.share_by_turn = -contact.share_by_turn;
  for (int k = 0; k < contact.count; ++k) {
    FaceCorner& corner = at(contact.corners, k);
    corner.normal = -corner.normal;
    corner.lateral = -corner.lateral;
  }
}

/// The contact of two faces.
std::optional<FaceContact> find_contact(FacePose face1, FacePose face2) {
  // The smaller face is laid over the larger one.
  const bool exchanged = face1.face->width > face2.face->width;
  if (exchanged) std::swap(face1, face2);
  const Tilt tilt(face1.frame.col(2), face2.frame.col(2), std::min(face1.face->tilt, face2.face->tilt));
  if (tilt.share == 0) return std::nullopt;
  Region region(face1, face2.frame, face2.centre);
  region.clip(face2.face->outline());
  const double full = kFullOverlap * face1.face->width * face1.face->width;
  const Ramp overlap(region.area() / full);
  if (overlap.value == 0) return std::nullopt;

  FaceContact contact;
  contact.origin = face2.centre;
  region.add_corners(contact);
  contact.share = tilt.share * overlap.value;
  contact.share_by_turn = overlap.value * tilt.by_turn;
  region.add_area_derivatives(tilt.share * overlap.slope / full, contact.share_by_way, contact.share_by_turn);
  if (exchanged) exchange(contact);
  return contact;
}

/// Multiplies the share by how far the patches are under all of a face. Returns whether it is above 0.
bool find_cover(const Region& whole, std::span<const Patch> patches, FaceContact& contact) {
  double covered = 0;
  Vector3 by_way = Vector3::Zero(), by_turn = Vector3::Zero();
  const Eigen::AlignedBox2d box = whole.box();
  for (const Patch& patch : patches) {
    Eigen::AlignedBox2d of_patch;
    for (const Vector2& vertex : patch) of_patch.extend(vertex);
    if (!box.intersects(of_patch)) continue;
    Region part = whole;
    part.clip(patch);
    covered += part.area();
    part.add_area_derivatives(1, by_way, by_turn);
  }
  const double area = whole.area();
  const Ramp cover(1 - (1 - covered / area) / kFullOverlap);
  if (cover.value == 0) return false;
  whole.add_area_derivatives(-covered / area, by_way, by_turn);
  const double factor = contact.share * cover.slope / (kFullOverlap * area);
  contact.share_by_way = factor * by_way;
  contact.share_by_turn = cover.value * contact.share_by_turn + factor * by_turn;
  contact.share *= cover.value;
  return true;
}

/// The contact of a side of a body with the face of another.
std::optional<FaceContact> find_contact(const Body& body, const FacePose& face) {
  const Patch patch = face.face->outline();
  return find_side_contact(body, {face.frame, face.centre, {&patch, 1}, false, face.face->width, face.face->tilt});
}

}  // namespace

// Faces and sides of a body count in full up to an eighth of a turn, and meet at a right angle: never both.
std::optional<FaceContact> find_face_contact(const Body& body1, const Body& body2, const Vector3& normal) {
  if (!body1.is_flat() || !body2.is_flat()) return std::nullopt;
  const std::optional<FacePose> face1 = find_face(body1, normal), face2 = find_face(body2, -normal);
  if (face1 && face2) return find_contact(*face1, *face2);
  if (face2) return find_contact(body1, *face2);
  if (!face1) return find_side_pair_contact(body1, body2, normal);
  std::optional<FaceContact> contact = find_contact(body2, *face1);
  if (contact) exchange(*contact);
  return contact;
}

std::optional<FaceContact> find_ground_contact(const Body& body, const Ground& ground) {
  const Vector3 out = ground.frame.col(2);
  const std::optional<FacePose> face = find_face(body, -out);
  if (!face) return find_side_contact(body, ground);
  const Tilt tilt(face->frame.col(2), out, face->face->tilt);
  if (tilt.share == 0) return std::nullopt;
  const Region whole(*face, ground.frame, ground.origin);
  FaceContact contact;
  contact.origin = ground.origin;
  contact.share = tilt.share;
  contact.share_by_turn = tilt.by_turn;
  if (ground.is_surface && !find_cover(whole, ground.patches, contact)) return std::nullopt;
  whole.add_corners(contact);
  return contact;
}

Ground Ground::plane(const Vector3& point, const Vector3& normal) {
  Ground ground;
  ground.frame << normal.unitOrthogonal(), Vector3::Zero(), normal;
  ground.frame.col(1) = normal.cross(ground.frame.col(0));
  ground.origin = point;
  return ground;
}

}  // namespace granular
