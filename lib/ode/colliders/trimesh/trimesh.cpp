// Our bodies and dTriMesh. The space behind the triangles is solid.
#include <cmath>
#include <span>
#include <stdexcept>
#include <vector>

#include "base/thread_kept.hpp"
#include "base/usable_pose.hpp"
#include "ode/colliders/collider.hpp"
#include "ode/colliders/contact.hpp"
#include "ode/colliders/impact.hpp"
#include "ode/colliders/trimesh/mesh_candidates.hpp"
#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "ode/geom/look_ahead.hpp"
#include "ode/runtime/statistics.hpp"
#include "ode/support/last_error.hpp"
#include "supernormal/contact/body_box.hpp"
#include "supernormal/contact/mesh_contacts.hpp"
#include "supernormal/contact/mesh_contacts_ahead.hpp"
#include "supernormal/impact/mesh_time_of_impact.hpp"

namespace supernormal::ode {
namespace {

// Relative margin of the box around a body's path, so that rounding loses no triangle that touches it.
constexpr double kPathMargin = 1e-6;

/// Objects of this thread; kept to reuse their memory.
struct TrimeshScratch {
  MeshCandidates candidates;
  MeshContacts contacts;
  MeshContactsAhead contacts_ahead;
  std::vector<LocatedManifold> manifolds;
};

TrimeshScratch& trimesh_scratch() {
  thread_local ThreadKept<TrimeshScratch> kept;
  return *kept;
}

/// One of our bodies and a mesh.
struct Visit {
  dGeomID geom;
  dGeomID mesh;
  const Body& body;
  Pose pose;
  BodyBox box;

  Visit(dGeomID ours, dGeomID collider)
      : geom(ours), mesh(collider), body(require_body(ours)), pose(pose_of(ours)), box(BodyBox::of(body.shape())) {}

  // ODE aborts on a box that is not finite.
  bool is_usable() const {
    const Pose frame{to_vector(dGeomGetPosition(mesh)), to_rotation(dGeomGetRotation(mesh))};
    return supernormal::is_usable(pose) && supernormal::is_usable(frame) && box.centre.allFinite() &&
           box.half_lengths.allFinite() && (box.half_lengths.array() > 0).all();
  }

  /// The triangles within `distance` (m) of the body.
  std::span<const MeshTriangle> triangles_within(double distance, bool is_collision = false) const {
    return trimesh_scratch().candidates.find(mesh, geom, box.widened(distance), pose, is_collision);
  }
};

std::span<const MeshContact> find_contacts(const Visit& visit, std::span<const MeshTriangle> triangles) {
  const std::span<const MeshContact> found =
      trimesh_scratch().contacts.find(visit.body.shape(), visit.pose, triangles, visit.body.settings());
  count_mesh_query(found.empty() ? nullptr : &found.front().proximity, trimesh_scratch().contacts.evaluations());
  return found;
}

/// Appends the contacts ahead to trimesh_scratch().manifolds.
void look_ahead(const Visit& visit) {
  const double time = visit.body.look_ahead();
  const BodyAhead body{visit.body.shape(), visit.pose,
                       motion_ahead_of(visit.geom, visit.pose.position, visit.body.shape().bounding_radius(), time)};
  const MotionAhead surface = motion_ahead_of(visit.mesh, visit.pose.position, visit.body.shape().bounding_radius(), time);
  const MeshContactsAhead::Reach reach = MeshContactsAhead::reach_of(body, surface, time);
  BodyBox box = visit.box.widened(reach.margin);
  box.centre += visit.pose.rotation.transpose() * reach.middle;
  const std::span<const MeshTriangle> triangles = trimesh_scratch().candidates.find(visit.mesh, visit.geom, box, visit.pose, true);
  MeshContactsAhead& ahead = trimesh_scratch().contacts_ahead;
  const std::span<const MeshManifold> found = ahead.find(body, surface, time, triangles, visit.body.settings());
  count_mesh_query(found.empty() ? nullptr : &found.front().manifold.deepest, ahead.evaluations());
  for (const MeshManifold& contact : found) trimesh_scratch().manifolds.push_back({contact.manifold, contact.triangle});
}

/// Appends the contacts of the overlap to trimesh_scratch().manifolds; with all manifold points if max_contacts > 1.
void look_at_overlap(const Visit& visit, int max_contacts) {
  const std::span<const MeshContact> found = find_contacts(visit, visit.triangles_within(0, true));
  std::vector<LocatedManifold>& manifolds = trimesh_scratch().manifolds;
  std::span<const MeshTriangle> near;
  double margin = -1;  // the last search covered this margin
  for (const MeshContact& contact : found) {
    manifolds.push_back({contact.proximity, contact.triangle});
    if (max_contacts < 2) continue;
    ContactManifold& manifold = manifolds.back().manifold;
    manifold = find_plane_contact_manifold(visit.body.shape(), visit.pose, contact.proximity);
    if (manifold.corner_count == 0) continue;
    if (manifold.margin > margin) {
      margin = manifold.margin;
      near = visit.triangles_within(margin);
    }
    draw_in_corners(manifold, near);
  }
}

/// Distances from the centre of the body to the nearest and farthest point of the mesh's box.
struct Range {
  double least = 0;
  double greatest = 0;

  explicit Range(const Visit& visit) {
    dReal aabb[6];
    dGeomGetAABB(visit.mesh, aabb);
    const Vector3 centre = visit.pose.position + visit.pose.rotation * visit.box.centre;
    Vector3 nearest;
    Vector3 farthest;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = double{aabb[2 * axis]} - centre[axis];
      const double high = double{aabb[2 * axis + 1]} - centre[axis];
      nearest[axis] = std::fmax(0.0, std::fmax(low, -high));
      farthest[axis] = std::fmax(std::abs(low), std::abs(high));
    }
    least = nearest.norm();
    greatest = farthest.norm();
  }
};

// Widens the box until it contains a triangle. Then searches again within the distance of that triangle, because a nearer one may
// be outside the first box.
MeshContact find_nearest(const Visit& visit) {
  const Range range(visit);
  const auto nearest_within = [&](double distance) {
    return find_nearest_triangle(visit.body.shape(), visit.pose, visit.triangles_within(distance), visit.body.settings());
  };
  const double size = visit.box.half_lengths.norm();
  double distance = std::fmax(range.least - size, 0.0) + size;
  MeshContact nearest = nearest_within(distance);
  while (nearest.proximity.status == Status::InvalidInput && distance < range.greatest) {
    distance *= 2;
    nearest = nearest_within(distance);
  }
  if (!(nearest.proximity.gap > distance)) return nearest;
  const int evaluations = nearest.proximity.evaluations;
  nearest = nearest_within(nearest.proximity.gap);
  nearest.proximity.evaluations += evaluations;
  return nearest;
}

}  // namespace

// Returns the deepest contact, as dCollide does. Without a contact it returns the distance to the nearest triangle from either
// side. This distance is negative only for a body that touches the mesh from behind at the border of a sheet, which makes no
// contact.
ContactManifold query_trimesh(dGeomID ours, dGeomID collider, QueryKind /*kind*/) {
  const Visit visit(ours, collider);
  if (!visit.is_usable()) return {};
  const std::span<const MeshContact> contacts = find_contacts(visit, visit.triangles_within(0));
  if (!contacts.empty()) return contacts.front().proximity;
  const MeshContact nearest = find_nearest(visit);
  if (nearest.proximity.status == Status::InvalidInput) throw std::invalid_argument("the dTriMesh has no triangles");
  count_query(nearest.proximity, false);
  return nearest.proximity;
}

// The triangles near a piece of the path are searched in a box with the orientation of the body at the start of the piece.
Impact find_trimesh_impact(dGeomID ours, dGeomID collider, double horizon) {
  Visit visit(ours, collider);
  if (!visit.is_usable()) return {};
  const Pose frame = pose_of(collider);
  const Motion body = motion_of(ours, visit.pose);
  const Path path(body, motion_of(collider, frame), (visit.box.centre - body.centre).norm() + visit.box.half_lengths.norm(),
                  horizon);
  return path.first([&](const Motion& here, const Motion& mesh, double duration) {
    // ODE keeps the mesh at its present pose. Move the body to where it is relative to this pose.
    const Matrix3 back = frame.rotation * mesh.pose.rotation.transpose();
    visit.pose = {frame.position + back * (here.pose.position - mesh.pose.position), back * here.pose.rotation};
    Motion world = mesh;
    world.pose = {mesh.pose.position - back.transpose() * frame.position, back.transpose()};
    world.centre = frame.rotation * mesh.centre + frame.position;
    const std::span<const MeshTriangle> triangles =
        visit.triangles_within(path.travel() + kPathMargin * visit.box.half_lengths.norm());
    return find_mesh_time_of_impact(visit.body.shape(), here, triangles, world, duration, visit.body.settings()).impact;
  });
}

int collide_with_trimesh(dGeomID ours, dGeomID collider, int flags, dContactGeom* contacts, int skip) {
  return guarded("dCollide", 0, [&] {
    const Visit visit(ours, collider);
    if (!visit.is_usable()) refuse_pair(ours, collider);
    const ContactArray out{ours, collider, flags, contacts, skip};
    trimesh_scratch().manifolds.clear();
    if (visit.body.look_ahead() > 0) {
      look_ahead(visit);
    } else {
      look_at_overlap(visit, out.max_contacts());
    }
    return write_contacts(trimesh_scratch().manifolds, out);
  });
}

}  // namespace supernormal::ode
