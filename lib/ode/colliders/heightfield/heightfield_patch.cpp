#include "ode/colliders/heightfield/heightfield_patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "ode/geom/convert.hpp"

namespace supernormal::ode {
namespace {

constexpr int kMostCells = 512;  // largest number of cells along one axis
constexpr int kPoints = 32;      // number of points along one axis if there is no grid

// Largest distance of a region from the origin, in units of its size. Beyond it, rounding decides where the region is among the
// samples, and the sample number overflows an int.
constexpr double kFarthestRegion = 1e8;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Interval {
  double low, high;
};

// The part of the interval that the field covers. An interval beyond the border is moved to the border.
Interval moved_inside(double low, double high, double half) {
  const double width = std::min(high - low, 2 * half);
  if (std::min(high, half) - std::max(low, -half) > 1e-6 * width) return {std::max(low, -half), std::min(high, half)};
  return low > 0 ? Interval{half - width, half} : Interval{-half, -half + width};
}

Region moved_inside(const Region& region, const HeightfieldProbe& probe) {
  const Interval x = moved_inside(region.x_low, region.x_high, probe.half_width());
  const Interval z = moved_inside(region.z_low, region.z_high, probe.half_depth());
  return {x.low, x.high, z.low, z.high};
}

void require_near(const HeightfieldProbe& probe, const Region& region) {
  if (!probe.is_infinite()) return;
  const double farthest =
      std::max({std::abs(region.x_low), std::abs(region.x_high), std::abs(region.z_low), std::abs(region.z_high)});
  if (farthest < kFarthestRegion * region.reach()) return;
  throw std::domain_error("the body is more than 1e8 times its size from the middle of an infinite dHeightfield");
}

bool has_extent_of(const SampleGrid& grid, const HeightfieldProbe& probe) {
  if (probe.is_infinite()) return grid.x.count == 0;
  return grid.x.count > 0 && grid.x.half == probe.half_width() && grid.z.half == probe.half_depth();
}

// A place in the region that has a surface: its middle, or near the middle of a quarter.
bool find_spot(HeightfieldProbe& probe, const Region& region, Facet& spot) {
  for (const auto& [share_x, share_z] :
       {std::pair(0.5, 0.5), std::pair(0.25, 0.3), std::pair(0.7, 0.25), std::pair(0.3, 0.75), std::pair(0.75, 0.7)}) {
    const double x = region.x_low + share_x * (region.x_high - region.x_low);
    const double z = region.z_low + share_z * (region.z_high - region.z_low);
    if (probe.find_facet(x, z, region.reach(), spot)) return true;
  }
  return false;
}

}  // namespace

double Region::reach() const { return 0.5 * std::max(x_high - x_low, z_high - z_low); }

std::span<const MeshTriangle> HeightfieldPatch::read(HeightfieldProbe& probe, const Region& wanted) {
  require_near(probe, wanted);
  const Region region = moved_inside(wanted, probe);
  const auto known = grids_.find(probe.data());
  if (known == grids_.end() || !has_extent_of(known->second.grid, probe) ||
      !is_shown(probe, known->second.grid, known->second.witness) || !read_grid(probe, known->second.grid, region)) {
    read_anew(probe, region);
  }
  make_triangles();
  return triangles_;
}

void HeightfieldPatch::read_anew(HeightfieldProbe& probe, const Region& region) {
  Facet spot;
  if (find_spot(probe, region, spot)) {
    bool is_plane = false;
    const std::optional<FoundGrid> found = find_grid(probe, spot, 2 * region.reach(), is_plane);
    if (found && read_grid(probe, found->grid, region)) {
      if (found->witness.radius > 0) grids_.insert_or_assign(probe.data(), *found);
      return;
    }
    if (is_plane) {
      read_plane(spot, region);
      return;
    }
  }
  read_points(probe, region, kPoints);
}

// Returns false when the samples are not where the grid says.
bool HeightfieldPatch::read_grid(HeightfieldProbe& probe, const SampleGrid& grid, const Region& region) {
  const std::int64_t i_low = grid.x.cell_of(region.x_low);
  const std::int64_t j_low = grid.z.cell_of(region.z_low);
  const std::int64_t i_high = grid.x.cell_of(region.x_high) + 1;
  const std::int64_t j_high = grid.z.cell_of(region.z_high) + 1;
  if (i_high - i_low > kMostCells || j_high - j_low > kMostCells) {
    read_points(probe, region, kMostCells);
    return true;
  }
  x_.clear();
  z_.clear();
  heights_.clear();
  facets_.clear();
  for (std::int64_t i = i_low; i <= i_high; ++i) x_.push_back(grid.x.at(i));
  for (std::int64_t j = j_low; j <= j_high; ++j) z_.push_back(grid.z.at(j));
  for (std::int64_t i = i_low; i <= i_high; ++i) {
    for (std::int64_t j = j_low; j <= j_high; ++j) {
      Facet& facet = facets_.emplace_back();
      const bool found = find_facet_at_sample(probe, grid, i, j, facet);
      heights_.push_back(found ? facet.height_at(grid.x.at(i), grid.z.at(j)) : kNan);
    }
  }
  return is_consistent();
}

// The plane found near the vertex a of a cell must pass through b and c.
bool HeightfieldPatch::is_consistent() const {
  for (std::size_t i = 0; i + 1 < x_.size(); ++i) {
    for (std::size_t j = 0; j + 1 < z_.size(); ++j) {
      const Facet& facet = facets_[node(i, j)];
      const double a = heights_[node(i, j)];
      const double b = heights_[node(i + 1, j)];
      const double c = heights_[node(i, j + 1)];
      if (!std::isfinite(a + b + c) || facet.x < x_[i] || facet.z < z_[j]) continue;
      const double extent = std::max({a, b, c}) - std::min({a, b, c});
      if (!is_same_height(facet.height_at(x_[i + 1], z_[j]), b, facet, extent)) return false;
      if (!is_same_height(facet.height_at(x_[i], z_[j + 1]), c, facet, extent)) return false;
    }
  }
  return true;
}

void HeightfieldPatch::lay_out(const Region& region, int cells) {
  x_.clear();
  z_.clear();
  for (int k = 0; k <= cells; ++k) {
    const double share = static_cast<double>(k) / cells;
    x_.push_back((1 - share) * region.x_low + share * region.x_high);
    z_.push_back((1 - share) * region.z_low + share * region.z_high);
  }
  heights_.clear();
}

void HeightfieldPatch::read_plane(const Facet& facet, const Region& region) {
  lay_out(region, 1);
  for (const double x : x_) {
    for (const double z : z_) heights_.push_back(facet.height_at(x, z));
  }
}

void HeightfieldPatch::read_points(HeightfieldProbe& probe, const Region& region, int cells) {
  lay_out(region, cells);
  const double limit_x = probe.half_width() * kInside;
  const double limit_z = probe.half_depth() * kInside;
  for (const double x : x_) {
    for (const double z : z_) {
      Facet facet;
      const auto find_beside = [&](double shift) {
        return probe.find_facet(std::clamp(x - shift * limit_x, -limit_x, limit_x),
                                std::clamp(z - shift * limit_z, -limit_z, limit_z), region.reach(), facet);
      };
      // With x87 ODE misses some rays at the edge between two triangles, where it counts neither as hit.
      const bool found = find_beside(0) || find_beside(kBorder);
      heights_.push_back(found ? facet.height_at(x, z) : kNan);
    }
  }
}

void HeightfieldPatch::make_triangles() {
  triangles_.clear();
  for (std::size_t i = 0; i + 1 < x_.size(); ++i) {
    for (std::size_t j = 0; j + 1 < z_.size(); ++j) {
      const Vector3 a{x_[i], heights_[node(i, j)], z_[j]};
      const Vector3 b{x_[i + 1], heights_[node(i + 1, j)], z_[j]};
      const Vector3 c{x_[i], heights_[node(i, j + 1)], z_[j + 1]};
      const Vector3 d{x_[i + 1], heights_[node(i + 1, j + 1)], z_[j + 1]};
      add_triangle(a, c, b);
      add_triangle(d, b, c);
    }
  }
}

void HeightfieldPatch::add_triangle(const Vector3& p1, const Vector3& p2, const Vector3& p3) {
  if (!std::isfinite(p1.y() + p2.y() + p3.y())) return;
  const double highest = std::max({std::abs(p1.y()), std::abs(p2.y()), std::abs(p3.y())});
  // Samples may be floats. ODE does not tell.
  triangles_.push_back({{p1, p2, p3}, static_cast<int>(triangles_.size()), kFloatRounding * highest});
}

}  // namespace supernormal::ode
