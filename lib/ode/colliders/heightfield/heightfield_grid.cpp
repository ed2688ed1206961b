#include "ode/colliders/heightfield/heightfield_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/thread_kept.hpp"

namespace supernormal::ode {
namespace {

// Three distinct columns and rows of samples determine the spacing without ambiguity.
constexpr std::size_t kEnough = 3;

// The first radius suits cells much smaller than the body, the last cells a million times larger.
constexpr double kFirstRadius = 1.0 / 64;
constexpr int kDoublings = 26;

// A sample must be within this fraction of a cell from its place. A grid with another spacing, and fewer than a million cells along
// an axis, differs by more from the second sample on.
constexpr double kOnSample = 1e-6;

// Steps from a sample into its six adjacent triangles, in cells.
constexpr std::array<std::array<double, 2>, 6> kIntoTriangles = {
    {{0.125, 0.125}, {-0.25, 0.125}, {-0.125, 0.25}, {0.125, -0.25}, {0.25, -0.125}, {-0.125, -0.125}}};

std::vector<double> distinct(const std::vector<Vector3>& samples, int axis) {
  std::vector<double> coordinates;
  coordinates.reserve(samples.size());
  for (const Vector3& sample : samples) coordinates.push_back(sample[axis]);
  std::sort(coordinates.begin(), coordinates.end());
  coordinates.erase(std::unique(coordinates.begin(), coordinates.end()),
                    coordinates.end());  // equal coordinates have the same bits
  return coordinates;
}

double smallest_step(const std::vector<double>& coordinates) {
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < coordinates.size(); ++k) step = std::min(step, coordinates[k] - coordinates[k - 1]);
  return step;
}

bool is_on(const SampleAxis& axis, const std::vector<double>& coordinates) {
  return std::all_of(coordinates.begin(), coordinates.end(), [&](double x) {
    const double k = (x + axis.half) / axis.spacing;
    return std::abs(k - std::round(k)) < 1e-3;
  });
}

// The extent is a whole number of cells, which makes the spacing exact.
std::optional<SampleAxis> finite_axis(std::vector<double> coordinates, double half) {
  std::erase_if(coordinates,
                [&](double x) { return std::abs(x) > half * (1 - kBorder); });  // border samples, exact only to rounding
  coordinates.push_back(half);
  coordinates.insert(coordinates.begin(), -half);
  const double cells = std::round(2 * half / smallest_step(coordinates));
  if (!(cells >= 1) || cells > 1e7) return std::nullopt;
  const SampleAxis axis{2 * half / cells, half, static_cast<std::int64_t>(cells) + 1};
  if (!is_on(axis, coordinates)) return std::nullopt;
  return axis;
}

// All samples are at whole multiples of half the spacing. The sample farthest from the origin determines the spacing to most
// digits.
std::optional<SampleAxis> infinite_axis(const std::vector<double>& coordinates) {
  const double step = smallest_step(coordinates);
  const double baseline = coordinates.back() - coordinates.front();
  const double spacing = baseline / std::round(baseline / step);
  const double farthest = std::abs(coordinates.front()) > std::abs(coordinates.back()) ? coordinates.front() : coordinates.back();
  const double halves = std::round(2 * farthest / spacing);
  if (halves == 0 || !(std::abs(halves) < 1e7)) return std::nullopt;
  SampleAxis axis{2 * farthest / halves, 0, 0};
  if (std::fmod(halves, 2) != 0) axis.half = axis.spacing / 2;
  if (!is_on(axis, coordinates)) return std::nullopt;
  return axis;
}

std::optional<SampleGrid> grid_through(const HeightfieldProbe& probe, const std::vector<Vector3>& samples, bool all) {
  const std::vector<double> columns = distinct(samples, 0);
  const std::vector<double> rows = distinct(samples, 2);
  if (!all && (columns.size() < kEnough || rows.size() < kEnough)) return std::nullopt;
  const auto x = probe.is_infinite() ? infinite_axis(columns) : finite_axis(columns, probe.half_width());
  const auto z = probe.is_infinite() ? infinite_axis(rows) : finite_axis(rows, probe.half_depth());
  if (!x || !z) return std::nullopt;
  return SampleGrid{*x, *z};
}

enum class Verdict { Agrees, Disagrees, Unknown };

// Three rays hit each triangle. Those in one triangle must find one plane, and the two planes must meet at b and c.
Verdict check_cell(HeightfieldProbe& probe, const SampleGrid& grid, std::int64_t i, std::int64_t j) {
  constexpr std::array<std::array<double, 2>, 6> kPlaces = {
      {{0.1, 0.1}, {0.8, 0.1}, {0.1, 0.8}, {0.9, 0.9}, {0.9, 0.2}, {0.2, 0.9}}};
  const std::array<double, 2> xs = {grid.x.at(i), grid.x.at(i + 1)};
  const std::array<double, 2> zs = {grid.z.at(j), grid.z.at(j + 1)};
  std::array<Facet, kPlaces.size()> facets;
  for (std::size_t k = 0; k < kPlaces.size(); ++k) {
    const double x = xs[0] + kPlaces[k][0] * grid.x.spacing;
    const double z = zs[0] + kPlaces[k][1] * grid.z.spacing;
    if (!probe.find_facet(x, z, grid.x.spacing, facets[k])) return Verdict::Unknown;
  }
  const std::array<double, 4> heights = {facets[0].height_at(xs[0], zs[0]), facets[0].height_at(xs[1], zs[0]),
                                         facets[0].height_at(xs[0], zs[1]), facets[3].height_at(xs[1], zs[1])};
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  for (std::size_t k = 0; k < kPlaces.size(); ++k) {
    const Facet& facet = facets[k];
    const double extent = *high - *low;
    const bool agrees = is_same_height(facet.height_at(xs[1], zs[0]), heights[1], facet, extent) &&
                        is_same_height(facet.height_at(xs[0], zs[1]), heights[2], facet, extent) &&
                        is_same_height(k < 3 ? facet.height_at(xs[0], zs[0]) : facet.height_at(xs[1], zs[1]),
                                       k < 3 ? heights[0] : heights[3], facet, extent);
    if (!agrees) return Verdict::Disagrees;
  }
  return Verdict::Agrees;
}

bool is_confirmed(HeightfieldProbe& probe, const SampleGrid& grid, const Facet& spot) {
  const std::int64_t i0 = grid.x.cell_of(spot.x);
  const std::int64_t j0 = grid.z.cell_of(spot.z);
  int agreeing = 0;
  for (std::int64_t i = i0 - 2; i <= i0 + 2; ++i) {
    if (grid.x.count > 0 && (i < 0 || i > grid.x.count - 2)) continue;
    for (std::int64_t j = j0 - 2; j <= j0 + 2; ++j) {
      if (grid.z.count > 0 && (j < 0 || j > grid.z.count - 2)) continue;
      const Verdict verdict = check_cell(probe, grid, i, j);
      if (verdict == Verdict::Disagrees) return false;
      if (verdict == Verdict::Agrees) ++agreeing;
    }
  }
  return agreeing > 0;
}

// Lists all samples around. ODE omits the samples on the plane of the facet below: a second facet adds them.
bool list_around(HeightfieldProbe& probe, const Facet& spot, double radius, std::vector<Vector3>& samples) {
  if (!probe.list_samples(spot.place(), radius, samples)) return false;
  if (samples.empty()) return true;
  const Vector3 sample = samples[samples.size() / 2];  // not on the plane of the spot
  // The second facet must be beside the sample, also after rounding.
  const double aside = std::max(1e-6 * radius, 16 * kRealEpsilon * (std::abs(sample.x()) + std::abs(sample.z())));
  for (const double step : {aside, -aside}) {
    Facet other;
    if (probe.find_facet(sample.x() + step, sample.z() + 0.6 * step, radius, other)) {
      return probe.list_samples(other.place(), radius, samples);
    }
  }
  return true;
}

// A rectangle without interior samples has a plane surface if its corners are coplanar with the spot. Otherwise it would have an
// edge.
bool is_plane_around(HeightfieldProbe& probe, const Facet& spot, double reach) {
  const double limit_x = probe.half_width() * kInside;
  const double limit_z = probe.half_depth() * kInside;
  for (const double side_x : {-reach, reach}) {
    for (const double side_z : {-reach, reach}) {
      const double x = std::clamp(spot.x + side_x, -limit_x, limit_x);
      const double z = std::clamp(spot.z + side_z, -limit_z, limit_z);
      Facet facet;
      if (!probe.find_facet(x, z, reach, facet)) return false;
      const double height = spot.height_at(x, z);
      if (!is_same_height(facet.height, height, facet, std::abs(height - spot.height))) return false;
    }
  }
  return true;
}

// Whether two of the samples are in neighbouring columns, or rows. All of them must be on the grid.
bool has_neighbours(const SampleAxis& axis, const std::vector<Vector3>& samples, int along) {
  const auto is_next_to = [&](const Vector3& a, const Vector3& b) {
    return axis.sample_at(b[along]) == *axis.sample_at(a[along]) + 1;
  };
  return std::any_of(samples.begin(), samples.end(), [&](const Vector3& a) {
    return std::any_of(samples.begin(), samples.end(), [&](const Vector3& b) { return is_next_to(a, b); });
  });
}

// Looks for a witness among the four cells around a sample. A circle of 0.6 diagonals about a place near the middle of a cell
// contains all its samples. On a gentle ridge the samples lie in the planes of both sides: the larger radius lists enough samples
// on one side.
GridWitness find_witness_at(HeightfieldProbe& probe, const SampleGrid& grid, const Vector3& sample) {
  const double diagonal = std::hypot(grid.x.spacing, grid.z.spacing);
  for (const double radius : {0.6 * diagonal, 2 * diagonal}) {
    for (const double along_x : {0.5, -0.5}) {
      for (const double along_z : {0.5, -0.5}) {
        const GridWitness witness{grid.x.cell_of(sample.x() + along_x * grid.x.spacing),
                                  grid.z.cell_of(sample.z() + along_z * grid.z.spacing), sample.y(), radius};
        if (is_shown(probe, grid, witness)) return witness;
      }
    }
  }
  return {};
}

GridWitness find_witness(HeightfieldProbe& probe, const SampleGrid& grid, const std::vector<Vector3>& samples) {
  if (samples.empty()) return {};
  for (const std::size_t k : {samples.size() / 2, std::size_t{0}, samples.size() - 1}) {
    const GridWitness witness = find_witness_at(probe, grid, samples[k]);
    if (witness.radius > 0) return witness;
  }
  return {};
}

}  // namespace

std::optional<std::int64_t> SampleAxis::sample_at(double x) const {
  const auto k = static_cast<std::int64_t>(std::round((x + half) / spacing));
  const double rounding = kOnSample * spacing + 64 * kRealEpsilon * (std::abs(x) + half);
  if (!(std::abs(x - at(k)) <= rounding)) return std::nullopt;
  return k;
}

std::int64_t SampleAxis::cell_of(double x) const {
  const double k = std::floor((x + half) / spacing);
  if (count == 0) return static_cast<std::int64_t>(k);
  return static_cast<std::int64_t>(std::clamp(k, 0.0, static_cast<double>(count - 2)));
}

bool find_facet_at_sample(HeightfieldProbe& probe, const SampleGrid& grid, std::int64_t i, std::int64_t j, Facet& facet) {
  const double scale = std::max(grid.x.spacing, grid.z.spacing);
  return std::any_of(kIntoTriangles.begin(), kIntoTriangles.end(), [&](const std::array<double, 2>& step) {
    return probe.find_facet(grid.x.at(i) + step[0] * grid.x.spacing, grid.z.at(j) + step[1] * grid.z.spacing, scale, facet);
  });
}

bool is_same_height(double height1, double height2, const Facet& facet, double extent) {
  return std::abs(height1 - height2) <= 64 * facet.rounding + 1e-9 * extent;
}

bool is_shown(HeightfieldProbe& probe, const SampleGrid& grid, const GridWitness& witness) {
  thread_local ThreadKept<std::vector<Vector3>> kept;  // to reuse its memory
  std::vector<Vector3>& samples = *kept;
  samples.clear();
  const auto is_on_grid = [&](const Vector3& sample) { return grid.x.sample_at(sample.x()) && grid.z.sample_at(sample.z()); };
  if (!(witness.radius > 0)) return false;
  // The second triangle shows the samples on the plane of the first.
  for (const double in_cell : {0.45, 0.55}) {
    const Vector3 place{grid.x.at(witness.i) + in_cell * grid.x.spacing, witness.height,
                        grid.z.at(witness.j) + in_cell * grid.z.spacing};
    if (!probe.list_samples(place, witness.radius, samples)) return false;
    if (!std::all_of(samples.begin(), samples.end(), is_on_grid)) return false;
    if (has_neighbours(grid.x, samples, 0) && has_neighbours(grid.z, samples, 2)) return true;
  }
  return false;
}

std::optional<FoundGrid> find_grid(HeightfieldProbe& probe, const Facet& spot, double reach, bool& is_plane) {
  is_plane = false;
  const double whole = 2 * (probe.half_width() + probe.half_depth());
  std::vector<Vector3> samples;
  std::optional<FoundGrid> without_witness;
  for (int k = 0; k <= kDoublings; ++k) {
    const double radius = std::ldexp(kFirstRadius * reach, k);
    samples.clear();
    const bool is_complete = list_around(probe, spot, radius, samples);
    const std::optional<SampleGrid> grid = grid_through(probe, samples, radius > whole);
    if (grid && is_confirmed(probe, *grid, spot)) {
      const FoundGrid found{*grid, find_witness(probe, *grid, samples)};
      if (found.witness.radius > 0) return found;
      if (!without_witness) without_witness = found;
    }
    if (samples.empty() && radius > 2 * reach && is_plane_around(probe, spot, reach)) {
      is_plane = true;
      return std::nullopt;
    }
    if (!is_complete || radius > 1e3 * whole) break;
  }
  return without_witness;
}

}  // namespace supernormal::ode
