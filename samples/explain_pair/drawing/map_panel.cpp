#include "drawing/map_panel.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>
#include <vector>

#include "drawing/colours.hpp"
#include "drawing/lengths.hpp"
#include "method/contours.hpp"

namespace explain_pair {
namespace {

using supernormal::Solver;

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;

constexpr std::size_t kSphereColumns = 181, kSphereRows = 91;  // 2 degrees
constexpr std::size_t kCloseUpNodes = 97;
constexpr int kBands = 18, kCloseUpBands = 10;
constexpr double kPixelError = 0.12;
constexpr double kStep = 2 * kDegree;        // of an arc on the map
constexpr double kMarkersApart = 7;          // px; markers that are nearer to the one before are left out
constexpr double kNumbersApart = 20;         // px; the same for their numbers
constexpr double kSmallestRegion = 24;       // px; what the cuts leave is not drawn if it is smaller
constexpr std::size_t kFewEvaluations = 20;  // a longer path is drawn finely, without a rim
constexpr std::size_t kNumbered = 9;
constexpr std::size_t kMostRegions = 4;  // of what the cuts leave

/// A map into the picture: where normals are, and the normal at each node of a grid.
struct MapInPicture {
  std::size_t columns, rows;
  std::function<Vector2(const Vector2& node)> node_to_px;
  std::function<Vector3(double column, double row)> normal;
  std::function<Vector2(const Vector3& normal)> to_px;
  Eigen::AlignedBox2d inside;  // px; where numbers have room
  double longest_piece;        // px; two points of an arc that are farther apart are on two sides of the map
};

std::vector<Polyline> in_picture(std::vector<Polyline> lines, const MapInPicture& map) {
  for (Polyline& line : lines) {
    for (Vector2& point : line) point = map.node_to_px(point);
    line = simplified(line, kPixelError);
  }
  return lines;
}

Grid grid_of(const MapInPicture& map, const std::function<double(const Vector3&)>& value) {
  Grid grid(map.columns, map.rows);
  grid.fill([&](double column, double row) { return value(map.normal(column, row)); });
  return grid;
}

/// Levels at multiples of a round step.
struct Levels {
  double step, first;
  int count;

  Levels(const Grid& grid, int parts) : step(round_step(grid.most() - grid.least(), parts)) {
    first = std::ceil(grid.least() / step) * step;
    count = 1 + static_cast<int>(std::floor((grid.most() - first) / step));
  }
  double operator[](int k) const { return first + k * step; }
  std::string colour(int bands_above_lowest) const { return hex(map_colour(static_cast<double>(bands_above_lowest) / count)); }
};

void draw_bands(Svg& svg, const Grid& grid, const Levels& levels, const MapInPicture& map) {
  for (int k = 0; k < levels.count; ++k) {
    svg.polygons(in_picture(superlevel_polygons(grid, levels[k]), map),
                 "fill=\"" + levels.colour(k + 1) + R"(" stroke="#234" stroke-opacity="0.3" stroke-width="0.6")");
  }
}

/// The line between the normals that prove the bodies apart and those that do not.
void draw_zero(Svg& svg, const Grid& grid, const MapInPicture& map) {
  for (const Polyline& line : in_picture(without_border(superlevel_polygons(grid, 0), grid), map)) {
    svg.polyline(line, kZeroStyle);
  }
}

/// Some numbers of evaluations, up to all, for which to draw what is left.
std::vector<std::size_t> regions_of(const SolverPath& path) {
  const std::size_t all = path.evaluations.size();
  std::vector<std::size_t> counts;
  if (all <= kMostRegions) {
    for (std::size_t k = 1; k <= all; ++k) counts.push_back(k);
  } else if (all <= 2 * kMostRegions) {
    counts = {1, 2, 3, 4};
  } else {
    counts = {1, all / 9 + 1, all / 3 + 1, all};
  }
  return counts;
}

/// Where the number of a region's border stands: at its highest point that is on the map and away from other numbers.
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

/// `occupied`: places that keep free of numbers.
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

/// The great circle between two normals, in pieces where it leaves the map on one side and comes back on the other.
std::vector<Polyline> arc(const Vector3& from, const Vector3& to, const MapInPicture& map) {
  const double angle = 2 * std::asin(std::min(0.5 * (to - from).norm(), 1.0));
  const int pieces = 1 + static_cast<int>(angle / kStep);
  std::vector<Polyline> lines(1, {map.to_px(from)});
  for (int k = 1; k <= pieces; ++k) {
    const double share = static_cast<double>(k) / pieces;
    const Vector3 between = angle > kDegree ? Vector3(std::sin((1 - share) * angle) * from + std::sin(share * angle) * to)
                                            : Vector3((1 - share) * from + share * to);
    const Vector2 point = k == pieces ? map.to_px(to) : map.to_px(between.normalized());
    if ((point - lines.back().back()).norm() > map.longest_piece) lines.emplace_back();
    lines.back().push_back(point);
  }
  return lines;
}

/// The arcs between successive evaluations. A solver that goes in circles is drawn once.
std::vector<Polyline> lines_of(const SolverPath& path, std::size_t count, const MapInPicture& map) {
  std::vector<Polyline> lines(1, {map.to_px(path.evaluations.front().n)});
  std::set<std::array<long, 4>> drawn;
  for (std::size_t k = 0; k + 1 < count; ++k) {
    const Vector3 &from = path.evaluations[k].n, &to = path.evaluations[k + 1].n;
    const Vector2 start = map.to_px(from), end = map.to_px(to);
    if (!drawn.insert({std::lround(start.x()), std::lround(start.y()), std::lround(end.x()), std::lround(end.y())}).second) {
      lines.push_back({end});
      continue;
    }
    const std::vector<Polyline> pieces = arc(from, to, map);
    lines.back().insert(lines.back().end(), pieces.front().begin() + 1, pieces.front().end());
    lines.insert(lines.end(), pieces.begin() + 1, pieces.end());
  }
  for (Polyline& line : lines) line = simplified(line, kPixelError);
  return lines;
}

/// Marks evaluations, and numbers the first of them, where there is room.
void draw_evaluations(Svg& svg, const SolverPath& path, std::size_t count, const MapInPicture& map, double size, bool has_numbers) {
  Polyline marked, numbered;
  const auto is_clear = [](const Polyline& others, const Vector2& at, double distance) {
    return std::ranges::all_of(others, [&](const Vector2& other) { return (other - at).norm() >= distance; });
  };
  for (std::size_t k = 0; k < count; ++k) {
    const Vector2 at = map.to_px(path.evaluations[k].n);
    if (!is_clear(marked, at, kMarkersApart)) continue;
    marked.push_back(at);
    draw_marker(svg, at, style_of(path.solver), size);
    if (!has_numbers || k >= kNumbered || !is_clear(numbered, at, kNumbersApart)) continue;
    numbered.push_back(at);
    svg.text(at + Vector2(-6, -6), std::to_string(k + 1),
             R"(text-anchor="end" font-size="12" stroke="#fff" stroke-width="3" stroke-opacity="0.8" paint-order="stroke")");
  }
}

void draw_path(Svg& svg, const SolverPath& path, std::size_t count, const MapInPicture& map, double size, bool has_numbers) {
  const PathStyle& style = style_of(path.solver);
  const bool is_short = count <= kFewEvaluations;
  const std::vector<Polyline> lines = lines_of(path, count, map);
  const auto draw = [&](const std::string& look) {
    svg.begin_group(look);
    for (const Polyline& line : lines) svg.polyline(line, "");
    svg.end_group();
  };
  if (is_short) draw(R"(stroke="#fff" stroke-opacity="0.6" stroke-width="3.6")");
  draw(std::string("stroke=\"") + style.colour + R"(" stroke-width=")" + (is_short ? "1.8" : "0.7") + R"(" stroke-dasharray=")" +
       style.dashes + '"');
  draw_evaluations(svg, path, count, map, is_short ? size : 0.7 * size, has_numbers);
}

void draw_paths(Svg& svg, const Explanation& explanation, const MapInPicture& map, double size, bool has_numbers) {
  // The hybrid on top.
  for (auto path = explanation.paths.rbegin(); path != explanation.paths.rend(); ++path) {
    draw_path(svg, *path, explanation.shown_evaluations(*path), map, size, has_numbers && path->solver == Solver::Hybrid);
  }
  draw_ring(svg, map.to_px(explanation.answer().normal));
}

void draw_graticule(Svg& svg, const Frame& frame, const MapInPicture& map) {
  const auto draw = [&](const std::function<Place(double)>& place, double end) {
    Polyline line;
    for (double t = -end; t <= end + 0.5 * kStep; t += kStep) line.push_back(map.to_px(normal_at(frame, place(std::min(t, end)))));
    svg.polyline(simplified(line, kPixelError), R"(stroke="#234" stroke-opacity="0.25" stroke-width="0.7")");
  };
  for (int k = -2; k <= 2; ++k) {
    draw([k](double t) { return Place{t, k * 30 * kDegree}; }, kPi - 1e-9);
    draw([k](double t) { return Place{k * 60 * kDegree, t}; }, kPi / 2);
  }
}

Polyline world_axes(const MapInPicture& map) {
  Polyline places;
  for (const int axis : {0, 1, 2}) {
    for (const double sign : {1.0, -1.0}) places.push_back(map.to_px(sign * Vector3::Unit(axis)));
  }
  return places;
}

/// Crosses, with letters beside them towards the middle.
void draw_world_axes(Svg& svg, const Polyline& places, const Vector2& middle) {
  constexpr std::array kNames = {"+x", "−x", "+y", "−y", "+z", "−z"};
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    const Vector2& at = places[k];
    svg.line(at - Vector2(3.5, 0), at + Vector2(3.5, 0), R"(stroke="#222" stroke-width="1.2")");
    svg.line(at - Vector2(0, 3.5), at + Vector2(0, 3.5), R"(stroke="#222" stroke-width="1.2")");
    const bool is_right = at.x() > middle.x(), is_low = at.y() > middle.y();
    svg.text(at + Vector2(is_right ? -6 : 6, is_low ? -5 : 13), kNames[k],
             std::string(is_right ? R"(text-anchor="end" )" : "") +
                 R"(font-size="12" stroke="#fff" stroke-width="2.5" stroke-opacity="0.7" paint-order="stroke")");
  }
}

/// The colours of the bands with every other level below.
void draw_colour_bar(Svg& svg, const Box& box, const Levels& levels) {
  const double width = box.width / (levels.count + 1);
  for (int k = 0; k <= levels.count; ++k) {
    svg.rect({box.x + k * width, box.y, width, box.height}, "fill=\"" + levels.colour(k) + R"(" stroke="#234" stroke-width="0.5")");
  }
  const int labels = 6;
  const int every = std::max(1, static_cast<int>(round_step(levels.count, labels)));
  for (int k = 0; k < levels.count; ++k) {
    const bool is_labelled = std::lround(levels[k] / levels.step) % every == 0;
    const double x = box.x + (k + 1) * width;
    if (!is_labelled) continue;
    svg.line({x, box.bottom()}, {x, box.bottom() + 4}, R"(stroke="#234" stroke-width="1")");
    const bool is_zero = std::abs(levels[k]) < 0.5 * levels.step;
    svg.text({x, box.bottom() + 17}, is_zero ? "0" : length_text(levels[k]), R"(text-anchor="middle" font-size="12")");
  }
}

Eigen::AlignedBox2d room_in(const Box& box) {
  const Vector2 margin(12, 12);
  return {Vector2(box.x, box.y) + margin, Vector2(box.right(), box.bottom()) - margin};
}

MapInPicture hammer_in(const Box& box, const Frame& frame) {
  const double scale = std::min(0.5 * box.width / HammerMap::kHalfWidth, 0.5 * box.height / HammerMap::kHalfHeight);
  const Vector2 centre = box.centre();
  const auto to_px = [scale, centre](const Place& place) {
    const Vector2 point = HammerMap::to_plane(place);
    return Vector2(centre + scale * Vector2(point.x(), -point.y()));
  };
  const auto place = [](double column, double row) {
    return Place{kPi * (2 * column / (kSphereColumns - 1) - 1), kPi * (row / (kSphereRows - 1) - 0.5)};
  };
  return {kSphereColumns,
          kSphereRows,
          [=](const Vector2& node) { return to_px(place(node.x(), node.y())); },
          [=](double column, double row) { return normal_at(frame, place(column, row)); },
          [=](const Vector3& normal) { return to_px(place_of(frame, normal)); },
          room_in(box),
          0.3 * box.width};
}

MapInPicture lambert_in(const Box& box, const Frame& frame, double half_angle) {
  const double reach = 2 * std::sin(half_angle / 2);
  const double scale = 0.5 * std::min(box.width, box.height) / reach;
  const Vector2 centre = box.centre();
  const auto point = [reach](double column, double row) {
    return Vector2(reach * Vector2(2 * column / (kCloseUpNodes - 1) - 1, 2 * row / (kCloseUpNodes - 1) - 1));
  };
  const auto to_px = [scale, centre](const Vector2& p) { return Vector2(centre + scale * Vector2(p.x(), -p.y())); };
  return {kCloseUpNodes,
          kCloseUpNodes,
          [=](const Vector2& node) { return to_px(point(node.x(), node.y())); },
          [=](double column, double row) { return LambertMap::to_sphere(frame, point(column, row)); },
          [=](const Vector3& normal) { return to_px(LambertMap::to_plane(frame, normal)); },
          room_in(box),
          std::numeric_limits<double>::infinity()};
}

}  // namespace

const PathStyle& style_of(Solver solver) {
  static const PathStyle hybrid{"hybrid", kBlack, "none", PathStyle::Marker::Circle};
  static const PathStyle newton{"Newton (I)", kVermilion, "7 3", PathStyle::Marker::Triangle};
  static const PathStyle fixed_point{"fixed point (II)", kPurple, "2 3", PathStyle::Marker::Square};
  return solver == Solver::Hybrid ? hybrid : solver == Solver::Newton ? newton : fixed_point;
}

void draw_ring(Svg& svg, const Vector2& at) {
  svg.circle(at, 7.5, R"(fill="none" stroke="#fff" stroke-width="3.5")");
  svg.circle(at, 7.5, R"(fill="none" stroke="#000" stroke-width="1.6")");
}

void draw_number(Svg& svg, const Vector2& at, const std::string& number) {
  svg.circle(at, number.size() > 2 ? 11 : 8, R"(fill="#fff" stroke="#000" stroke-width="0.8")");
  svg.text(at + Vector2(0, 4), number, R"(text-anchor="middle" font-size="11")");
}

void draw_marker(Svg& svg, const Vector2& at, const PathStyle& style, double size) {
  const std::string look = std::string("fill=\"") + style.colour + R"(" stroke="#fff" stroke-width="1")";
  switch (style.marker) {
    case PathStyle::Marker::Circle:
      svg.circle(at, size, look);
      break;
    case PathStyle::Marker::Triangle:
      svg.polygon({at + size * Vector2(0, -1.4), at + size * Vector2(1.25, 0.9), at + size * Vector2(-1.25, 0.9)}, look);
      break;
    case PathStyle::Marker::Square:
      svg.rect({at.x() - size, at.y() - size, 2 * size, 2 * size}, look);
      break;
  }
}

void draw_sphere(Svg& svg, const Box& box, const Explanation& explanation, const Frame& frame, double close_up) {
  constexpr double kBar = 40;  // px, for the bar and its labels
  const Box inner{box.x, box.y, box.width, box.height - kBar};
  const MapInPicture map = hammer_in(inner, frame);
  WorldGap gap(explanation.pair);
  const Grid s = grid_of(map, [&](const Vector3& n) { return gap.s(n); });
  const Levels levels(s, kBands);
  const Vector2 centre = inner.centre();
  const double half_width = std::min(inner.width, 2 * inner.height) / 2;
  svg.ellipse(centre, half_width, half_width / 2, "fill=\"" + levels.colour(0) + '"');
  draw_bands(svg, s, levels, map);
  draw_zero(svg, s, map);
  draw_graticule(svg, frame, map);
  const Polyline axes = world_axes(map);
  draw_regions(svg, explanation, map, axes);
  const double reach = 2 * std::sin(close_up / 2);
  Polyline window;
  for (int side = 0; side < 4; ++side) {
    for (int k = 0; k < 12; ++k) {
      const double along = reach * (k / 6.0 - 1);
      const std::array<Vector2, 4> points = {Vector2(along, -reach), Vector2(reach, along), Vector2(-along, reach),
                                             Vector2(-reach, -along)};
      window.push_back(map.to_px(LambertMap::to_sphere(frame, points[static_cast<std::size_t>(side)])));
    }
  }
  svg.polygon(window, R"(fill="none" stroke="#222" stroke-width="1")");
  draw_world_axes(svg, axes, centre);
  draw_paths(svg, explanation, map, 3.4, false);
  svg.ellipse(centre, half_width, half_width / 2, R"(fill="none" stroke="#222" stroke-width="1.4")");
  draw_colour_bar(svg, {centre.x() - half_width, box.bottom() - kBar + 12, 2 * half_width, 10}, levels);
}

void draw_close_up(Svg& svg, const Box& box, const Explanation& explanation, const Frame& frame, double half_angle) {
  const MapInPicture map = lambert_in(box, frame, half_angle);
  WorldGap gap(explanation.pair);
  const Grid s = grid_of(map, [&](const Vector3& n) { return gap.s(n); });
  svg.begin_clipped(box);
  if (s.most() > s.least()) {
    const Levels levels(s, kCloseUpBands);
    svg.rect(box, "fill=\"" + levels.colour(0) + '"');
    draw_bands(svg, s, levels, map);
    draw_zero(svg, s, map);
  }
  draw_regions(svg, explanation, map, {});
  draw_paths(svg, explanation, map, 4, true);
  svg.end_group();
  svg.rect(box, R"(fill="none" stroke="#222" stroke-width="1.4")");
}

double close_up_angle(const Explanation& explanation) {
  constexpr double kNone = 1e-6, kLeast = 0.2 * kDegree, kMost = 40 * kDegree, kMargin = 1.4;
  const Vector3& answer = explanation.answer().normal;
  double angle = 0;
  for (const SolverPath& path : explanation.paths) {
    if (path.evaluations.size() < 2) continue;
    angle = std::max(angle, 2 * std::asin(std::min(0.5 * (path.evaluations[1].n - answer).norm(), 1.0)));
  }
  return angle < kNone ? kMost : std::clamp(kMargin * angle, kLeast, kMost);
}

}  // namespace explain_pair
