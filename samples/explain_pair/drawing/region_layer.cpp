#include "drawing/region_layer.hpp"

#include <algorithm>
#include <string>

namespace explain_pair {
namespace {

constexpr double kSmallestRegion = 24;  // px; a smaller remaining region is not drawn
constexpr std::size_t kMostRegions = 4;

/// Some numbers of evaluations, up to all of them, for which to draw the remaining region.
std::vector<std::size_t> regions_of(const SolverPath& path) {
  const std::size_t all = path.evaluations.size();
  std::vector<std::size_t> counts;
  if (all <= kMostRegions) {
    for (std::size_t k = 1; k <= all; ++k) counts.push_back(k);
  } else if (all <= 2 * kMostRegions) {
    counts = {1, 2, 3, all};
  } else {
    counts = {1, all / 9 + 1, all / 3 + 1, all};
  }
  return counts;
}

/// The position of the number of a region's border: its highest point on the map away from other numbers.
const Vector2* place_of_number(const std::vector<Polyline>& lines, const Polyline& others, const MapInPicture& map) {
  const Vector2* best = nullptr;
  for (const Polyline& line : lines) {
    for (const Vector2& point : line) {
      const auto is_near = [&](const Vector2& other) { return (other - point).norm() < kNumbersApart; };
      const bool is_free = map.inside.contains(point) && std::ranges::none_of(others, is_near);
      if (is_free && (best == nullptr || point.y() < best->y())) best = &point;
    }
  }
  return best;
}

double size_of(const std::vector<Polyline>& lines) {
  Eigen::AlignedBox2d extent;
  for (const Polyline& line : lines) {
    for (const Vector2& point : line) extent.extend(point);
  }
  return extent.isEmpty() ? 0 : extent.sizes().maxCoeff();
}

}  // namespace

void draw_number(Svg& svg, const Vector2& at, const std::string& number) {
  svg.circle(at, number.size() > 2 ? 11 : 8, R"(fill="#fff" stroke="#000" stroke-width="0.8")");
  svg.text(at + Vector2(0, 4), number, R"(text-anchor="middle" font-size="11")");
}

void draw_regions(Svg& svg, const Explanation& explanation, const MapInPicture& map, Polyline occupied) {
  const SolverPath& path = explanation.hybrid();
  const double rolling_radius = explanation.pair.body1.shape->rolling_radius() + explanation.pair.body2.shape->rolling_radius();
  const auto excluded = [&](std::size_t evaluations) {
    return grid_of(map, [&](const Vector3& n) { return -room_left(path, evaluations, rolling_radius, n); });
  };
  struct Region {
    std::size_t evaluations;
    std::vector<Polyline> outside, border;
  };
  std::vector<Region> regions;
  for (const std::size_t evaluations : regions_of(path)) {
    const Grid grid = excluded(evaluations);
    const std::vector<Polyline> outside = superlevel_polygons(grid, 0);
    const std::vector<Polyline> border = in_picture(without_border(outside, grid), map);
    if (size_of(border) < kSmallestRegion) break;
    regions.push_back({evaluations, in_picture(outside, map), border});
  }
  if (regions.empty()) return;
  svg.polygons(regions.back().outside, R"(fill="#000" fill-opacity="0.13")");
  for (const Region& region : regions) {
    for (const Polyline& line : region.border) {
      svg.polyline(line, R"(stroke="#fff" stroke-opacity="0.6" stroke-width="2.6")");
      svg.polyline(line, kRegionStyle);
    }
  }
  for (const Region& region : regions) {
    const Vector2* const place = place_of_number(region.border, occupied, map);
    if (place == nullptr) continue;
    draw_number(svg, *place, std::to_string(region.evaluations));
    occupied.push_back(*place);
  }
}

}  // namespace explain_pair
