// Contacts at the open border of a sheet. A floor often consists of tiles, each its own geom, and a query sees only one of them. A
// border may therefore be a seam of the floor. So a body slightly below the face gets the normal of the face at the border.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "contact/mesh/mesh_contact_search.hpp"
#include "supernormal/raycast/ray.hpp"

namespace supernormal {
namespace {

// Depth of a body below the plane of a face, relative to its extent along the normal. Up to kStands the body stands on the sheet,
// as it would on the next tile. From kIsBeside on it is beside the border and gets the minimum translation.
constexpr double kStands = 0.1;
constexpr double kIsBeside = 0.2;

// The unit vector nearest to `normal` on the arc between two normals.
Vector3 nearest_between(const Vector3& normal1, const Vector3& normal2, const Vector3& normal) {
  const Vector3 axis = normal1.cross(normal2);
  const Vector3 in_plane = normal - axis.dot(normal) / std::max(axis.squaredNorm(), 1e-300) * axis;
  if (axis.dot(normal1.cross(in_plane)) > 0 && axis.dot(in_plane.cross(normal2)) > 0) return in_plane.normalized();
  return normal1.dot(normal) > normal2.dot(normal) ? normal1 : normal2;
}

// Rotates the normal of the minimum translation towards the normal of the face.
Vector3 turned(const Vector3& normal, const Vector3& face_normal, double weight) {
  return weight < 1 ? ((1 - weight) * normal + weight * face_normal).normalized() : face_normal;
}

// The lowest point of the body over the edge, along the first normal of the arc. `low` is beyond the edge, at the start of the arc.
// Each step takes the normal for which both points are equally deep, until the body has no point beyond their chord. Empty if the
// whole body is beyond the edge.
std::optional<Vector3> lowest_over_edge(SupportProbe& probe, const Arc& arc, ArcSample low, double tolerance, int max_evaluations) {
  const auto beyond = [&](const ArcSample& sample) { return arc.towards.dot(sample.point - arc.edge_point); };
  ArcSample high = arc.sample(arc.end, probe);
  if (beyond(high) > 0) return std::nullopt;
  const int last_evaluation = probe.evaluations() + max_evaluations;
  while (beyond(high) < 0 && probe.evaluations() < last_evaluation) {
    const Vector3 chord = low.point - high.point;
    const double angle = std::atan2(-arc.from.dot(chord), arc.towards.dot(chord));
    if (!(low.angle < angle && angle < high.angle)) break;
    const ArcSample middle = arc.sample(angle, probe);
    if (arc.normal(angle).dot(low.point - middle.point) <= tolerance * std::cos(angle)) break;
    (beyond(middle) > 0 ? low : high) = middle;
  }
  const double width = beyond(low) - beyond(high);
  return low.point + (width > 0 ? beyond(low) / width : 0.0) * (high.point - low.point);
}

}  // namespace

// 1: the body stands on the sheet; 0: it is beside its border.
double MeshContactSearch::stands_on(SupportProbe& probe, const Vector3& face_normal, const Vector3& place) const {
  const double low = face_normal.dot(probe.deepest(face_normal).point) + swept_;
  const double high = face_normal.dot(probe.deepest(-face_normal).point) - swept_;
  const double share = (face_normal.dot(place) - low) / (high - low);
  return std::clamp((kIsBeside - share) / (kIsBeside - kStands), 0.0, 1.0);
}

// Replaces find_on_arc at a border. The contact is at the lowest point of the body over the edge, or at the end of the edge.
void MeshContactSearch::find_on_border(SupportProbe& probe, int f, int side, const Arc& arc, const ArcMaximum& top, double weight) {
  const Face& face = surface_.faces()[at(f)];
  const int first_evaluation = probe.evaluations();
  Arc turned_arc = arc;
  turned_arc.from = turned(top.normal, face.normal, weight);
  turned_arc.towards = (arc.towards - arc.towards.dot(turned_arc.from) * turned_arc.from).normalized();
  SupportProbe body(*body_, probe.rotation());
  const std::optional<Vector3> found =
      lowest_over_edge(body, turned_arc, turned_arc.sample(0, body), arc_tolerance(), settings_.max_evaluations);
  probe.count(body.evaluations());
  if (!found) return;
  const Vector3& lowest = *found;
  const Vector3 edge = face.vertices[at(next_corner(side))] - arc.edge_point;
  const double share = edge.dot(lowest - arc.edge_point) / edge.squaredNorm();
  const double gap = turned_arc.from.dot(lowest - arc.edge_point) - swept_;
  SurfaceContact contact = contact_at(f, turned_arc.from, gap, lowest - swept_ * turned_arc.from);
  contact.surface_point = contact.feature_point = arc.edge_point + share * edge;
  contact.crease = surface_.corner_count() + 3 * f + side;
  contact.error = arc_tolerance();
  if (share < 0 || share > 1) {
    const int end = share < 0 ? side : next_corner(side);
    contact.feature_point = face.vertices[at(end)];
    contact.crease = face.corner[at(end)];
    if (!drop_below(probe, contact)) return;
  }
  contact.separation = top.gap;
  contact.evaluations = probe.evaluations() - first_evaluation;
  const Vector3& place = contact.feature_point;
  if (!(contact.gap <= 0) || !has_complete_neighbourhood(probe, place)) return;
  if (surface_.violates_normal_cone(top.normal, place, place) || surface_.violates_normal_cone(contact.normal, place, place))
    return;
  if (touches_surface(probe, contact)) found_.add(contact);
}

// Sets the gap of the contact to that between its place and the body, along its normal. Returns false if the body is not there, or
// not near.
bool MeshContactSearch::drop_below(SupportProbe& probe, SurfaceContact& contact) const {
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  const Pose pose{Vector3::Zero(), probe.rotation()};
  SupportProbe body(*body_, probe.rotation());
  const double depth = contact.normal.dot(contact.feature_point) - body.deepest(contact.normal).height;
  const RayHit lowest =
      find_ray_hit(*body_, pose, contact.feature_point - depth * contact.normal, contact.normal, kEndless, settings_);
  probe.count(body.evaluations() + lowest.evaluations);
  if (!lowest.hit) return false;
  contact.gap = lowest.distance - depth - swept_;
  contact.body_point = contact.place = lowest.point - swept_ * contact.normal;
  contact.error = lowest.distance_error;
  contact.surface_point = contact.feature_point;
  contact.status = lowest.status;
  return contact.gap <= 0;
}

// Rotates the normal of a contact at a border vertex towards the normals of the faces there. A search along an inner edge led to
// this vertex.
void MeshContactSearch::level_at_vertex(SupportProbe& probe, SurfaceContact& contact) const {
  const Vector3 face_normal = face_normal_at(contact.crease, contact.normal);
  const double weight = face_normal == contact.normal ? 0 : stands_on(probe, face_normal, contact.feature_point);
  if (!(weight > 0)) return;
  SurfaceContact level = contact;
  level.normal = turned(contact.normal, face_normal, weight);
  if (drop_below(probe, level)) contact = level;
}

// The normal of the faces and edges at a vertex that is nearest to `normal`. Returns `normal` itself unless it leans out across a
// border there.
Vector3 MeshContactSearch::face_normal_at(int corner, const Vector3& normal) const {
  bool leans_out = false;
  Vector3 nearest = normal;
  double largest = -2;
  for (const Face& face : surface_.faces()) {
    for (int k = 0; k < 3; ++k) {
      if (face.corner[at(k)] != corner && face.corner[at(next_corner(k))] != corner) continue;
      leans_out = leans_out || (face.convexity[at(k)] == EdgeConvexity::Border && normal.dot(face.outward[at(k)]) > 0);
      const bool is_convex = face.convexity[at(k)] == EdgeConvexity::Convex;
      const Vector3& other = is_convex ? surface_.faces()[at(face.neighbour[at(k)])].normal : face.normal;
      const Vector3 candidate = nearest_between(face.normal, other, normal);
      if (candidate.dot(normal) <= largest) continue;
      largest = candidate.dot(normal);
      nearest = candidate;
    }
  }
  return leans_out ? nearest : normal;
}

}  // namespace supernormal
