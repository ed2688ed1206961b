#include "drawing/map_panel.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "drawing/colours.hpp"
#include "drawing/lengths.hpp"
#include "drawing/map_in_picture.hpp"
#include "drawing/path_layer.hpp"
#include "drawing/region_layer.hpp"
#include "method/contours.hpp"

namespace explain_pair {
namespace {

constexpr int kBands = 18, kCloseUpBands = 10;
constexpr double kOnMap = 1 - 1e-9;  // of half of the map, so that the end of a parallel stays on its side

/// Levels at multiples of a round step.
struct Levels {
  double step, first;
  int count;

  Levels(const Grid& grid, int parts) : step(round_step(std::max(grid.most() - grid.least(), rounding_of(grid)), parts)) {
    first = std::ceil(grid.least() / step) * step;
    count = std::max(1 + static_cast<int>(std::floor((grid.most() - first) / step)), 1);
  }
  double operator[](int k) const { return first + k * step; }
  /// The variation of a constant function by rounding deserves no band.
  static double rounding_of(const Grid& grid) { return 1e-12 * std::max(std::abs(grid.least()), std::abs(grid.most())); }
  std::string colour(int bands_above_lowest) const { return hex(map_colour(static_cast<double>(bands_above_lowest) / count)); }
};

void draw_bands(Svg& svg, const Grid& grid, const Levels& levels, const MapInPicture& map) {
  for (int k = 0; k < levels.count; ++k) {
    svg.polygons(in_picture(superlevel_polygons(grid, levels[k]), map),
                 "fill=\"" + levels.colour(k + 1) + R"(" stroke="#234" stroke-opacity="0.3" stroke-width="0.6")");
  }
}

/// The border between the normals that prove the bodies apart and all others.
void draw_zero(Svg& svg, const Grid& grid, const MapInPicture& map) {
  for (const Polyline& line : in_picture(without_border(superlevel_polygons(grid, 0), grid), map)) {
    svg.polyline(line, kZeroStyle);
  }
}

/// Parallels and meridians of the map.
void draw_graticule(Svg& svg, const Frame& frame, const MapInPicture& map) {
  constexpr int kPieces = 90;
  const auto draw = [&](const std::function<Place(double share)>& place) {
    Polyline line;
    for (int k = 0; k <= kPieces; ++k) {
      const double share = 2.0 * k / kPieces - 1;
      line.push_back(map.to_px(normal_at(frame, place(kOnMap * share))));
    }
    svg.polyline(simplified(line, kMapLineError), R"(stroke="#234" stroke-opacity="0.25" stroke-width="0.7")");
  };
  for (int k = -2; k <= 2; ++k) {
    draw([k](double share) { return Place{share * std::numbers::pi, k * 30 * kDegree}; });
    draw([k](double share) { return Place{k * 60 * kDegree, share * std::numbers::pi / 2}; });
  }
}

Polyline world_axes(const MapInPicture& map) {
  Polyline places;
  for (const int axis : {0, 1, 2}) {
    for (const double sign : {1.0, -1.0}) places.push_back(map.to_px(sign * Vector3::Unit(axis)));
  }
  return places;
}

/// Crosses, with labels towards the middle.
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

/// The border of Lambert's map of the normals within this angle, on another map.
Polyline window_of(double half_angle, const Frame& frame, const MapInPicture& map) {
  constexpr int kPieces = 12;  // per side
  const double reach = 2 * std::sin(half_angle / 2);
  Polyline window;
  for (std::size_t side = 0; side < 4; ++side) {
    for (int k = 0; k < kPieces; ++k) {
      const double along = reach * (2.0 * k / kPieces - 1);
      const std::array<Vector2, 4> points = {Vector2(along, -reach), Vector2(reach, along), Vector2(-along, reach),
                                             Vector2(-reach, -along)};
      window.push_back(map.to_px(LambertMap::to_sphere(frame, points[side])));
    }
  }
  return window;
}

/// The colours of the bands, with every other level below.
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

}  // namespace

void draw_sphere(Svg& svg, const Box& box, const Explanation& explanation, const Frame& frame, double close_up) {
  constexpr double kBar = 40;  // px, of the bar with its labels
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
  svg.polygon(window_of(close_up, frame, map), R"(fill="none" stroke="#222" stroke-width="1")");
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
  const Levels levels(s, kCloseUpBands);
  svg.rect(box, "fill=\"" + levels.colour(0) + '"');
  draw_bands(svg, s, levels, map);
  draw_zero(svg, s, map);
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
    if (!path.solver || path.evaluations.size() < 2) continue;
    angle = std::max(angle, 2 * std::asin(std::min(0.5 * (path.evaluations[1].n - answer).norm(), 1.0)));
  }
  return angle < kNone ? kMost : std::clamp(kMargin * angle, kLeast, kMost);
}

}  // namespace explain_pair
