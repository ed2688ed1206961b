#include "drawing/pair_panel.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>

#include "drawing/colours.hpp"
#include "drawing/lengths.hpp"
#include "drawing/view.hpp"
#include "method/contours.hpp"

namespace explain_pair {
namespace {

using supernormal::Proximity;

// px
constexpr double kAbove = 40, kBelow = 40, kAside = 14;  // margins for normals, the gap and the bodies
constexpr double kTightGap = 44;                         // below this the arrows of the gap are outside
constexpr double kOutsideArrow = 26;

constexpr double kGraticule = 30;  // degrees

/// The colours of a body: nested parts from dark to light.
struct Paint {
  double hue, chroma;
  const char* line;
};

constexpr Paint kPaint1{240, 0.075, "#1F5F8F"}, kPaint2{60, 0.085, "#A3600F"};
constexpr int kTones = 9;
constexpr double kDarkest = 0.74, kLightest = 0.97;  // lightness

void shade(Svg& svg, const PlacedBody& body, const View& view, const Polyline& outline, const Paint& paint) {
  const Frame& frame = view.frame();
  const Vector3 light = (-0.45 * frame.right + 0.5 * frame.up + 0.75 * frame.toward).normalized();
  const auto style = [&](double share) {
    const Oklch tone{std::lerp(kDarkest, kLightest, share), paint.chroma * (1 - 0.6 * share), paint.hue};
    return "fill=\"" + hex(tone) + '"';
  };
  svg.polygon(outline, style(0));
  for (int k = 1; k < kTones; ++k) {
    const double share = static_cast<double>(k) / kTones;
    svg.polygon(lit_part(body, view, light, std::lerp(-0.35, 1.0, share)), style(share));
  }
  for (const Polyline& line : graticule(body, view, kGraticule)) {
    svg.polyline(line, std::string("stroke=\"") + paint.line + R"(" stroke-opacity="0.35" stroke-width="0.8")");
  }
}

/// Text with a halo, readable on any background.
void label(Svg& svg, const Vector2& at, std::string_view words, std::string_view style) {
  svg.text(at, words,
           std::string(R"(stroke="#fff" stroke-width="4" stroke-linejoin="round" stroke-opacity="0.85" )") + std::string(style));
  svg.text(at, words, style);
}

void draw_scale(Svg& svg, const Vector2& right_end, double px_per_metre) {
  constexpr double kLongest = 90;
  const double longest = kLongest / px_per_metre;
  // The largest round length that fits. Half of it is a step of at most as many parts.
  const double power = std::pow(10, std::floor(std::log10(longest)));
  double length = power;
  for (const double factor : {2.0, 5.0}) {
    if (factor * power <= longest) length = factor * power;
  }
  const Vector2 left_end = right_end - Vector2(length * px_per_metre, 0);
  svg.line(left_end, right_end, R"(stroke="#444" stroke-width="1.4")");
  for (const Vector2& end : {left_end, right_end})
    svg.line(end - Vector2(0, 4), end + Vector2(0, 4), R"(stroke="#444" stroke-width="1.4")");
  svg.text(right_end + Vector2(0, -8), length_text(length), R"(text-anchor="end" font-size="12" fill="#444")");
}

/// Draws the distance between the planes at x1 and x2, with its label.
void draw_gap(Svg& svg, const Box& box, double x1, double x2, double gap) {
  const double y = box.bottom() - 16;
  const std::string words = gap >= 0 ? "gap " + length_text(gap) : "depth " + length_text(-gap);
  const double left = std::min(x1, x2), right = std::max(x1, x2);
  const std::string style = std::string("fill=\"") + kVermilion + R"(" font-weight="bold")";
  if (right - left > kTightGap) {
    const Vector2 middle(0.5 * (left + right), y);
    svg.arrow(middle, {right, y}, kVermilion, 2);
    svg.arrow(middle, {left, y}, kVermilion, 2);
  } else {
    svg.arrow({left - kOutsideArrow, y}, {left, y}, kVermilion, 2);
    svg.arrow({right + kOutsideArrow, y}, {right, y}, kVermilion, 2);
  }
  // Beside the planes, on the side with more space.
  const bool is_right = 0.5 * (left + right) < box.centre().x();
  const double away = (right - left > kTightGap ? 0 : kOutsideArrow) + 8;
  label(svg, {is_right ? right + away : left - away, y + 5}, words, style + (is_right ? "" : R"( text-anchor="end")"));
}

void draw_planes(Svg& svg, const Box& box, double x1, double x2, double gap) {
  for (const double x : {x1, x2}) svg.line({x, box.y + 6}, {x, box.bottom()}, R"(stroke="#222" stroke-width="1.3")");
  const double y = box.y + 16;
  svg.arrow({x1, y}, {x1 + 46, y}, kInk, 1.8);
  // Its label is at the tail if the other plane is close to the tip.
  const bool is_tight = x2 > x1 && x2 - x1 < 80;
  label(svg, {x1 + (is_tight ? -8 : 52), y + 5}, "n",
        std::string(R"(font-style="italic" font-size="16")") + (is_tight ? R"( text-anchor="end")" : ""));
  draw_gap(svg, box, x1, x2, gap);
}

void draw_point(Svg& svg, const Vector2& at, const char* colour) {
  svg.circle(at, 4.2, std::string("fill=\"") + colour + R"(" stroke="#fff" stroke-width="1.2")");
}

}  // namespace

void draw_contact(Svg& svg, const Vector2& at) {
  constexpr double kSize = 5;
  svg.polygon({at + Vector2(0, -kSize), at + Vector2(kSize, 0), at + Vector2(0, kSize), at + Vector2(-kSize, 0)},
              R"(fill="#000" stroke="#fff" stroke-width="1.2")");
}

void draw_pair(Svg& svg, const Box& box, const Explanation& explanation, const Frame& frame) {
  const Pair& pair = explanation.pair;
  const Proximity& answer = explanation.answer();
  const Box inner{box.x + kAside, box.y + kAbove, box.width - 2 * kAside, box.height - kAbove - kBelow};
  const View view(frame, {&pair.body1, &pair.body2}, inner);
  const Polyline outline1 = outline(pair.body1, view), outline2 = outline(pair.body2, view);
  shade(svg, pair.body1, view, outline1, kPaint1);
  svg.begin_group(answer.gap < 0 ? R"(opacity="0.8")" : R"(opacity="1")");
  shade(svg, pair.body2, view, outline2, kPaint2);
  svg.end_group();
  if (answer.gap < 0) {
    svg.begin_clipped(outline1);
    svg.polygon(outline2, std::string(R"(fill-opacity="0.35" fill=")") + kVermilion + '"');
    svg.end_group();
  }
  svg.polygon(outline1, std::string(R"(fill="none" stroke-width="1.6" stroke=")") + kPaint1.line + '"');
  svg.polygon(outline2, std::string(R"(fill="none" stroke-width="1.6" stroke=")") + kPaint2.line + '"');

  const Vector2 point1 = view.to_px(answer.point1), point2 = view.to_px(answer.point2);
  draw_planes(svg, box, point1.x(), point2.x(), answer.gap);
  for (const supernormal::ManifoldCorner& corner : explanation.corners()) draw_contact(svg, view.to_px(corner.point));
  if (answer.gap <= 0) draw_contact(svg, view.to_px(answer.contact));
  draw_point(svg, point1, kPaint1.line);
  draw_point(svg, point2, kPaint2.line);
  // Each label on the side of its body.
  const double side = answer.gap >= 0 ? 1 : -1;
  const auto name = [&](const Vector2& at, double direction, const char* words, const char* colour) {
    const std::string anchor = direction < 0 ? R"(text-anchor="end" )" : "";
    label(svg, at + Vector2(9 * direction, -9), words, anchor + R"(font-style="italic" font-size="16" fill=")" + colour + '"');
  };
  name(point1, -side, "P₁", kPaint1.line);
  name(point2, side, "P₂", kPaint2.line);
  draw_scale(svg, {box.right() - 6, box.y - 14}, view.scale());
}

void draw_axes(Svg& svg, const Vector2& at, const Frame& frame) {
  constexpr double kLength = 26;
  constexpr std::array kNames = {"x", "y", "z"};
  constexpr double kLetter = 11;  // px
  Polyline letters;
  for (const int axis : {0, 1, 2}) {
    const Vector3 v = frame.from_world(Vector3::Unit(axis));
    const Vector2 along(v.x(), -v.y());
    const Vector2 tip = at + kLength * along;
    svg.line(at, tip, R"(stroke="#444" stroke-width="1.4")");
    // An axis towards the viewer is a dot, with its label beside it. Labels of neighbouring axes are moved apart.
    const Vector2 outward = along.norm() > 0.25 ? Vector2(along.normalized()) : Vector2(-1, 0);
    Vector2 letter = tip + 8 * outward;
    while (std::ranges::any_of(letters, [&](const Vector2& other) { return (other - letter).norm() < kLetter; }))
      letter += 3 * outward;
    letters.push_back(letter);
    svg.text(letter + Vector2(0, 4), kNames[static_cast<std::size_t>(axis)], R"(text-anchor="middle" font-size="12" fill="#444")");
  }
}

void draw_manifold(Svg& svg, const Box& box, const Explanation& explanation, const Frame& frame) {
  const std::span<const supernormal::ManifoldCorner> corners = explanation.corners();
  const Pair& pair = explanation.pair;
  const Vector3& contact = explanation.answer().contact;
  const Frame against{-frame.toward, frame.up, frame.right};  // along the normal: body 2 is on top
  Eigen::AlignedBox3d extent(against.from_world(contact));
  for (const supernormal::ManifoldCorner& corner : corners) extent.extend(against.from_world(corner.point));
  constexpr double kShare = 0.7;  // fraction of the box
  const double scale = kShare * std::min(box.width / extent.sizes().x(), box.height / extent.sizes().y());
  const View view(against, against.to_world(extent.center()), scale, box);
  Polyline polygon;
  for (const supernormal::ManifoldCorner& corner : corners) polygon.push_back(view.to_px(corner.point));
  svg.begin_clipped(box);
  svg.polygon(outline(pair.body1, view), std::string(R"(fill="#DCE9F5" stroke-width="1.6" stroke=")") + kPaint1.line + '"');
  svg.polygon(outline(pair.body2, view),
              std::string(R"(fill="#F7E3CC" fill-opacity="0.7" stroke-width="1.6" stroke=")") + kPaint2.line + '"');
  svg.end_group();
  svg.polygon(polygon,
              std::string(R"(fill-opacity="0.35" stroke-width="1.2" fill=")") + kVermilion + "\" stroke=\"" + kVermilion + '"');
  for (const Vector2& corner : polygon) draw_contact(svg, corner);
  draw_contact(svg, view.to_px(contact));
  svg.rect(box, R"(fill="none" stroke="#999")");
}

}  // namespace explain_pair
