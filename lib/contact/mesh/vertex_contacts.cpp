// Contacts at the vertices of a surface: maxima of the gap over the normal cone between the normals of the faces.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/mesh/mesh_contact_search.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/raycast/ray.hpp"
#include "supernormal/shapes/polytope.hpp"

namespace supernormal {
namespace {

// A normal is known to the square root of its gap's tolerance. Within this angle, rad, it may belong to an edge or a face.
constexpr double kNearEdgeNormal = 1e-5;

double angle_at(const Face& face, int k) {
  const Vector3 edge1 = face.vertices[at((k + 1) % 3)] - face.vertices[at(k)];
  const Vector3 edge2 = face.vertices[at((k + 2) % 3)] - face.vertices[at(k)];
  return std::atan2(edge1.cross(edge2).norm(), edge1.dot(edge2));
}

}  // namespace

// Solves the hull of the triangles at the vertex. The gap of the vertex alone may be larger at normals outside the normal cone.
void MeshContactSearch::find_on_vertex(SupportProbe& probe, int f, int k, const Vector3& start) {
  const int corner = surface_.faces()[at(f)].corner[at(k)];
  if (settled_[at(corner)] != 0) return;
  hull_.clear();
  for (const Face& face : surface_.faces()) {
    if (std::find(face.corner.begin(), face.corner.end(), corner) == face.corner.end()) continue;
    hull_.insert(hull_.end(), face.vertices.begin(), face.vertices.end());
  }
  const Proximity found = solve_for_hull(probe, surface_.faces()[at(f)].vertices[at(k)], &start);
  if (found.status == Status::InvalidInput) return;
  const bool is_apart = found.status == Status::Apart || found.gap > 0;
  if (!is_apart && is_normal_of_edge_at(corner, -found.normal)) {
    near_edges_.push_back({f, k, found});
    return;
  }
  // If the normal is outside the normal cone, another edge may lead to another maximum.
  settled_[at(corner)] = is_apart || add_at_vertex(probe, f, k, found) ? 1 : 0;
}

// The normal does not decide between a vertex and its edges: a body with a side nearly parallel to the edge has nearly the same
// normal at both. The contact belongs to the vertex if the edge has none. The hull also bridges a valley between two edges at the
// vertex, where the surface has no face. Such a contact is beside the surface.
void MeshContactSearch::add_near_edges(SupportProbe& probe) {
  for (const VertexContact& contact : near_edges_) {
    const int corner = surface_.faces()[at(contact.face)].corner[at(contact.k)];
    if (settled_[at(corner)] != 0 || is_found_beside(corner, -contact.found.normal, contact.found.gap)) continue;
    if (!surface_.is_on_face_at(corner, contact.found.contact + 0.5 * contact.found.gap * contact.found.normal)) continue;
    settled_[at(corner)] = add_at_vertex(probe, contact.face, contact.k, contact.found) ? 1 : 0;
  }
  near_edges_.clear();
}

// Whether a face or an edge at the vertex `corner`, with this normal in its normal cone, has a contact that is no deeper.
bool MeshContactSearch::is_found_beside(int corner, const Vector3& normal, double gap) const {
  const std::vector<SurfaceContact>& contacts = found_.contacts();
  return std::any_of(contacts.begin(), contacts.end(), [&](const SurfaceContact& contact) {
    if (contact.gap < gap - touch()) return false;
    const Face& face = surface_.faces()[at(contact.face)];
    if (contact.crease < 0) return is_corner_of_patch(corner, face.patch) && (contact.normal - normal).norm() <= kNearEdgeNormal;
    const int side = contact.crease - surface_.corner_count() - 3 * contact.face;
    if (side < 0) return false;  // a contact of a vertex
    const int next = next_corner(side);
    const Vector3 edge = face.vertices[at(next)] - face.vertices[at(side)];
    return (face.corner[at(side)] == corner || face.corner[at(next)] == corner) &&
           std::abs(normal.dot(edge)) <= kNearEdgeNormal * edge.norm();
  });
}

bool MeshContactSearch::is_corner_of_patch(int corner, int patch) const {
  for (int f = surface_.patches()[at(patch)].first_face; f >= 0; f = surface_.faces()[at(f)].next_in_patch) {
    const std::array<int, 3>& corners = surface_.faces()[at(f)].corner;
    if (std::find(corners.begin(), corners.end(), corner) != corners.end()) return true;
  }
  return false;
}

bool MeshContactSearch::is_normal_of_edge_at(int corner, const Vector3& normal) const {
  return std::any_of(surface_.faces().begin(), surface_.faces().end(), [&](const Face& face) {
    const auto* const found = std::find(face.corner.begin(), face.corner.end(), corner);
    if (found == face.corner.end()) return false;
    const int k = static_cast<int>(found - face.corner.begin());
    return std::any_of(face.vertices.begin(), face.vertices.end(), [&](const Vector3& other) {
      const Vector3 edge = other - face.vertices[at(k)];
      return normal.dot(edge) > -kNearEdgeNormal * edge.norm();
    });
  });
}

Proximity MeshContactSearch::solve_for_hull(SupportProbe& probe, const Vector3& origin, const Vector3* start) {
  for (Vector3& point : hull_) point -= origin;
  Vector3 first_normal;
  if (start != nullptr) first_normal = -(probe.rotation().transpose() * *start);
  const Proximity found = find_proximity(probe.shape(), {Vector3::Zero(), probe.rotation()}, Polytope(hull_),
                                         {origin, Matrix3::Identity()}, settings_, start != nullptr ? &first_normal : nullptr);
  probe.count(found.evaluations);
  return found;
}

// The body's point, or on a flat side the point over the vertex. In a deep overlap the contact of the hull is moved into it, away
// from the middle between the tangent planes, because the hull is thinner than the solid.
Vector3 MeshContactSearch::place_at_vertex(SupportProbe& probe, const Proximity& found) const {
  const Vector3 on_plane = found.contact - 0.5 * found.gap * found.normal;
  const auto below_plane = [&](const Vector3& point) { return found.normal.dot(found.point1 - point); };
  if (std::abs(below_plane(on_plane)) <= touch()) return on_plane;
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  const Pose pose{Vector3::Zero(), probe.rotation()};
  const RayHit side = find_ray_hit(probe.shape(), pose, found.contact, found.normal, kEndless, settings_);
  probe.count(side.evaluations);
  return side.hit && below_plane(side.point) <= touch() ? side.point : found.point1;
}

// Returns false if the normal is outside the normal cone of the surface, or if this cannot be decided.
bool MeshContactSearch::add_at_vertex(SupportProbe& probe, int f, int k, const Proximity& found) {
  const Face& face = surface_.faces()[at(f)];
  const Vector3& vertex = face.vertices[at(k)];
  if (!has_complete_neighbourhood(probe, vertex)) return false;
  SurfaceContact contact = contact_at(f, -found.normal, found.gap, found.point1);
  contact.surface_point = contact.feature_point = vertex;
  contact.place = place_at_vertex(probe, found);
  contact.crease = face.corner[at(k)];
  contact.error = found.error;
  contact.evaluations = found.evaluations;
  contact.status = found.status;
  if (surface_.violates_normal_cone(contact.normal, vertex, vertex) || !is_outside_at(face.corner[at(k)], contact.normal))
    return false;
  if (!touches_surface(probe, contact)) return true;
  level_at_vertex(probe, contact);
  found_.add(contact);
  return true;
}

// The angle-weighted mean normal of a vertex separates outside from inside (Baerentzen, Aanaes: Signed distance computation using
// the angle weighted pseudonormal, IEEE TVCG 11, 2005).
bool MeshContactSearch::is_outside_at(int corner, const Vector3& normal) const {
  Vector3 mean = Vector3::Zero();
  for (const Face& face : surface_.faces()) {
    for (int k = 0; k < 3; ++k) {
      if (face.corner[at(k)] == corner) mean += angle_at(face, k) * face.normal;
    }
  }
  return normal.dot(mean) >= -1e-12;
}

}  // namespace supernormal
