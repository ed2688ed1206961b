#include "drawing/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "drawing/bounds_panel.hpp"
#include "drawing/colours.hpp"
#include "drawing/lengths.hpp"
#include "drawing/map_panel.hpp"
#include "drawing/pair_panel.hpp"
#include "drawing/path_layer.hpp"
#include "drawing/region_layer.hpp"
#include "drawing/svg.hpp"
#include "drawing/view.hpp"

namespace explain_pair {
namespace {

using supernormal::Proximity;
using supernormal::Solver;
using supernormal::Status;

// px
constexpr double kWidth = 1200, kHeight = 800;
constexpr Box kPairBox{16, 84, 548, 440};
constexpr Box kTableBox{16, 548, 548, 84};
constexpr Box kLegendBox{16, 648, 380, 136};
constexpr Box kSphereBox{596, 64, 588, 350};
constexpr Box kCloseUpBox{596, 480, 290, 290};
constexpr Box kBoundsBox{900, 480, 284, 290};
constexpr Box kManifoldBox{444, 648, 120, 120};
const Vector2 kAxes(400, 710);
constexpr double kRow = 22;       // of the table
constexpr std::size_t kRows = 3;  // rows that fit in its box

constexpr const char* kTitle = R"(font-size="17" font-weight="bold")";
constexpr const char* kSubtitle = R"(font-size="13" fill="#444")";

std::string degrees(double radians) {
  std::array<char, 24> buffer;
  std::snprintf(buffer.data(), buffer.size(), "%.2g°", radians * 180 / std::numbers::pi);
  return buffer.data();
}

void draw_titles(Svg& svg, const Explanation& explanation, double close_up) {
  const Pair& pair = explanation.pair;
  // A long title has a smaller font.
  constexpr double kLargest = 17, kWidthOfLetter = 0.56;  // px; relative to the font size
  const auto letters = static_cast<double>(pair.title.size());
  const double size = std::min(kLargest, kPairBox.width / (kWidthOfLetter * std::max(letters, 1.0)));
  svg.text({16, 28}, pair.title, R"(font-weight="bold" font-size=")" + coordinate(size) + '"');
  svg.rect({16, 40, 12, 12}, R"(fill="#8FB4D6" stroke="#1F5F8F")");
  svg.text({34, 51}, pair.body1.description, kSubtitle);
  svg.rect({16, 60, 12, 12}, R"(fill="#E3B583" stroke="#A3600F")");
  svg.text({34, 71}, pair.body2.description, kSubtitle);
  svg.text({kSphereBox.x, 28}, "s(n) for every normal n", kTitle);
  svg.text({kSphereBox.x, 48},
           "equal areas; in the middle the common normal; on the middle meridian those in the plane of the left picture",
           R"(font-size="12" fill="#444")");
  svg.text({kCloseUpBox.x, kCloseUpBox.y - 26}, "Close-up", kTitle);
  svg.text({kCloseUpBox.x, kCloseUpBox.y - 9}, "the square above, " + degrees(2 * close_up) + " wide", kSubtitle);
  svg.text({kBoundsBox.x + 12, kBoundsBox.y - 26}, "Proved interval", kTitle);
  svg.text({kBoundsBox.x + 12, kBoundsBox.y - 9}, "of the gap: the grey area, from the answer", kSubtitle);
}

/// The legend of the paths, as a table of the solvers.
void draw_table(Svg& svg, const Box& box, const Explanation& explanation) {
  const double room = explanation.paths.size() > kRows ? 34 : 0;  // px; names of literature methods are longer
  const std::array<double, 4> columns = {box.x, box.x + room + 190, box.x + room + 262, box.x + room + 392};
  const std::array heads = {"solver", "evaluations", "", ""};
  double y = box.y + 14;
  svg.text({columns[0] + 44, y}, heads[0], kSubtitle);
  svg.text({columns[1] + 56, y}, heads[1], std::string(kSubtitle) + R"( text-anchor="end")");
  svg.text({columns[2] + 10, y}, "s at the end", kSubtitle);
  svg.text({columns[3], y}, "status", kSubtitle);
  for (const SolverPath& path : explanation.paths) {
    y += kRow;
    const PathStyle style = style_of(path);
    svg.line({columns[0], y - 5}, {columns[0] + 34, y - 5},
             std::string("stroke=\"") + style.colour + R"(" stroke-width="1.8" stroke-dasharray=")" + style.dashes + '"');
    draw_marker(svg, {columns[0] + 17, y - 5}, style, 4);
    svg.text({columns[0] + 44, y}, path.name);
    svg.text({columns[1] + 56, y}, std::to_string(path.answer.evaluations), R"(text-anchor="end")");
    svg.text({columns[2] + 10, y}, length_text(path.answer.gap, 6));
    svg.text({columns[3], y}, std::string(name_of(path.answer.status)) + (path.answer.is_global ? ", proved" : ""));
  }
}

/// The legend of the other lines and marks.
void draw_legend(Svg& svg, const Box& box, const Explanation& explanation) {
  double y = box.y + 12;
  const auto row = [&](const std::string& words) {
    svg.text({box.x + 44, y}, words, kSubtitle);
    y += 22;
  };
  const auto middle = [&] { return Vector2(box.x + 17, y - 5); };
  draw_ring(svg, middle());
  row("answer of the hybrid");
  svg.line(middle() - Vector2(17, 0), middle() + Vector2(17, 0), kRegionStyle);
  draw_number(svg, middle(), "k");
  row("what the cuts of k evaluations leave: the lighter side");
  if (explanation.answer().gap > 0) {
    svg.line(middle() - Vector2(17, 0), middle() + Vector2(17, 0), kZeroStyle);
    row("s = 0: normals inside prove that the bodies are apart");
  }
  if (explanation.answer().gap <= 0) {
    draw_contact(svg, middle());
    row(!explanation.corners().empty() ? "contact points; seen along n in the box" : "contact point");
  }
  svg.line(middle() + Vector2(0, -8), middle() + Vector2(0, 8), R"(stroke="#222" stroke-width="1.3")");
  row("tangent planes across n, seen edge on");
  for (const SolverPath& path : explanation.paths) {
    if (explanation.shown_evaluations(path) == path.evaluations.size()) continue;
    row("paths end after " + std::to_string(explanation.shown_evaluations()) + " evaluations");
    break;
  }
}

}  // namespace

const char* name_of(Status status) {
  switch (status) {
    case Status::Converged:
      return "converged";
    case Status::Apart:
      return "apart";
    case Status::Stalled:
      return "stalled";
    case Status::EvaluationLimit:
      return "evaluation limit";
    case Status::Diverged:
      return "diverged";
    case Status::InvalidInput:
      break;
  }
  return "no answer";
}

std::string picture_of(const Explanation& explanation) {
  // Additional paths make the picture higher.
  const double more = kRow * static_cast<double>(std::max<std::size_t>(explanation.paths.size(), kRows) - kRows);
  const auto lower = [&](Box box) {
    box.y += more;
    return box;
  };
  Svg svg(kWidth, kHeight + more, explanation.pair.title);
  const Frame frame = frame_of_picture(explanation.pair, explanation.answer().normal);
  const double close_up = close_up_angle(explanation);
  draw_titles(svg, explanation, close_up);
  draw_pair(svg, kPairBox, explanation, frame);
  draw_table(svg, kTableBox, explanation);
  draw_legend(svg, lower(kLegendBox), explanation);
  draw_axes(svg, kAxes + Vector2(0, more), frame);
  if (!explanation.corners().empty()) draw_manifold(svg, lower(kManifoldBox), explanation, frame);
  draw_sphere(svg, kSphereBox, explanation, frame, close_up);
  draw_close_up(svg, kCloseUpBox, explanation, frame, close_up);
  draw_bounds(svg, kBoundsBox, explanation);
  return svg.document();
}

}  // namespace explain_pair
