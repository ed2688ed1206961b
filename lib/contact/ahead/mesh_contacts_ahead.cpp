#include "supernormal/contact/mesh_contacts_ahead.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "contact/ahead/motion_in_step.hpp"
#include "contact/ahead/small_rotation.hpp"
#include "contact/manifold/common_corners.hpp"
#include "contact/mesh/mesh_triangle.hpp"
#include "supernormal/impact/mesh_time_of_impact.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/raycast/ray.hpp"
#include "supernormal/shapes/polytope.hpp"

namespace supernormal {
namespace {

// After an impact the body slides along the surface: from the floor to a wall, then into the corner behind. Of 2000 bodies that fly
// into a corner of three walls at 1 to 100 sizes a step, 844 end behind it with 1, 159 with 2, 13 with 3, 4 and 8. Those 13 are
// left by 20 iterations of quickstep.
constexpr int kMostImpacts = 4;

// The body slides along a face that it approaches by less than this fraction of its speed, plus the tilt of the face by rounding.
constexpr double kAlong = 1e-9;

// Two contacts belong to one face if their normals differ by less than kSameNormal, and their gaps by less than this fraction of
// search.near. Both are of a plane through the vertices below the body, so rounding adds to both.
constexpr double kSameNormal = 1e-6;
constexpr double kSameGap = 1e-3;

// A body that approaches a face by less than this fraction of its smallest half-extent in the step does not pass it.
constexpr double kSliding = 0.5;

/// Whether the contact with a lone triangle is one with the surface. The edges of the triangle need not be edges of the surface.
bool is_of_surface(const Proximity& there, const MeshContacts& surface) { return surface.has_normal(-there.normal, there.point2); }

/// The first impact of a body on triangles that it hits from outside.
class FirstImpact {
 public:
  /// `passed`: if not null, nothing holds the body back at its place. These are its contacts there.
  FirstImpact(const BodyAhead& body, double whole_time, double size, const MeshContacts* passed, const Settings& settings)
      : time(whole_time), body_(&body), size_(size), passed_(passed), settings_(&settings) {}

  void look_at(const MeshTriangle& face) {
    if (!is_usable(face)) return;
    const Vector3& velocity = body_->motion.velocity;
    const std::array<Vector3, 3>& v = face.vertices;
    const Vector3 area = (v[1] - v[0]).cross(v[2] - v[0]);
    const Vector3 inward = -area.normalized();
    const double closing = inward.dot(velocity);
    const double tilt = 2 * face.rounding * longest_side(face) / area.norm();
    if (!(closing > (kAlong + tilt) * velocity.norm())) return;
    // The tangent plane parallel to the face reaches it no later than the body does.
    ++evaluations;
    const Matrix3& rotation = body_->pose.rotation;
    const double gap = inward.dot(v[0] - body_->pose.position) - body_->shape.support(rotation.transpose() * inward);
    if (gap >= closing * time) return;
    const Vector3 middle = (v[0] + v[1] + v[2]) / 3;
    const std::array<Vector3, 3> corners = {v[0] - middle, v[1] - middle, v[2] - middle};
    if (meets(Polytope(corners), middle)) triangle = face.index;
  }

  double time;  ///< s; of the impact, or the whole time
  bool hits = false;
  Proximity there;  ///< at the impact
  int triangle = 0;
  int evaluations = 0;

 private:
  bool meets(const Polytope& shape, const Vector3& middle) {
    const BodyAhead surface{shape, {middle, Matrix3::Identity()}, {}};
    const Proximity now = find_proximity(body_->shape, body_->pose, shape, surface.pose, *settings_);
    evaluations += now.evaluations;
    if (now.status == Status::InvalidInput) return false;
    const Meeting meeting = find_meeting(*body_, surface, time, size_, *settings_, now);
    evaluations += meeting.evaluations - now.evaluations;
    if (!meeting.hits) return false;
    if (passed_ != nullptr && meeting.time == 0 && !is_of_surface(meeting.there, *passed_)) return false;
    hits = true;
    time = meeting.time;
    there = meeting.there;
    const Pose pose{body_->pose.position + time * body_->motion.velocity, body_->pose.rotation};
    const RayHit on_body = find_ray_hit(body_->shape, pose, there.contact + size_ * there.normal, -there.normal, 2 * size_);
    evaluations += on_body.evaluations;
    if (on_body.hit) there.contact = on_body.point;
    return true;
  }

  const BodyAhead* body_;
  double size_;
  const MeshContacts* passed_;
  const Settings* settings_;
};

/// Whether the segment between two points meets the triangle.
bool is_between(const MeshTriangle& triangle, const Vector3& from, const Vector3& to) {
  const Vector3 along = to - from;
  const Vector3 a = triangle.vertices[0] - from;
  const Vector3 b = triangle.vertices[1] - from;
  const Vector3 c = triangle.vertices[2] - from;
  // The volumes on the three sides of the line have one sign where it goes through the triangle.
  const Vector3 volumes(a.cross(b).dot(along), b.cross(c).dot(along), c.cross(a).dot(along));
  if ((volumes.array() < 0).any() && (volumes.array() > 0).any()) return false;
  const Vector3 normal = (b - a).cross(c - a);
  const double height = normal.dot(a);
  const double whole = normal.dot(along);
  return whole != 0 && height / whole >= 0 && height / whole <= 1;
}

/// Whether a contact is behind all triangles that it touches, as of a body that has passed the border of a sheet.
bool is_behind(const Proximity& contact, std::span<const MeshTriangle> triangles, double touch) {
  bool touches_any = false;
  for (const MeshTriangle& triangle : triangles) {
    const std::array<Vector3, 3>& v = triangle.vertices;
    const Vector3 normal = (v[1] - v[0]).cross(v[2] - v[0]).stableNormalized();
    bool touches = std::abs(normal.dot(contact.point2 - v[0])) <= touch;
    for (std::size_t k = 0; k < 3 && touches; ++k) {
      const Vector3 inward = normal.cross(v[(k + 1) % 3] - v[k]).stableNormalized();
      touches = inward.dot(contact.point2 - v[k]) >= -touch;
    }
    if (!touches) continue;
    if (contact.normal.dot(normal) <= 0) return false;
    touches_any = true;
  }
  return touches_any;
}

/// The tangent plane of a surface.
struct Plane {
  Vector3 inward;
  double offset;  // m

  /// Whether the triangle is on or behind the plane.
  bool is_in_front_of(const MeshTriangle& triangle) const {
    return std::all_of(triangle.vertices.begin(), triangle.vertices.end(),
                       [&](const Vector3& vertex) { return inward.dot(vertex) >= offset; });
  }
};

/// The velocity along a wall with this normal.
Vector3 along_wall(const Vector3& velocity, const Vector3& normal) {
  return velocity - std::max(0.0, velocity.dot(normal)) * normal;
}

}  // namespace

struct MeshContactsAhead::Search {
  const BodyAhead& body;  // at its position along the path
  const BodyAhead& now;
  const MotionAhead& surface;
  double time;  // s
  std::span<const MeshTriangle> triangles;
  const Settings& settings;
  double near;                         // m; a gap up to this is a contact
  double share;                        // the body's share of the mobilities
  double size;                         // m; the smallest half-extent of the body
  double graze;                        // m; a deeper overlap is an impact
  double rounding;                     // m; of the vertices
  double overlap = 0;                  // m; at present
  const SurfaceFrame* slid = nullptr;  // at the place of the body, to which it has slid and turned; null: it has not turned

  /// The largest gap of a contact with this normal: what the body approaches in the step or on its way there may be no farther.
  double reach_along(const Vector3& normal, const Vector3& way) const {
    return std::max({0.0, approach_of(now.motion, surface, time, normal, 0), normal.dot(way)}) + near;
  }

  /// The surface at a contact, higher by the graze.
  Plane plane_of(const ContactManifold& contacts) const {
    const Proximity& contact = contacts.deepest;
    return {contact.normal, contact.normal.dot(contact.contact) + share * contact.gap - graze};
  }
};

/// The surface at the end of a motion. The motion must outlive it.
struct MeshContactsAhead::SurfaceFrame {
  SurfaceFrame(const Search& search, const FreeMotion& free_motion)
      : free(free_motion),
        motion{{}, free.motion2().velocity, free.motion2().angular_velocity, search.surface.centre},
        end(pose_at(motion, search.time)) {}

  /// The pose of the body in the frame of the surface.
  Pose pose_at_end() const {
    const Pose pose = free.end1();
    return {end.rotation.transpose() * (pose.position - end.position), end.rotation.transpose() * pose.rotation};
  }

  /// Moves contacts at the end, in the frame of the surface, back to the present poses.
  void take_back(double share, ContactManifold& contacts) const {
    const auto to_end = [&](Vector3& place) { place = end.rotation * place + end.position; };
    contacts.deepest.normal = end.rotation * contacts.deepest.normal;
    to_end(contacts.deepest.contact);
    for (ManifoldCorner& corner : contacts.corners) to_end(corner.point);
    if (contacts.placed_on) contacts.placed_on = {contacts.placed_on->shape, free.end1(), contacts.deepest.normal};
    free.take_back(share, contacts);
  }

  const FreeMotion& free;
  Motion motion;
  Pose end;
};

MeshContactsAhead::Reach MeshContactsAhead::reach_of(const BodyAhead& body, const MotionAhead& surface, double time) {
  if (!is_finite(body.motion) || !is_finite(surface)) return reach_of({body.shape, body.pose, {}}, {}, time);
  const Vector3 half_way = 0.5 * time * (body.motion.velocity - surface.velocity);
  const double size = body.shape.half_extents().minCoeff();
  // By Thales, all positions along a wall lie on the sphere whose diameter is the displacement without the wall.
  return {half_way, half_way.norm() + nearness_of_both(body.motion, surface, time, size)};
}

std::span<const MeshManifold> MeshContactsAhead::find(const BodyAhead& body, const MotionAhead& surface, double time,
                                                      std::span<const MeshTriangle> triangles, const Settings& settings) {
  if (!is_finite(body.motion) || !is_finite(surface)) {
    return find({body.shape, body.pose, {}}, {}, time, triangles, settings);
  }
  found_.clear();
  evaluations_ = 0;
  const double size = body.shape.half_extents().minCoeff();
  const double near = nearness_of_both(body.motion, surface, time, size);
  BodyAhead there = body;
  there.motion.velocity -= surface.velocity;
  double rounding = 0;
  for (const MeshTriangle& triangle : triangles) rounding = std::max(rounding, triangle.rounding);
  Search search{there, body,          surface, time, triangles, settings, near, share_of_first(body.motion, surface),
                size,  kGraze * size, rounding};
  search.overlap = add_overlaps(search);
  double left = time;
  const MeshContacts* passed = nullptr;
  for (int impact = 0; impact < kMostImpacts; ++impact) {
    FirstImpact first(there, left, size, passed, settings);
    for (const MeshTriangle& triangle : triangles) first.look_at(triangle);
    evaluations_ += first.evaluations;
    left -= first.time;
    there.pose.position += first.time * there.motion.velocity;
    const Vector3 way = there.pose.position - body.pose.position;
    add_contacts(search, way);
    if (!first.hits) {
      if (slides(search)) find_at_end(search, there, way);
      break;
    }
    if (!holds_back(there.motion.velocity)) add_continued(search, way);
    if (!holds_back(there.motion.velocity) && is_of_surface(first.there, contacts_)) {
      add(search, first.there, first.triangle, way);
    }
    passed = holds_back(there.motion.velocity) ? nullptr : &contacts_;
    for (const MeshManifold& found : found_) {
      const ContactManifold& manifold = found.manifold;
      const double gap_there = manifold.deepest.gap - manifold.deepest.normal.dot(way);
      if (gap_there <= 0) there.motion.velocity = along_wall(there.motion.velocity, manifold.deepest.normal);
    }
  }
  leave_free_motion(search);
  std::sort(found_.begin(), found_.end(), [](const MeshManifold& one, const MeshManifold& other) {
    const double gap1 = one.manifold.deepest.gap, gap2 = other.manifold.deepest.gap;
    return gap1 != gap2 ? gap1 < gap2 : one.triangle < other.triangle;
  });
  return found_;
}

/// Whether a contact blocks the velocity.
bool MeshContactsAhead::holds_back(const Vector3& velocity) const {
  return std::any_of(found_.begin(), found_.end(), [&](const MeshManifold& found) {
    return found.manifold.deepest.normal.dot(velocity) > kAlong * velocity.norm();
  });
}

/// Replaces the contacts that take something away from the free motion by the contact at its end, if the body does not meet the
/// surface. On a floor the body does not fall: the motion and the triangles are those that the floor leaves.
void MeshContactsAhead::leave_free_motion(const Search& search) {
  const BodyAhead surface{search.now.shape, search.now.pose, search.surface};
  FreeMotion free(search.now, surface, search.time);
  if (!free.bends()) return;
  const double negligible = search.settings.tolerance * search.size;
  const auto holds_back = [&](const MeshManifold& found) { return free.held_back_by(found.manifold) > negligible; };
  const Pose end = SurfaceFrame(search, free).pose_at_end();
  const auto others = std::partition(found_.begin(), found_.end(), [&](const MeshManifold& found) {
    return holds_back(found) && (found.manifold.deepest.gap < 0 ||
                                 goes_through(search, search.now.pose, end, found.manifold.deepest.normal, &found.manifold));
  });
  FreeMotion borne(without_forces(search.now), without_forces(surface), search.time);
  std::span<const MeshTriangle> triangles = search.triangles;
  for (auto floor = found_.begin(); floor != others; ++floor) {
    for (FreeMotion* motion : {&free, &borne}) motion->stop_at(floor->manifold);
    triangles = leave_in_front(search, triangles, floor->manifold);
  }
  if (std::none_of(others, found_.end(), holds_back)) return;
  const auto contacts_after = [&](const FreeMotion& motion) { return find_after(search, motion, triangles); };
  const auto left = choose_contacts(free, borne, search.graze, negligible, contacts_after, &MeshManifold::manifold);
  if (!left) return;
  found_.erase(std::remove_if(others, found_.end(), holds_back), found_.end());
  if (left->manifold.deepest.status != Status::Apart) found_.push_back(*left);
}

/// The contact at the end of a motion on which the body does not meet the triangles. Apart if it is behind them there.
std::optional<MeshManifold> MeshContactsAhead::find_after(const Search& search, const FreeMotion& motion,
                                                          std::span<const MeshTriangle> triangles) {
  const Shape& shape = search.body.shape;
  const SurfaceFrame frame(search, motion);
  const Pose there = frame.pose_at_end();
  MeshContact nearest = find_nearest_of_surface(search, there, triangles);
  if (nearest.proximity.status == Status::InvalidInput || !(nearest.proximity.gap > 0)) return std::nullopt;
  const Impact impact =
      find_mesh_time_of_impact(shape, motion.motion1(), triangles, frame.motion, search.time, search.settings).impact;
  evaluations_ += impact.evaluations;
  if (impact.may_hit()) return std::nullopt;
  if (is_behind(nearest.proximity, triangles, search.settings.tolerance * search.size + search.rounding)) {
    nearest.proximity.status = Status::Apart;
    nearest.proximity.gap = std::numeric_limits<double>::infinity();
    return MeshManifold{nearest.proximity, nearest.triangle};
  }
  nearest.proximity.contact += (0.5 - search.share) * nearest.proximity.gap * nearest.proximity.normal;
  ContactManifold manifold = manifold_of(search, there, nearest.proximity, 0);
  frame.take_back(search.share, manifold);
  manifold.reach = search.reach_along(manifold.deepest.normal, Vector3::Zero());
  return MeshManifold{manifold, nearest.triangle};
}

/// The nearest triangle, with a normal of the surface. Where triangles behind a floor are left out, those beside them have edges
/// that are none of the surface.
MeshContact MeshContactsAhead::find_nearest_of_surface(const Search& search, const Pose& there,
                                                       std::span<const MeshTriangle> triangles) {
  const bool is_complete = triangles.data() != in_front_.data();
  for (std::size_t count = triangles.size();;) {
    const MeshContact nearest = find_nearest_triangle(search.body.shape, there, triangles.first(count), search.settings);
    const Proximity& found = nearest.proximity;
    evaluations_ += found.evaluations;
    if (is_complete || found.status == Status::InvalidInput || !(found.gap > 0) || is_of_surface(found, contacts_)) return nearest;
    std::swap(*std::ranges::find(in_front_, nearest.triangle, &MeshTriangle::index), in_front_[--count]);
  }
}

/// Whether a triangle, behind the contact `floor` if there is one, is between the highest point of the body now and its deepest
/// point at `end`. At one pose this proves an overlap.
bool MeshContactsAhead::goes_through(const Search& search, const Pose& now, const Pose& end, const Vector3& downwards,
                                     const ContactManifold* floor) {
  const Shape& shape = search.body.shape;
  const Vector3 highest = now.position + now.rotation * shape.point(now.rotation.transpose() * -downwards);
  const Vector3 deepest = end.position + end.rotation * shape.point(end.rotation.transpose() * downwards);
  evaluations_ += 2;
  const std::optional<Plane> plane = floor != nullptr ? std::optional(search.plane_of(*floor)) : std::nullopt;
  return std::any_of(search.triangles.begin(), search.triangles.end(), [&](const MeshTriangle& triangle) {
    return (!plane || plane->is_in_front_of(triangle)) && is_between(triangle, highest, deepest);
  });
}

/// The triangles that are not behind a contact.
std::span<const MeshTriangle> MeshContactsAhead::leave_in_front(const Search& search, std::span<const MeshTriangle> triangles,
                                                                const ContactManifold& floor) {
  if (triangles.data() != in_front_.data()) in_front_.assign(triangles.begin(), triangles.end());
  const Plane plane = search.plane_of(floor);
  std::erase_if(in_front_, [&](const MeshTriangle& triangle) { return plane.is_in_front_of(triangle); });
  return in_front_;
}

/// A body that already overlaps the surface keeps its present contacts, at any motion. Returns the depth of the deepest, m.
double MeshContactsAhead::add_overlaps(const Search& search) {
  const std::span<const MeshContact> contacts =
      contacts_.find(search.body.shape, search.body.pose, search.triangles, search.settings);
  evaluations_ += contacts_.evaluations();
  double deepest = 0;
  for (const MeshContact& contact : contacts) {
    if (contact.proximity.gap <= -search.graze) add(search, contact.proximity, contact.triangle, Vector3::Zero());
    deepest = std::max(deepest, -contact.proximity.gap);
  }
  return deepest;
}

/// The sweep of a body that is apart from the surface overlaps it by no more than its radius. There are two exceptions, which are
/// no contacts of the body. Behind a sheet, everything in front of the sheet is overlap. At a border, the contact's normal need not
/// separate the body, so the contact must not push it.
void MeshContactsAhead::add_contacts(const Search& search, const Vector3& way) {
  const std::span<const MeshContact> contacts =
      contacts_.find_within(search.near, search.body.shape, search.body.pose, search.triangles, search.settings);
  evaluations_ += contacts_.evaluations();
  const bool is_apart = is_apart_now(search, contacts);
  for (const MeshContact& contact : contacts) {
    Proximity there = contact.proximity;
    if (is_apart && there.gap <= -search.graze) continue;
    if (is_apart) there.gap = std::max(there.gap, 0.0);
    add(search, there, contact.triangle, way);
  }
}

/// Whether the body slides from face to face, and passes none in the step.
bool MeshContactsAhead::slides(const Search& search) const {
  const double most = kSliding * search.size;
  return found_.size() > 1 && shift_by_rotation(search.now.motion, search.time) < most &&
         std::ranges::all_of(found_, [&](const MeshManifold& found) {
           const Proximity& contact = found.manifold.deepest;
           return approach_of(search.now.motion, search.surface, search.time, contact.normal, std::min(0.0, contact.gap)) < most;
         });
}

/// Replaces the contacts of a body that slides by those at the end of its way, for its orientation there.
void MeshContactsAhead::find_at_end(const Search& search, BodyAhead& there, const Vector3& way) {
  BodyAhead along = search.now;
  along.motion.velocity = search.surface.velocity + way / search.time;
  along.motion.acceleration.setZero();
  const FreeMotion slide(along, without_forces({search.now.shape, search.now.pose, search.surface}), search.time);
  const SurfaceFrame frame(search, slide);
  Search at_end = search;
  at_end.slid = &frame;
  there.pose = frame.pose_at_end();
  found_.clear();
  add_contacts(at_end, way);
}

/// In a valley the body overlaps one side, but the face at the other side holds it back.
void MeshContactsAhead::add_continued(const Search& search, const Vector3& way) {
  const Vector3& velocity = search.body.motion.velocity;
  for (const MeshContact& contact : contacts_.continued()) {
    const Proximity& there = contact.proximity;
    if (there.gap <= 0 && there.normal.dot(velocity) > kAlong * velocity.norm()) add(search, there, contact.triangle, way);
  }
}

/// Whether the body, at its position on the path, overlaps no triangle although the contacts of its sweep say so.
bool MeshContactsAhead::is_apart_now(const Search& search, std::span<const MeshContact> contacts) {
  const Shape& shape = search.body.shape;
  const Pose& pose = search.body.pose;
  bool overlaps = false;
  for (const MeshContact& contact : contacts) {
    if (contact.proximity.gap >= 0) continue;
    overlaps = true;
    // A resting body overlaps by rounding. A triangle between its deepest and its highest point proves the overlap at once.
    if (goes_through(search, pose, pose, contact.proximity.normal, nullptr)) return false;
  }
  if (!overlaps) return false;
  const Proximity nearest = find_nearest_triangle(shape, pose, search.triangles, search.settings).proximity;
  evaluations_ += nearest.evaluations;
  return nearest.status != Status::InvalidInput && nearest.gap > 0;
}

/// How much more a point of the body at the border of a sheet approaches by the rotation of a step than the body does, m. The
/// contact is no support point there, and its normal is not that of the body. So the points of a ball that rolls come down on the
/// border, but the ball does not.
double MeshContactsAhead::approach_in_excess(const Search& search, const Proximity& there) {
  const Vector3 rotation = search.time * (search.body.motion.angular_velocity - search.surface.angular_velocity);
  if (rotation.isZero(0)) return 0;
  const Shape& shape = search.body.shape;
  const Pose& pose = search.body.pose;
  const Vector3& normal = there.normal;
  ++evaluations_;
  const double extent = shape.support(pose.rotation.transpose() * normal) + normal.dot(pose.position);
  const double above = extent - normal.dot(there.contact);
  if (above <= search.settings.tolerance * search.size) return 0;
  const RayHit hit = find_ray_hit(shape, pose, there.contact + above * normal, -normal, above + search.size, search.settings);
  evaluations_ += hit.evaluations;
  const double cosine = hit.normal.dot(normal);
  if (!hit.hit || !(cosine > 0)) return 0;
  const Vector3 arm = there.contact - pose.position + search.now.pose.position - search.now.motion.centre;
  return std::max(0.0, rotation.dot(arm.cross(normal - hit.normal / cosine)));
}

/// The manifold of a contact with a face.
ContactManifold MeshContactsAhead::manifold_of(const Search& search, const Pose& pose, const Proximity& there, double approach) {
  ContactManifold manifold = find_plane_manifold_of_gaps(search.body.shape, pose, there, approach);
  draw_in_corners(manifold, search.triangles);
  return manifold;
}

void MeshContactsAhead::add(const Search& search, Proximity there, int triangle, const Vector3& way) {
  if (search.slid == nullptr) there.gap += approach_in_excess(search, there);
  const MotionAhead& motion = search.now.motion;
  double overlap = approach_of(motion, search.surface, search.time, there.normal, there.gap + there.normal.dot(way));
  if (search.slid == nullptr) overlap += growth_by_rotation(search.body, there.normal, there.point1, search.time);
  ContactManifold manifold = manifold_of(search, search.body.pose, there, overlap);
  if (search.slid != nullptr) {
    search.slid->take_back(search.share, manifold);
    limit_overlaps(manifold, search.overlap);
  } else {
    take_back(manifold, way, Vector3::Zero(), search.share, manifold.deepest.gap);
  }
  manifold.reach = search.reach_along(there.normal, way);
  limit_rotation(search.now, {search.now.shape, search.now.pose, search.surface}, search.time, search.share, manifold);
  const auto same = std::find_if(found_.begin(), found_.end(), [&](const MeshManifold& other) {
    return (other.manifold.deepest.normal - there.normal).norm() < kSameNormal + 4 * search.rounding / search.size &&
           other.manifold.deepest.gap < manifold.deepest.gap + kSameGap * search.near + 4 * search.rounding;
  });
  if (same == found_.end()) found_.push_back({manifold, triangle});
}

}  // namespace supernormal
