// Our bodies and dHeightfield: the solid below its triangles.
#include <span>
#include <vector>

#include "base/thread_kept.hpp"
#include "base/usable_pose.hpp"
#include "ode/colliders/collider.hpp"
#include "ode/colliders/contact.hpp"
#include "ode/colliders/heightfield/heightfield_patch.hpp"
#include "ode/colliders/impact.hpp"
#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "ode/geom/look_ahead.hpp"
#include "ode/runtime/statistics.hpp"
#include "ode/support/last_error.hpp"
#include "supernormal/contact/body_box.hpp"
#include "supernormal/contact/mesh_contacts.hpp"
#include "supernormal/contact/mesh_contacts_ahead.hpp"
#include "supernormal/impact/mesh_time_of_impact.hpp"
#include "supernormal/proximity/plane.hpp"

namespace supernormal::ode {
namespace {

// Relative margin of the body's region, so that rounding loses no triangle that touches it. Far from the middle of the field
// rounding exceeds it; a triangle lost there is touched by no more than this rounding.
constexpr double kMargin = 1e-12;

// A heightfield that is not placeable has no pose: its frame is the world frame.
Pose pose_of_heightfield(dGeomID heightfield) {
  Pose pose;
  dVector3 column;
  dGeomGetRelPointPos(heightfield, 0, 0, 0, column);
  pose.position = to_vector(column);
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 unit = Vector3::Unit(axis);
    dGeomVectorToWorld(heightfield, to_real(unit.x()), to_real(unit.y()), to_real(unit.z()), column);
    pose.rotation.col(axis) = to_vector(column);
  }
  pose.rotation = orthonormal(pose.rotation, heightfield);
  return pose;
}

/// The body in the frame of a heightfield, and its bounding box.
struct Visitor {
  const Shape& shape;
  Pose pose;
  Settings settings;
  BodyBox box;
  Vector3 centre;   // centre of the box, m
  Vector3 extents;  // half-extents of the box along the axes of the heightfield, m

  Visitor(const Body& body, const Pose& world, const Pose& frame)
      : shape(body.shape()), settings(body.settings()), box(BodyBox::of(shape)) {
    pose.rotation = frame.rotation.transpose() * world.rotation;
    pose.position = frame.rotation.transpose() * (world.position - frame.position);
    box.half_lengths *= 1 + kMargin;
    centre = pose.position + pose.rotation * box.centre;
    extents = pose.rotation.cwiseAbs() * box.half_lengths;
  }

  /// A user-defined body may return anything.
  bool is_usable() const {
    return supernormal::is_usable(pose) && centre.allFinite() && extents.allFinite() && (box.half_lengths.array() > 0).all();
  }
  double size() const { return extents.maxCoeff(); }
  Region region() const {
    return {centre.x() - extents.x(), centre.x() + extents.x(), centre.z() - extents.z(), centre.z() + extents.z()};
  }
};

/// Objects of this thread; kept to reuse their memory.
struct HeightfieldScratch {
  HeightfieldPatch patch;
  MeshContacts mesh;
  MeshContactsAhead mesh_ahead;
  std::vector<Proximity> contacts;
  std::vector<LocatedManifold> manifolds;
};

HeightfieldScratch& heightfield_scratch() {
  thread_local ThreadKept<HeightfieldScratch> kept;
  return *kept;
}

Proximity to_world(Proximity local, const Pose& frame) {
  local.normal = frame.rotation * local.normal;
  for (Vector3* const point : {&local.point1, &local.point2, &local.contact}) *point = frame.rotation * *point + frame.position;
  return local;
}

ContactManifold to_world(ContactManifold local, const Pose& frame) {
  local.deepest = to_world(local.deepest, frame);
  for (int k = 0; k < local.corner_count; ++k) {
    Vector3& point = local.corners[static_cast<std::size_t>(k)].point;
    point = frame.rotation * point + frame.position;
  }
  if (local.placed_on) {
    auto& [shape, pose, outwards] = *local.placed_on;
    pose = {frame.rotation * pose.position + frame.position, frame.rotation * pose.rotation};
    outwards = frame.rotation * outwards;
  }
  return local;
}

// If no triangle touches the body, the body is above the surface or below. From below it is pushed out along the normal of the
// plane above its middle.
bool find_upward_contact(HeightfieldProbe& probe, const Visitor& visitor, Proximity& upward) {
  Facet facet;
  if (!probe.find_facet(visitor.centre.x(), visitor.centre.z(), visitor.size(), facet)) return false;
  if (visitor.centre.y() > facet.height) return false;
  const Vector3 on_surface{facet.x, facet.height, facet.z};
  upward = find_plane_proximity(visitor.shape, visitor.pose, facet.normal, facet.normal.dot(on_surface));
  return upward.gap <= 0;
}

bool is_above_all(const HeightfieldProbe& probe, const Visitor& visitor) {
  return visitor.centre.y() - visitor.extents.y() > probe.max_height();
}

/// The contacts, in the frame of the heightfield.
struct Found {
  std::span<const Proximity> contacts;  // deepest first
  std::span<const MeshTriangle> triangles;
};

Found find_contacts(HeightfieldProbe& probe, const Visitor& visitor) {
  HeightfieldScratch& kept = heightfield_scratch();
  kept.contacts.clear();
  const std::span<const MeshTriangle> triangles = kept.patch.read(probe, visitor.region());
  for (const MeshContact& contact : kept.mesh.find(visitor.shape, visitor.pose, triangles, visitor.settings)) {
    kept.contacts.push_back(contact.proximity);
  }
  Proximity upward;
  if (kept.contacts.empty() && find_upward_contact(probe, visitor, upward)) kept.contacts.push_back(upward);
  count_mesh_query(kept.contacts.empty() ? nullptr : &kept.contacts.front(), kept.mesh.evaluations());
  return {kept.contacts, triangles};
}

MotionAhead in_frame(MotionAhead world, const Pose& frame) {
  const Matrix3 to_frame = frame.rotation.transpose();
  world.velocity = to_frame * world.velocity;
  world.centre = to_frame * (world.centre - frame.position);
  world.turning = to_frame * world.turning * frame.rotation;
  world.angular_velocity = to_frame * world.angular_velocity;
  world.acceleration = to_frame * world.acceleration;
  world.angular_acceleration = to_frame * world.angular_acceleration;
  return world;
}

/// Appends the contacts ahead of the body to heightfield_scratch().manifolds, in the world frame.
void look_ahead(HeightfieldProbe& probe, const Visitor& visitor, const Pose& frame, dGeomID ours, dGeomID heightfield) {
  const Body& body = require_body(ours);
  const Vector3 origin = to_vector(dGeomGetPosition(ours));
  const BodyAhead moving{visitor.shape, visitor.pose,
                         in_frame(motion_ahead_of(ours, origin, body.shape().bounding_radius(), body.look_ahead()), frame)};
  const MotionAhead surface =
      in_frame(motion_ahead_of(heightfield, origin, body.shape().bounding_radius(), body.look_ahead()), frame);
  const MeshContactsAhead::Reach reach = MeshContactsAhead::reach_of(moving, surface, body.look_ahead());
  Visitor all = visitor;
  all.centre += reach.middle;
  all.extents.array() += reach.margin;
  if (is_above_all(probe, all)) return;
  HeightfieldScratch& kept = heightfield_scratch();
  const std::span<const MeshTriangle> triangles = kept.patch.read(probe, all.region());
  const std::span<const MeshManifold> found = kept.mesh_ahead.find(moving, surface, body.look_ahead(), triangles, visitor.settings);
  count_mesh_query(found.empty() ? nullptr : &found.front().manifold.deepest, kept.mesh_ahead.evaluations());
  for (const MeshManifold& contact : found) kept.manifolds.push_back({to_world(contact.manifold, frame), -1});
  // A body wholly below the surface has no contact ahead, but must be pushed up.
  Proximity upward;
  if (found.empty() && !is_above_all(probe, visitor) && find_upward_contact(probe, visitor, upward)) {
    kept.manifolds.push_back({to_world(upward, frame), -1});
  }
}

/// Appends the contacts of the overlap to heightfield_scratch().manifolds, in the world frame.
void look_at_overlap(HeightfieldProbe& probe, const Visitor& visitor, const Pose& frame, int max_contacts) {
  const Found found = find_contacts(probe, visitor);
  for (const Proximity& contact : found.contacts) {
    ContactManifold manifold = contact;
    if (max_contacts > 1) {
      manifold = find_plane_contact_manifold(visitor.shape, visitor.pose, contact);
      draw_in_corners(manifold, found.triangles);
    }
    heightfield_scratch().manifolds.push_back({to_world(manifold, frame), -1});
  }
}

// The nearest triangle below the body bounds the distance of the nearest triangle of all. The latter is therefore below the body
// widened by this bound.
Proximity find_nearest(HeightfieldProbe& probe, const Visitor& visitor) {
  const Region region = visitor.region();
  Settings settings = visitor.settings;
  settings.stop_when_apart = false;
  HeightfieldScratch& kept = heightfield_scratch();
  const auto nearest_in = [&](const Region& searched) {
    return find_nearest_triangle(visitor.shape, visitor.pose, kept.patch.read(probe, searched), settings).proximity;
  };
  const Proximity below = nearest_in(region);
  if (below.status == Status::InvalidInput || below.gap <= 0) return below;
  Proximity nearest = nearest_in(region.widened(below.gap));
  nearest.evaluations += below.evaluations;
  return nearest;
}

}  // namespace

ContactManifold query_heightfield(dGeomID ours, dGeomID collider, QueryKind /*kind*/) {
  const Pose frame = pose_of_heightfield(collider);
  const Visitor visitor(require_body(ours), pose_of(ours), frame);
  if (!visitor.is_usable()) return {};
  HeightfieldProbe& probe = HeightfieldProbe::looking_at(collider);
  if (!is_above_all(probe, visitor)) {
    const std::span<const Proximity> contacts = find_contacts(probe, visitor).contacts;
    if (!contacts.empty()) return to_world(contacts.front(), frame);
  }
  return to_world(find_nearest(probe, visitor), frame);
}

Impact find_heightfield_impact(dGeomID ours, dGeomID collider, double horizon) {
  const Body& body = require_body(ours);
  const Pose frame = pose_of_heightfield(collider);
  const Motion start = motion_of(ours, pose_of(ours));
  if (!Visitor(body, start.pose, frame).is_usable()) return {};
  const BodyBox box = BodyBox::of(body.shape());
  const Path path(start, motion_of(collider, frame), (box.centre - start.centre).norm() + box.half_lengths.norm(), horizon);
  HeightfieldProbe& probe = HeightfieldProbe::looking_at(collider);
  return path.first([&](const Motion& here, const Motion& field, double duration) {
    const Visitor visitor(body, here.pose, field.pose);
    if (!visitor.is_usable()) return Impact{};
    const Region region = visitor.region().widened(path.travel() + kMargin * visitor.size());
    const std::span<const MeshTriangle> triangles = heightfield_scratch().patch.read(probe, region);
    return find_mesh_time_of_impact(body.shape(), here, triangles, field, duration, body.settings()).impact;
  });
}

int collide_with_heightfield(dGeomID ours, dGeomID collider, int flags, dContactGeom* contacts, int skip) {
  return guarded("dCollide", 0, [&] {
    const Pose frame = pose_of_heightfield(collider);
    const Visitor visitor(require_body(ours), pose_of(ours), frame);
    HeightfieldProbe& probe = HeightfieldProbe::looking_at(collider);
    if (!visitor.is_usable()) refuse_pair(ours, collider);
    const ContactArray out{ours, collider, flags, contacts, skip};
    std::vector<LocatedManifold>& manifolds = heightfield_scratch().manifolds;
    manifolds.clear();
    if (require_body(ours).look_ahead() > 0) {
      look_ahead(probe, visitor, frame, ours, collider);
    } else if (!is_above_all(probe, visitor)) {
      look_at_overlap(probe, visitor, frame, out.max_contacts());
    }
    return write_contacts(manifolds, out);
  });
}

}  // namespace supernormal::ode
