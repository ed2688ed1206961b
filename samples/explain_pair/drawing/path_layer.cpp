#include "drawing/path_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "drawing/colours.hpp"

namespace explain_pair {
namespace {

using supernormal::Solver;

constexpr double kStep = 2 * kDegree;        // of an arc on the map
constexpr double kMarkersApart = 7;          // px; a marker closer than this to another is omitted
constexpr std::size_t kFewEvaluations = 20;  // a longer path is drawn finely, without outlined markers
constexpr std::size_t kNumbered = 9;

/// The great circle between two normals, split where it leaves the map on one side and returns on the other.
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

/// The arcs between successive evaluations. A cycle of a solver is drawn once.
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
  for (Polyline& line : lines) line = simplified(line, kMapLineError);
  return lines;
}

/// Marks evaluations, and numbers the first ones where there is space.
void draw_evaluations(Svg& svg, const SolverPath& path, std::size_t count, const MapInPicture& map, double size, bool has_numbers) {
  Polyline marked, numbered;
  const auto is_clear = [](const Polyline& others, const Vector2& at, double distance) {
    return std::ranges::all_of(others, [&](const Vector2& other) { return (other - at).norm() >= distance; });
  };
  for (std::size_t k = 0; k < count; ++k) {
    const Vector2 at = map.to_px(path.evaluations[k].n);
    if (!is_clear(marked, at, kMarkersApart)) continue;
    marked.push_back(at);
    draw_marker(svg, at, style_of(path), size);
    if (!has_numbers || k >= kNumbered || !is_clear(numbered, at, kNumbersApart)) continue;
    numbered.push_back(at);
    svg.text(at + Vector2(-6, -6), std::to_string(k + 1),
             R"(text-anchor="end" font-size="12" stroke="#fff" stroke-width="3" stroke-opacity="0.8" paint-order="stroke")");
  }
}

void draw_path(Svg& svg, const SolverPath& path, std::size_t count, const MapInPicture& map, double size, bool has_numbers) {
  const PathStyle style = style_of(path);
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

}  // namespace

PathStyle style_of(const SolverPath& path) {
  using enum PathStyle::Marker;
  if (path.solver == Solver::Hybrid) return {kBlack, "none", Circle};
  if (path.solver == Solver::Newton) return {kVermilion, "7 3", Triangle};
  if (path.solver == Solver::FixedPoint) return {kPurple, "2 3", Square};
  // The literature methods have their numbers in their names. Each number has a colour; dashes distinguish the variants.
  if (path.name.ends_with("(1)")) return {kBlue, path.name.find("quadtree") == std::string::npos ? "none" : "2 4", Diamond};
  if (path.name.ends_with("(2)"))
    return {kGreen,
            path.name.starts_with("normal")                   ? "5 4"
            : path.name.find("quadtree") == std::string::npos ? "none"
                                                              : "2 4",
            Diamond};
  if (path.name.ends_with("(3)")) return {kOrange, "none", Diamond};
  return {kBrown, path.name.ends_with("fixed point (4)") ? "none" : path.name.ends_with("distance (4)") ? "5 4" : "2 4", Diamond};
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
    case PathStyle::Marker::Diamond:
      svg.polygon(
          {at + size * Vector2(0, -1.3), at + size * Vector2(1.3, 0), at + size * Vector2(0, 1.3), at + size * Vector2(-1.3, 0)},
          look);
      break;
  }
}

void draw_ring(Svg& svg, const Vector2& at) {
  svg.circle(at, 7.5, R"(fill="none" stroke="#fff" stroke-width="3.5")");
  svg.circle(at, 7.5, R"(fill="none" stroke="#000" stroke-width="1.6")");
}

void draw_paths(Svg& svg, const Explanation& explanation, const MapInPicture& map, double size, bool has_numbers) {
  // The hybrid is drawn last, on top.
  for (auto path = explanation.paths.rbegin(); path != explanation.paths.rend(); ++path) {
    draw_path(svg, *path, explanation.shown_evaluations(*path), map, size, has_numbers && path->solver == Solver::Hybrid);
  }
  draw_ring(svg, map.to_px(explanation.answer().normal));
}

}  // namespace explain_pair
