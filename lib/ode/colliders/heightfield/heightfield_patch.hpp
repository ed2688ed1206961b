// The triangles of a dHeightfield in a region.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "ode/colliders/heightfield/heightfield_grid.hpp"
#include "supernormal/contact/mesh_contacts.hpp"

namespace supernormal::ode {

/// A rectangle in the x and z of the heightfield, m.
struct Region {
  double x_low, x_high, z_low, z_high;

  Region widened(double by) const { return {x_low - by, x_high + by, z_low - by, z_high + by}; }
  double reach() const;  ///< half of the longer side
};

/// Reads triangles, in the frame of the heightfield. Owns the memory and the grids found so far: keep one per thread.
///
/// Every query reads the samples again, because the program may change them at any time. The data may also get another grid, or
/// other data the same address: before an earlier grid is used, its witness is checked.
///
/// The triangles are exact when the grid is known or the surface is a plane. Without a grid (some samples NaN, very long cells)
/// they interpolate 32 x 32 points of the surface. In a region of more than 512 cells along x or z they interpolate 512 x 512
/// points.
class HeightfieldPatch {
 public:
  /// All triangles with a part above or below the region. A region beyond the border is moved to it, so there is at least one
  /// triangle unless samples are NaN. Valid until the next call. Throws std::domain_error when the region is so far from the origin
  /// that ODE cannot resolve its cells.
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
  std::vector<double> x_, z_;    // m, ascending; coordinates of a lattice of surface points
  std::vector<double> heights_;  // m, at the node (i, j); NaN where there is no surface
  std::vector<Facet> facets_;    // a facet at the node; the facet of the triangle abc if the cell has one
  std::vector<MeshTriangle> triangles_;
};

}  // namespace supernormal::ode
