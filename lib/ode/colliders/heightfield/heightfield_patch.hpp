// The triangles of a dHeightfield in a region.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "ode/colliders/heightfield/heightfield_grid.hpp"
#include "supernormal/contact/mesh_contacts.hpp"

namespace supernormal::ode {

/// A rectangle of the heightfield's own x and z, m.
struct Region {
  double x_low, x_high, z_low, z_high;

  Region widened(double by) const { return {x_low - by, x_high + by, z_low - by, z_high + by}; }
  double reach() const;  ///< distance from the middle to the farther side
};

/// Reads triangles, in the heightfield's own frame. It owns the memory and the grids found so far: keep one per thread.
///
/// Samples are read anew in every query, because ODE lets the program change them at any time. The same data may also get another
/// grid, and other data the same address: every query that uses the grid of an earlier one first looks at its witness. The
/// triangles are exact when the grid is known, or when the surface is a plane there. When neither is so (samples that are not
/// numbers everywhere, very long cells), or when the region holds more than 512 cells along x or z, the triangles are those of 32 x
/// 32, or 512 x 512, points of the surface.
class HeightfieldPatch {
 public:
  /// All triangles with a part above or below the region. The region is moved to the border if it lies beyond: there is at least
  /// one triangle, unless samples are not numbers. Valid until the next call. Throws std::domain_error when the region is so far
  /// from the origin that ODE could not tell its cells apart.
  std::span<const MeshTriangle> read(HeightfieldProbe& probe, const Region& region);

 private:
  void read_anew(HeightfieldProbe& probe, const Region& region);
  bool read_grid(HeightfieldProbe& probe, const SampleGrid& grid, const Region& region);
  bool is_consistent() const;
  void read_plane(const Facet& facet, const Region& region);
  void read_points(HeightfieldProbe& probe, const Region& region, int cells);
  void lay_out(const Region& region, int cells);
  void make_triangles();
  void add_triangle(const Vector3& p1, const Vector3& p2, const Vector3& p3);
  std::size_t node(std::size_t i, std::size_t j) const { return i * z_.size() + j; }

  std::unordered_map<dHeightfieldDataID, FoundGrid> grids_;
  std::vector<double> x_, z_;    // m, ascending; coordinates of a lattice of points on the surface
  std::vector<double> heights_;  // m, at the node (i, j); not a number where there is no surface
  std::vector<Facet> facets_;    // one that meets the node; that of the cell's triangle abc if it has one
  std::vector<MeshTriangle> triangles_;
};

}  // namespace supernormal::ode
