#include "drawing/bounds_panel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <supernormal/proximity/gap_function.hpp>

#include "drawing/colours.hpp"
#include "drawing/path_layer.hpp"

namespace explain_pair {
namespace {

using supernormal::Solver;

constexpr double kLeft = 62, kBottom = 36;  // px, for the axis labels
constexpr int kDecadeLabels = 3;            // at most, above and below

/// Logarithmic axes for distances from the result: powers of ten from `least` up and down, with 0 in the middle.
struct Axes {
  Box box;
  double evaluations;  // at the right end
  int least;           // exponent
  double most;

  double x(double evaluation) const { return box.x + (evaluation - 0.5) / evaluations * box.width; }
  double y(double length) const {
    const double size = std::abs(length);
    const double decades = size > 0 ? std::max(std::log10(size) - least, 0.0) : 0;
    return box.centre().y() - std::copysign(decades / (most - least), length) * 0.5 * box.height;
  }
};

Axes axes_of(const Box& box, const Explanation& explanation) {
  const SolverPath& hybrid = explanation.hybrid();
  const double answer = hybrid.answer.gap, evaluations = static_cast<double>(explanation.shown_evaluations());
  double widest = 0;
  for (const ProvedInterval& interval : hybrid.intervals) widest = std::max(widest, interval.upper - answer);
  for (const SolverPath& path : explanation.paths) {
    const std::size_t count = explanation.shown_evaluations(path);
    for (std::size_t k = 0; k < count; ++k) widest = std::max(widest, std::abs(path.evaluations[k].s - answer));
  }
  const double last = std::max(hybrid.intervals.back().upper - answer, std::numeric_limits<double>::min());
  const int least = static_cast<int>(std::floor(std::log10(last))) - 1;
  // Half a decade of margin for the markers.
  const double most = std::max(std::log10(std::max(widest, last)) + 0.5, least + 2.0);
  return {{box.x + kLeft, box.y, box.width - kLeft, box.height - kBottom}, evaluations, least, most};
}

void draw_axes(Svg& svg, const Axes& axes) {
  const Box& box = axes.box;
  const int most = static_cast<int>(std::floor(axes.most));
  const int every = std::max(1, (most - axes.least + kDecadeLabels - 1) / kDecadeLabels);
  for (int exponent = most; exponent > axes.least; exponent -= every) {
    for (const double sign : {1.0, -1.0}) {
      const double y = axes.y(sign * std::pow(10, exponent));
      svg.line({box.x, y}, {box.right(), y}, R"(stroke="#ddd" stroke-width="1")");
      svg.text({box.x - 6, y + 4}, (sign > 0 ? "+1e" : "−1e") + std::to_string(exponent) + " m",
               R"(text-anchor="end" font-size="12")");
    }
  }
  svg.text({box.x - 6, box.centre().y() + 4}, "answer", R"(text-anchor="end" font-size="12")");
  const int step = std::max(1, static_cast<int>(std::ceil(axes.evaluations / 8)));
  for (int k = step == 1 ? 1 : step; k <= axes.evaluations; k += step)
    svg.text({axes.x(k), box.bottom() + 16}, std::to_string(k), R"(text-anchor="middle" font-size="12")");
  svg.text({box.centre().x(), box.bottom() + 33}, "evaluations of s", R"(text-anchor="middle" font-size="13")");
}

/// The area between the bounds, as steps.
void draw_interval(Svg& svg, const Axes& axes, const SolverPath& path) {
  Polyline upper, lower;
  const double answer = path.answer.gap;
  for (std::size_t k = 0; k < path.intervals.size(); ++k) {
    const ProvedInterval& interval = path.intervals[k];
    const bool is_last = k + 1 == path.intervals.size();
    const double left = axes.x(interval.evaluations - 0.5);
    const double right = is_last ? axes.x(interval.evaluations + 0.5) : axes.x(path.intervals[k + 1].evaluations - 0.5);
    for (const double x : {left, right}) {
      upper.emplace_back(x, axes.y(interval.upper - answer));
      lower.emplace_back(x, axes.y(std::min(interval.lower - answer, 0.0)));
    }
  }
  Polyline area = upper;
  area.insert(area.end(), lower.rbegin(), lower.rend());
  svg.polygon(area, R"(fill="#000" fill-opacity="0.13")");
  svg.polyline(upper, R"(stroke="#000" stroke-width="1.8")");
  svg.polyline(lower, R"(stroke="#000" stroke-width="1.8")");
}

void draw_values(Svg& svg, const Axes& axes, const SolverPath& path, const Explanation& explanation) {
  const PathStyle style = style_of(path);
  const double answer = explanation.answer().gap;
  Polyline line;
  for (std::size_t k = 0; k < explanation.shown_evaluations(path); ++k) {
    line.emplace_back(axes.x(static_cast<double>(k + 1)), axes.y(path.evaluations[k].s - answer));
  }
  svg.polyline(line, std::string("stroke=\"") + style.colour + R"(" stroke-width="1.6" stroke-dasharray=")" + style.dashes + '"');
  for (const Vector2& point : line) draw_marker(svg, point, style, line.size() > 40 ? 1.6 : 3);
}

}  // namespace

void draw_bounds(Svg& svg, const Box& box, const Explanation& explanation) {
  const Axes axes = axes_of(box, explanation);
  svg.rect(axes.box, R"(fill="#fff" stroke="none")");
  draw_axes(svg, axes);
  svg.line({axes.box.x, axes.box.centre().y()}, {axes.box.right(), axes.box.centre().y()}, R"(stroke="#555" stroke-width="1")");
  draw_interval(svg, axes, explanation.hybrid());
  for (auto path = explanation.paths.rbegin(); path != explanation.paths.rend(); ++path) draw_values(svg, axes, *path, explanation);
  svg.rect(axes.box, R"(fill="none" stroke="#222" stroke-width="1.4")");
}

}  // namespace explain_pair
