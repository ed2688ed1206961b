// The positions of a dHeightfield's samples, which ODE does not tell.
#pragma once

#include <cstdint>
#include <optional>

#include "ode/colliders/heightfield/heightfield_probe.hpp"

namespace supernormal::ode {

/// Samples are at k * spacing - half for k = 0 ... count - 1, or for all k when count is 0 (m).
struct SampleAxis {
  double spacing = 0;
  double half = 0;
  std::int64_t count = 0;

  double at(std::int64_t k) const { return static_cast<double>(k) * spacing - half; }

  /// The number of the sample at x; empty if there is none there but for rounding.
  std::optional<std::int64_t> sample_at(double x) const;

  /// The cell that contains x: k for the one from sample k to sample k + 1; the last one beyond the border.
  std::int64_t cell_of(double x) const;
};

struct SampleGrid {
  SampleAxis x, z;
};

/// Finds a triangle with the sample (i, j) as a corner, by a ray near it: that of the cell (i, j) with samples a (i, j), b (i +
/// 1, j) and c (i, j + 1), if that one has a surface. (ODE's triangles are abc and dbc, with d (i + 1, j + 1).) The ray is near
/// and not at the sample, where ODE would look at four cells instead of one. Returns false if none of the triangles around has a
/// surface.
bool find_facet_at_sample(HeightfieldProbe& probe, const SampleGrid& grid, std::int64_t i, std::int64_t j, Facet& facet);

/// Whether two heights are equal but for the rounding of the facet's plane. A kink below 1e-9 of the `extent` (m), the difference
/// of heights around, counts as rounding.
bool is_same_height(double height1, double height2, const Facet& facet, double extent);

/// A cell around which ODE lists neighbouring samples along both axes: it shows whether the data still has the grid, whatever else
/// the program has changed. With a radius of 0 there is none.
struct GridWitness {
  std::int64_t i = 0, j = 0;  ///< the cell
  double height = 0;          ///< m; that of the surface when the grid was found
  double radius = 0;          ///< m, within which samples are listed
};

struct FoundGrid {
  SampleGrid grid;
  GridWitness witness;
};

/// Whether the samples that ODE lists around the witness are all on the grid, with neighbours along both axes among them. Only then
/// the grid is the one of the data: a finer one would show samples in between, and a coarser one no neighbours.
bool is_shown(HeightfieldProbe& probe, const SampleGrid& grid, const GridWitness& witness);

/// Finds the grid by listing samples around the spot, more and more of them, until they show one that the triangles around agree
/// with, and that has a witness if any has. It may leave out samples that lie on the plane through their neighbours: the surface
/// is the same. Empty when the surface is a plane at least as far as `reach` (m) from the spot along x and z, and shows no grid; or
/// when there is none to be found, because of samples that are not numbers or cells more than a hundred times longer than wide:
/// `is_plane` tells which.
std::optional<FoundGrid> find_grid(HeightfieldProbe& probe, const Facet& spot, double reach, bool& is_plane);

}  // namespace supernormal::ode
