// Shorter separating translations for deep overlaps of sharp bodies. There the gap has several maxima over the normals of one edge
// or vertex.
#include <algorithm>
#include <limits>
#include <optional>

#include "contact/mesh/mesh_contact_search.hpp"

namespace supernormal {
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

}  // namespace supernormal
