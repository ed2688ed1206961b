// The sample positions of a dHeightfield, which ODE does not report.
#pragma once

#include <cstdint>
#include <optional>

#include "ode/colliders/heightfield/heightfield_probe.hpp"

namespace supernormal::ode {

/// Samples are at k * spacing - half (m), for k = 0 ... count - 1. With count = 0, k is any integer.
struct SampleAxis {
  double spacing = 0;
  double half = 0;
  std::int64_t count = 0;

  double at(std::int64_t k) const { return static_cast<double>(k) * spacing - half; }

  /// The index of the sample at x, to rounding; empty if there is none.
  std::optional<std::int64_t> sample_at(double x) const;

  /// The cell that contains x: cell k lies between samples k and k + 1. Beyond the border: the last cell.
  std::int64_t cell_of(double x) const;
};

struct SampleGrid {
  SampleAxis x, z;
};

/// Finds a triangle with the vertex (i, j) by a ray near this sample. Prefers the triangle of cell (i, j) with samples a (i, j), b
/// (i + 1, j) and c (i, j + 1). (The triangles of ODE are abc and dbc, with d (i + 1, j + 1).) A ray exactly at the sample would
/// make ODE test four cells. Returns false if no adjacent triangle has a surface.
bool find_facet_at_sample(HeightfieldProbe& probe, const SampleGrid& grid, std::int64_t i, std::int64_t j, Facet& facet);

/// Whether two heights are equal up to the rounding error of the facet's plane. A difference below 1e-9 of `extent` (m), the height
/// range around, counts as rounding.
bool is_same_height(double height1, double height2, const Facet& facet, double extent);

/// A cell around which ODE lists neighbouring samples along both axes. It shows whether the data still have the grid. A radius of 0
/// means none.
struct GridWitness {
  std::int64_t i = 0, j = 0;  ///< the cell
  double height = 0;          ///< m; height of the surface when the grid was found
  double radius = 0;          ///< m, within which samples are listed
};

struct FoundGrid {
  SampleGrid grid;
  GridWitness witness;
};

/// Whether all samples that ODE lists around the witness are on the grid, with neighbours along both axes. Only then does the grid
/// match the data: a finer grid would show samples in between, and a coarser grid no neighbours.
bool is_shown(HeightfieldProbe& probe, const SampleGrid& grid, const GridWitness& witness);

/// Finds the grid. Lists samples around the spot, in growing circles, until they define a grid that agrees with the triangles
/// around. Prefers a grid with a witness. The grid may omit samples that lie on the plane through their neighbours: the surface is
/// the same.
///
/// The result is empty when the surface is a plane within `reach` (m) of the spot along x and z, and shows no grid (`is_plane`). It
/// is also empty when no grid can be found: samples are NaN, or cells are more than a hundred times longer than wide.
std::optional<FoundGrid> find_grid(HeightfieldProbe& probe, const Facet& spot, double reach, bool& is_plane);

}  // namespace supernormal::ode
