#include "ode/colliders/convex/convex_vertices.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "base/thread_kept.hpp"
#include "ode/colliders/collider.hpp"
#include "ode/colliders/solve_pair.hpp"
#include "ode/geom/bounding_box.hpp"
#include "ode/geom/convert.hpp"
#include "ode/runtime/warm_start.hpp"
#include "ode/support/private_geom.hpp"
#include "supernormal/shapes/polytope.hpp"

namespace supernormal::ode {
namespace {

constexpr std::size_t kFirstContacts = 256;
constexpr std::size_t kMaxContacts = 0xffff;  // the largest max_contacts that dCollide accepts

using Bounds = Eigen::AlignedBox3d;

Bounds aabb_of(dGeomID geom) {
  dReal aabb[6];
  dGeomGetAABB(geom, aabb);
  return {Vector3(aabb[0], aabb[2], aabb[4]), Vector3(aabb[1], aabb[3], aabb[5])};
}

Bounds box_of(std::span<const Vector3> points) {
  Bounds box;
  for (const Vector3& point : points) box.extend(point);
  return box;
}

bool is_finite(const Bounds& box) { return box.min().allFinite() && box.max().allFinite(); }

/// The vertices of this thread; kept to reuse their memory.
ConvexVertices& kept_vertices() {
  thread_local ThreadKept<ConvexVertices> kept;
  return *kept;
}

}  // namespace

ConvexVertices::ConvexVertices() : plane_(dCreatePlane(nullptr, 1, 0, 0, 0)), contacts_(kFirstContacts) {}

ConvexVertices::~ConvexVertices() { destroy_private_geom(plane_); }

// The plane, and with it the order of the vertices, depends on the bounding box. Inside a dGeomTransform this box may belong to an
// earlier pose. The first list, if it succeeds, then serves to find the right box.
bool ConvexVertices::read(dGeomID convex) {
  const Pose geom_pose = pose_of(convex);
  if (!geom_pose.position.allFinite() || !geom_pose.rotation.allFinite()) return false;
  Bounds box = aabb_of(convex);
  if (!list(convex, box) && dGeomGetSpace(convex) == nullptr) {  // not in a space, which may be locked: ODE would abort
    set_moved(convex);
    box = aabb_of(convex);
    list(convex, box);
  }
  if (!is_finite(box)) return false;
  if (points_.empty()) {
    throw std::invalid_argument("the dConvex has no vertices where its bounding box is; after dGeomSetConvex call dGeomMoved");
  }
  const Bounds actual = box_of(points_);
  if (!is_finite(actual)) return false;
  if (actual.min() != box.min() || actual.max() != box.max()) list(convex, actual);
  move_to_middle(geom_pose);
  return std::all_of(points_.begin(), points_.end(), [](const Vector3& point) { return point.allFinite(); });
}

// Lists the vertices in the world frame, with a plane across the longest side of their bounding box. Both half-spaces then contain
// vertices, or the plane does. Returns false and no points if a half-space is empty, because ODE then makes no contacts.
bool ConvexVertices::list(dGeomID convex, const Eigen::AlignedBox3d& box) {
  points_.clear();
  int axis = 0;
  const double length = box.sizes().maxCoeff(&axis);
  const double offset = box.min()[axis] + 0.5 * length;
  if (list_below(convex, axis, 1, offset, true) && list_below(convex, axis, -1, -offset, false)) return true;
  points_.clear();
  return false;
}

// Lists the vertices v with side * v[axis] <= offset, or < without `with_plane`.
bool ConvexVertices::list_below(dGeomID convex, int axis, double side, double offset, bool with_plane) {
  const Vector3 normal = side * Vector3::Unit(axis);
  dGeomPlaneSetParams(plane_, to_real(normal.x()), to_real(normal.y()), to_real(normal.z()), to_real(offset));
  std::size_t count = 0;
  while (true) {
    count = static_cast<std::size_t>(
        dCollide(convex, plane_, static_cast<int>(contacts_.size()), contacts_.data(), sizeof(dContactGeom)));
    if (count < contacts_.size()) break;
    if (count == kMaxContacts) throw std::invalid_argument("the dConvex has more vertices than can be read: 65534 on each side");
    contacts_.resize(std::min(4 * contacts_.size(), kMaxContacts));
  }
  for (std::size_t k = 0; k < count; ++k) {
    if (with_plane || contacts_[k].depth != 0) points_.push_back(to_vector(contacts_[k].pos));
  }
  return count > 0;
}

// Coordinates are counted in units of the size and rounded down, so the rounding of a pose hardly ever changes a count. The shift
// keeps round numbers far from the steps.
double ConvexVertices::fingerprint() const {
  constexpr double kUnits = 1000;
  constexpr double kOffRoundNumbers = 0.382;
  double size = 0;
  for (const Vector3& point : points_) size = std::max(size, point.cwiseAbs().maxCoeff());
  if (!(size > 0)) return 0;
  const double magnitude = std::floor(4 * std::log2(size) + kOffRoundNumbers);
  double sum = 0;
  for (const Vector3& point : points_) {
    const Vector3 units = (kUnits / size * point.array() + kOffRoundNumbers).floor();
    sum += collider_kind(dConvexClass, {units.x(), units.y(), units.z(), magnitude});
  }
  return sum;
}

void ConvexVertices::move_to_middle(const Pose& geom_pose) {
  for (Vector3& point : points_) point = geom_pose.rotation.transpose() * (point - geom_pose.position);
  const Vector3 middle = box_of(points_).center();
  for (Vector3& point : points_) point -= middle;
  pose_ = {geom_pose.position + geom_pose.rotation * middle, geom_pose.rotation};
}

// Our bodies and dConvex: the convex hull of its vertices. Its polygons and planes are ignored.
ContactManifold query_convex(dGeomID ours, dGeomID collider, QueryKind kind) {
  ConvexVertices& vertices = kept_vertices();
  if (!vertices.read(collider)) return {};
  const Polytope hull(vertices.points());
  const ColliderShape shape{collider, hull, {vertices.pose(), false}, collider_kind(dConvexClass, {vertices.fingerprint()})};
  return solve_pair(ours, shape, kind);
}

}  // namespace supernormal::ode
