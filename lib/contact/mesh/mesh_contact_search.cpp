#include "contact/mesh/mesh_contact_search.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <numbers>

#include "base/usable_pose.hpp"
#include "contact/mesh/arc.hpp"
#include "contact/mesh/mesh_triangle.hpp"
#include "supernormal/shapes/rounded.hpp"

namespace supernormal {
namespace {

// The normal at an edge must be more accurate than the gap. Another step of a superlinear iteration is cheap.
constexpr double kArcTolerance = 1e-2;  // of the tolerance of the gap

// The cosine of an angle below 1e-6 rad is 1 within this error.
constexpr double kAligned = 1e-12;

// The searched box is larger than the body's by this margin, so that rounding loses no triangle that touches it.
constexpr double kBoxMargin = 1e-9;  // of the length unit

}  // namespace

std::span<const MeshContact> MeshContactSearch::find(const Shape& body, const Pose& pose, std::span<const MeshTriangle> triangles,
                                                     const Settings& settings, double near) {
  contacts_.clear();
  continued_.clear();
  evaluations_ = 0;
  if (triangles.empty() || !is_usable(pose)) return contacts_;
  settings_ = settings;
  settings_.solver = Solver::Hybrid;
  settings_.stop_when_apart = true;
  body_ = &body;
  swept_ = near;
  if (near > 0) {
    // The swept body refers to the shape without owning it.
    find_for(Rounded(std::shared_ptr<const Shape>(std::shared_ptr<const Shape>(), &body), near), pose, triangles);
  } else {
    find_for(body, pose, triangles);
  }
  for (const SurfaceContact& found : found_.contacts()) contacts_.push_back(to_world(found));
  return contacts_;
}

void MeshContactSearch::find_for(const Shape& shape, const Pose& pose, std::span<const MeshTriangle> triangles) {
  prepare(shape, pose, triangles);
  SupportProbe probe(shape, pose.rotation);
  look_at_patches(probe);
  for (std::size_t p = 0; p < supports_.size(); ++p) find_on_patch(probe, p);
  for (std::size_t f = 0; f < surface_.faces().size(); ++f) {
    for (int side = 0; side < 3; ++side) find_on_edge(probe, static_cast<int>(f), side);
  }
  add_near_edges(probe);
  for (std::size_t p = 0; p < supports_.size(); ++p) find_beyond_rim(probe, p);
  add_beyond_rim();
  find_other_separations(probe);
  if (found_.contacts().empty()) find_shortest_exit(probe);
  found_.keep_shortest_separations();
  evaluations_ = probe.evaluations();
}

void MeshContactSearch::prepare(const Shape& shape, const Pose& pose, std::span<const MeshTriangle> triangles) {
  origin_ = pose.position;
  box_ = BodyBox::of(shape);
  length_unit_ = box_.half_lengths.minCoeff();
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  const BodyBox searched = box_.widened(kBoxMargin * length_unit_ + 8 * kEpsilon * pose.position.lpNorm<Eigen::Infinity>());
  near_.clear();
  std::copy_if(triangles.begin(), triangles.end(), std::back_inserter(near_),
               [&](const MeshTriangle& triangle) { return searched.touches(pose, triangle.vertices); });
  surface_.build(near_, pose.position, length_unit_);
  supports_.clear();
  near_edges_.clear();
  settled_.assign(at(surface_.corner_count()), 0);
  const Vector3 middle = pose.rotation * box_.centre;
  found_.clear(length_unit_, middle);
  beyond_rim_.clear(length_unit_, middle);
}

void MeshContactSearch::look_at_patches(SupportProbe& probe) {
  for (const CoplanarPatch& patch : surface_.patches()) {
    const DeepestPoint deepest = probe.deepest(patch.normal);
    supports_.push_back({deepest.point, deepest.height - patch.height, false});
  }
}

SurfaceContact MeshContactSearch::contact_at(int face, const Vector3& normal, double gap, const Vector3& body_point) const {
  SurfaceContact contact;
  contact.normal = normal;
  contact.gap = gap;
  contact.separation = gap;
  contact.body_point = body_point;
  contact.place = body_point;
  contact.surface_point = body_point - gap * normal;
  contact.feature_point = contact.surface_point;
  contact.face = face;
  contact.part = surface_.part_of(surface_.faces()[at(face)]);
  return contact;
}

void MeshContactSearch::find_on_patch(SupportProbe& probe, std::size_t patch) {
  PatchSupport& support = supports_[patch];
  if (!(support.gap <= 0)) return;
  const Vector3& normal = surface_.patches()[patch].normal;
  for (int f = surface_.patches()[patch].first_face; f >= 0; f = surface_.faces()[at(f)].next_in_patch) {
    const Face& face = surface_.faces()[at(f)];
    if (!surface_.is_over(face, support.deepest)) continue;
    support.is_over = true;
    const double gap = support.gap - surface_.rise_over_patch(face, support.deepest);
    if (!(gap <= surface_.rounding())) return;
    const SurfaceContact contact = contact_at(f, normal, std::min(gap, 0.0), support.deepest);
    if (touches_surface(probe, contact)) found_.add(contact);
    return;
  }
}

// Each convex edge is handled once, by the face with the lower index.
bool MeshContactSearch::is_edge_owned_by_neighbour(int face, int side) const {
  const int neighbour = surface_.faces()[at(face)].neighbour[at(side)];
  if (neighbour < 0 || neighbour > face) return false;
  const std::array<int, 3>& back = surface_.faces()[at(neighbour)].neighbour;
  return std::find(back.begin(), back.end(), face) != back.end();
}

bool MeshContactSearch::open_arc(SupportProbe& probe, int f, int side, Arc& arc, ArcSample& low, ArcSample& high) const {
  const Face& face = surface_.faces()[at(f)];
  const EdgeConvexity convexity = face.convexity[at(side)];
  const PatchSupport& support = supports_[at(face.patch)];
  if (convexity == EdgeConvexity::Flat || convexity == EdgeConvexity::Concave || !(support.gap <= 0) ||
      is_edge_owned_by_neighbour(f, side))
    return false;
  // Rounding may tilt the edge from the plane of the patch. The arc is across the edge.
  const Vector3 along = (face.vertices[at(next_corner(side))] - face.vertices[at(side)]).normalized();
  const Vector3 from = along.cross(face.normal).cross(along).normalized();
  const Vector3& across = face.outward[at(side)];
  arc = {from, across, 0.5 * std::numbers::pi, face.vertices[at(side)]};
  low = arc.sample(0, support.deepest);
  if (convexity == EdgeConvexity::Border) {
    if (!(low.slope > surface_.rounding() + face.crack[at(side)])) return false;
    high = arc.sample(arc.end, probe);
    return true;
  }
  const std::size_t other = at(surface_.faces()[at(face.neighbour[at(side)])].patch);
  const Vector3& other_normal = surface_.patches()[other].normal;
  const double angle = std::atan2(other_normal.dot(across), other_normal.dot(arc.from));
  arc.end = angle > 0 ? angle : std::numbers::pi;  // the faces are back to back
  high = arc.sample(arc.end, supports_[other].deepest);
  return supports_[other].gap <= 0;
}

void MeshContactSearch::find_on_edge(SupportProbe& probe, int f, int side) {
  Arc arc;
  ArcSample low;
  ArcSample high;
  if (!open_arc(probe, f, side, arc, low, high)) return;
  if (have_maximum_between(low, high, surface_.rounding())) find_on_arc(probe, f, side, arc, low, high);
}

double MeshContactSearch::arc_tolerance() const {
  return std::max(kArcTolerance * settings_.tolerance * length_unit_, 1e-3 * surface_.rounding());
}

// Gaps within this of each other (m) are equal to a query.
double MeshContactSearch::touch() const { return settings_.tolerance * length_unit_ + surface_.rounding(); }

void MeshContactSearch::find_on_arc(SupportProbe& probe, int f, int side, const Arc& arc, const ArcSample& low,
                                    const ArcSample& high) {
  const Face& face = surface_.faces()[at(f)];
  const int first_evaluation = probe.evaluations();
  const ArcMaximum top = maximize_between(probe, arc, low, high, arc_tolerance(), settings_.max_evaluations);
  if (top.is_apart || !(top.gap <= 0)) return;
  const double weight = face.convexity[at(side)] == EdgeConvexity::Border ? stands_on(probe, arc.from, arc.edge_point) : 0;
  if (weight > 0) {
    find_on_border(probe, f, side, arc, top, weight);
    return;
  }
  const Vector3 edge = face.vertices[at(next_corner(side))] - arc.edge_point;
  const double share = edge.dot(top.point - arc.edge_point) / edge.squaredNorm();
  SurfaceContact contact = contact_at(f, top.normal, top.gap, top.point);
  contact.crease = surface_.corner_count() + 3 * f + side;
  contact.surface_point = arc.edge_point + share * edge;
  contact.feature_point = arc.edge_point + std::clamp(share, 0.0, 1.0) * edge;
  contact.place = contact.surface_point + contact.gap * contact.normal;
  const bool is_beyond_end = (contact.feature_point - contact.surface_point).norm() > surface_.rounding();
  if (is_beyond_end && !surface_.has_wall(top.normal, contact.feature_point, contact.surface_point)) {
    find_on_vertex(probe, f, share < 0 ? side : next_corner(side), top.normal);
    return;
  }
  contact.error = top.error;
  contact.evaluations = probe.evaluations() - first_evaluation;
  contact.status = top.converged ? Status::Converged : Status::EvaluationLimit;
  if (face.convexity[at(side)] == EdgeConvexity::Border && !has_complete_neighbourhood(probe, contact.feature_point)) return;
  if (surface_.violates_normal_cone(contact.normal, contact.feature_point, contact.surface_point)) return;
  if (touches_surface(probe, contact)) found_.add(contact);
}

// The deepest point may lie under no face although the solid continues there. There are two such cases:
//
// * A sharp tip is pressed into the corner of floor and wall. Above the tip there is the wall, not the floor. The solid continues
//   below the wall, and so does the contact with the floor.
// * A thin rod stands deep in the floor. Above its tip the floor is outside the body's box, and its triangles are unknown.
//
// The contact may only continue as far as the solid: beyond a low wall the plane of the floor is in the air. Where the body leaves
// that plane it must be in the solid. Then a known face lies between that point and the other end of the body.
void MeshContactSearch::find_beyond_rim(SupportProbe& probe, std::size_t p) {
  const CoplanarPatch& patch = surface_.patches()[p];
  const PatchSupport& support = supports_[p];
  if (!(support.gap <= 0) || support.is_over) return;
  const Vector3 to_top = probe.deepest(-patch.normal).point - support.deepest;
  const double rise = patch.normal.dot(to_top);
  if (!(rise > -support.gap)) return;  // the whole body is behind the plane
  if (!surface_.exits_solid(support.deepest - support.gap / rise * to_top, support.deepest + to_top)) return;
  SurfaceContact contact = contact_at(patch.first_face, patch.normal, support.gap, support.deepest);
  int side = 0;
  contact.feature_point = surface_.nearest_on_rim(patch, contact.surface_point, contact.face, side);
  const Face& face = surface_.faces()[at(contact.face)];
  const bool goes_on_behind_wall = surface_.has_wall(patch.normal, contact.feature_point, contact.surface_point);
  const bool goes_on_unknown =
      face.convexity[at(side)] == EdgeConvexity::Border && !has_complete_neighbourhood(probe, contact.feature_point);
  if (goes_on_unknown || goes_on_behind_wall) beyond_rim_.add(contact);
}

// Adds the deepest of nearly parallel contacts, whatever the order of the triangles.
void MeshContactSearch::add_beyond_rim() {
  beyond_rim_.sort();
  for (const SurfaceContact& contact : beyond_rim_.contacts()) {
    if (found_.has_similar(contact.normal, contact.body_point)) {
      continued_.push_back(to_world(contact));
    } else {
      found_.add(contact);
    }
  }
}

// Whether all triangles at a point are known. The caller found the triangles in the body's box.
bool MeshContactSearch::has_complete_neighbourhood(const SupportProbe& probe, const Vector3& point) const {
  return box_.contains(probe.rotation().transpose() * point, surface_.rounding());
}

// The body's point may lie under a face while the body is beside the solid: a rod leans against the border of a sheet from below.
// The segment from the point to the opposite end of the body lies in the body. Where it leaves the solid it meets the surface.
bool MeshContactSearch::touches_surface(SupportProbe& probe, const SurfaceContact& contact) const {
  const Vector3 top = probe.deepest(-contact.normal).point;
  if (!(contact.normal.dot(top - contact.surface_point) > 0)) return false;  // the whole body is behind the plane
  return surface_.is_crossed(contact.body_point, top, contact.face) ||
         overlaps(meet_face(probe, surface_.faces()[at(contact.face)]), contact.gap);
}

// Whether a face and a body with the proximity `found` overlap, so that a contact with this gap is possible. Within the tolerance
// the query cannot tell on which side the body touches. A body that touches an edge from outside is far below the planes of its
// faces.
bool MeshContactSearch::overlaps(const Proximity& found, double gap) const {
  return found.status != Status::Apart && found.gap <= 0 && (found.gap < -touch() || gap >= -touch());
}

Proximity MeshContactSearch::meet_face(SupportProbe& probe, const Face& face) const {
  const Proximity found = find_triangle_proximity(probe.shape(), {Vector3::Zero(), probe.rotation()}, face.vertices, settings_);
  probe.count(found.evaluations);
  return found;
}

// Searches every part that the body touches for a separating translation shorter than the known one. Edges are searched wherever a
// shorter one is possible. At the vertices of a convex part the hull of the part is solved. Of 20 000 random pairs of bodies with
// exponents 1.02...200 and convex meshes, apart or overlapping by up to 10 %, 23 have a minimum translation that only this search
// finds.
//
// An overlap below the radius of the ball that rolls inside the body needs no search. The estimated smallest radius of curvature is
// no such bound. It ignores vertices, where the radius vanishes at a single normal, and an edge of a mesh has no radius of its own
// to compensate.
void MeshContactSearch::find_other_separations(SupportProbe& probe) {
  double depth = found_.contacts().empty() ? std::numeric_limits<double>::infinity() : 0;
  for (const SurfaceContact& contact : found_.contacts()) depth = std::max(depth, -contact.gap);
  if (depth <= probe.shape().rolling_radius()) return;
  for (int part = 0; part < static_cast<int>(surface_.patches().size()); ++part) {
    const std::optional<double> known = depth_cutoff(part);
    if (!known) continue;
    for (int f = 0; f < static_cast<int>(surface_.faces().size()); ++f) {
      if (surface_.part_of(surface_.faces()[at(f)]) == part) find_shorter_over_edges(probe, f, *known);
    }
    add_near_edges(probe);
    find_shorter_over_vertices(probe, part, *known);
  }
}

// Empty if no search is needed: a single plane has one normal. A part without a contact is apart if one of its planes is. If none
// is, its contact may have been missed.
std::optional<double> MeshContactSearch::depth_cutoff(int part) const {
  int patch_count = 0;
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < supports_.size(); ++p) {
    if (surface_.patches()[p].part != part) continue;
    ++patch_count;
    largest = std::max(largest, supports_[p].gap);
  }
  if (patch_count < 2) return std::nullopt;
  const std::optional<double> known = found_.shortest_separation(part);
  if (!known && largest <= 0) return -std::numeric_limits<double>::infinity();
  return known;
}

void MeshContactSearch::find_shorter_over_edges(SupportProbe& probe, int face, double known) {
  for (int side = 0; side < 3; ++side) {
    Arc arc;
    ArcSample low;
    ArcSample high;
    if (!open_arc(probe, face, side, arc, low, high)) continue;
    if (find_higher_maximum(probe, arc, low, high, known, arc_tolerance())) find_on_arc(probe, face, side, arc, low, high);
  }
}

void MeshContactSearch::find_shorter_over_vertices(SupportProbe& probe, int part, double known) {
  hull_.clear();
  for (const Face& face : surface_.faces()) {
    if (surface_.part_of(face) != part) continue;
    if (std::find(face.convexity.begin(), face.convexity.end(), EdgeConvexity::Concave) != face.convexity.end()) return;
    hull_.insert(hull_.end(), face.vertices.begin(), face.vertices.end());
  }
  const Proximity found = solve_for_hull(probe, Vector3::Zero(), nullptr);
  if (found.status == Status::InvalidInput || found.status == Status::Apart || !(known < found.gap && found.gap <= 0)) return;
  int highest_face = 0;
  int highest = 0;
  double height = -std::numeric_limits<double>::infinity();
  for (int f = 0; f < static_cast<int>(surface_.faces().size()); ++f) {
    if (surface_.part_of(surface_.faces()[at(f)]) != part) continue;
    for (int k = 0; k < 3; ++k) {
      const double here = -found.normal.dot(surface_.faces()[at(f)].vertices[at(k)]);
      if (here <= height) continue;
      height = here;
      highest_face = f;
      highest = k;
    }
  }
  const int corner = surface_.faces()[at(highest_face)].corner[at(highest)];
  if (!is_found_beside(corner, -found.normal, found.gap)) add_at_vertex(probe, highest_face, highest, found);
}

// If no normal is a maximum, takes the shortest translation out of a face that the body crosses. This happens to a body that has
// sunk and leaves the solid only at the foot of a wall. It also happens to a body on a concave corner, where the surface recedes
// under its deepest point. A body behind the face, as at the border of a sheet, is ignored.
void MeshContactSearch::find_shortest_exit(SupportProbe& probe) {
  const Vector3 centre = probe.rotation() * box_.centre;
  std::optional<SurfaceContact> shortest;
  for (std::size_t f = 0; f < surface_.faces().size(); ++f) {
    const Face& face = surface_.faces()[f];
    const PatchSupport& support = supports_[at(face.patch)];
    if (!(support.gap <= 0) || (shortest && support.gap <= shortest->gap)) continue;
    const Proximity found = meet_face(probe, face);
    if (!overlaps(found, support.gap)) continue;
    const bool is_in_front = face.normal.dot(centre - face.vertices[0]) > surface_.rounding();
    // On a flat side of the body, point1 is not unique.
    const Vector3 opposite = found.point2 - found.gap * found.normal;
    if (!is_in_front && !surface_.exits_solid(centre, found.point1) && !surface_.exits_solid(centre, opposite)) continue;
    shortest = contact_at(static_cast<int>(f), face.normal, support.gap, support.deepest);
    // If the body lies flat on the face, its support point may not be over the face.
    if (!(found.normal.dot(-face.normal) >= 1 - kAligned) || surface_.is_over(face, support.deepest)) continue;
    shortest->place = found.contact + face.normal.dot(support.deepest - found.contact) * face.normal;
  }
  if (shortest) found_.add(*shortest);
}

bool MeshContactSearch::has_normal(const Vector3& normal, const Vector3& point) const {
  return !surface_.violates_normal_cone(normal, point - origin_, point - origin_);
}

MeshContact MeshContactSearch::to_world(const SurfaceContact& found) const {
  Proximity out;
  out.gap = found.gap + swept_;
  out.error = found.error;
  out.normal = -found.normal;
  out.point1 = origin_ + found.body_point + swept_ * found.normal;
  out.point2 = out.point1 - out.gap * found.normal;
  out.contact = origin_ + found.place + swept_ * found.normal;
  out.evaluations = found.evaluations;
  out.status = found.status;
  return {out, surface_.faces()[at(found.face)].triangle};
}

MeshContacts::MeshContacts() : search_(std::make_unique<MeshContactSearch>()) {}
MeshContacts::~MeshContacts() = default;
MeshContacts::MeshContacts(MeshContacts&&) noexcept = default;
MeshContacts& MeshContacts::operator=(MeshContacts&&) noexcept = default;

std::span<const MeshContact> MeshContacts::find(const Shape& shape, const Pose& pose, std::span<const MeshTriangle> triangles,
                                                const Settings& settings) {
  return search_->find(shape, pose, triangles, settings, 0);
}

std::span<const MeshContact> MeshContacts::find_within(double distance, const Shape& shape, const Pose& pose,
                                                       std::span<const MeshTriangle> triangles, const Settings& settings) {
  return search_->find(shape, pose, triangles, settings, distance);
}

std::span<const MeshContact> MeshContacts::continued() const { return search_->continued(); }

bool MeshContacts::has_normal(const Vector3& normal, const Vector3& point) const { return search_->has_normal(normal, point); }

int MeshContacts::evaluations() const { return search_->evaluations(); }

}  // namespace supernormal
