// Writes SVG 1.1.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace explain_pair {

using Vector2 = Eigen::Vector2d;
using Polyline = std::vector<Vector2>;

/// A rectangle of the picture, px, y down.
struct Box {
  double x, y, width, height;
  double right() const { return x + width; }
  double bottom() const { return y + height; }
  Vector2 centre() const { return {x + width / 2, y + height / 2}; }
};

/// A picture in px, x to the right and y down, with a resolution of 0.1. A style is a text of SVG attributes, such as fill="none".
class Svg {
 public:
  Svg(double width, double height, std::string_view title);

  void rect(const Box& box, std::string_view style);
  void circle(const Vector2& centre, double radius, std::string_view style);
  void ellipse(const Vector2& centre, double radius_x, double radius_y, std::string_view style);
  void line(const Vector2& from, const Vector2& to, std::string_view style);
  void polyline(const Polyline& points, std::string_view style);
  /// Closed polygons as one path, filled by the even-odd rule.
  void polygons(std::span<const Polyline> polygons, std::string_view style);
  void polygon(const Polyline& points, std::string_view style) { polygons({&points, 1}, style); }
  /// Text at a point of its baseline: its start, or as the text-anchor of the style. Any characters are allowed.
  void text(const Vector2& at, std::string_view words, std::string_view style = "");
  /// A line with an arrowhead at `to`.
  void arrow(const Vector2& from, const Vector2& to, std::string_view colour, double width);

  void begin_group(std::string_view style);
  /// Begins a group that is clipped to the polygon.
  void begin_clipped(const Polyline& points);
  void begin_clipped(const Box& box);
  void end_group() { body_ += "</g>\n"; }

  /// The complete document.
  std::string document() const { return head_ + body_ + "</svg>\n"; }

 private:
  std::string head_, body_;
  int clips_ = 0;
};

/// Escapes the characters that XML reserves.
std::string escaped(std::string_view text);

/// A coordinate with a resolution of 0.1.
std::string coordinate(double value);

}  // namespace explain_pair
