#include "drawing/svg.hpp"

#include <array>
#include <charconv>

namespace explain_pair {
namespace {

std::string attribute(const char* name, double value) { return std::string(" ") + name + "=\"" + coordinate(value) + '"'; }

std::string path_of(const Polyline& points) {
  std::string path;
  for (const Vector2& point : points) {
    path += path.empty() ? 'M' : ' ';
    path += coordinate(point.x()) + ' ' + coordinate(point.y());
  }
  return path;
}

std::string element(std::string_view name, const std::string& attributes, std::string_view style) {
  return '<' + std::string(name) + attributes + (style.empty() ? "" : " ") + std::string(style) + "/>\n";
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        // XML allows no other control characters.
        out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
  }
  return out;
}

std::string coordinate(double value) {
  std::array<char, 330> buffer;  // fits the longest number
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, 1);
  std::string text(buffer.data(), end);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

Svg::Svg(double width, double height, std::string_view title) {
  const std::string w = coordinate(width), h = coordinate(height);
  head_ = R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 )" + w + ' ' + h + R"(" width=")" + w + R"(" height=")" + h +
          R"(" font-family="Helvetica, Arial, sans-serif" font-size="14">)" + "\n<title>" + escaped(title) + "</title>\n";
  rect({0, 0, width, height}, R"(fill="#fff")");
}

void Svg::rect(const Box& box, std::string_view style) {
  body_ += element("rect",
                   attribute("x", box.x) + attribute("y", box.y) + attribute("width", box.width) + attribute("height", box.height),
                   style);
}

void Svg::circle(const Vector2& centre, double radius, std::string_view style) {
  body_ += element("circle", attribute("cx", centre.x()) + attribute("cy", centre.y()) + attribute("r", radius), style);
}

void Svg::ellipse(const Vector2& centre, double radius_x, double radius_y, std::string_view style) {
  body_ += element(
      "ellipse", attribute("cx", centre.x()) + attribute("cy", centre.y()) + attribute("rx", radius_x) + attribute("ry", radius_y),
      style);
}

void Svg::line(const Vector2& from, const Vector2& to, std::string_view style) {
  body_ += element(
      "line", attribute("x1", from.x()) + attribute("y1", from.y()) + attribute("x2", to.x()) + attribute("y2", to.y()), style);
}

void Svg::polyline(const Polyline& points, std::string_view style) {
  if (points.size() < 2) return;
  body_ += element("path", R"( fill="none" d=")" + path_of(points) + '"', style);
}

void Svg::polygons(std::span<const Polyline> polygons, std::string_view style) {
  std::string path;
  for (const Polyline& polygon : polygons) {
    if (polygon.size() > 2) path += path_of(polygon) + 'Z';
  }
  if (path.empty()) return;
  body_ += element("path", R"( fill-rule="evenodd" d=")" + path + '"', style);
}

void Svg::text(const Vector2& at, std::string_view words, std::string_view style) {
  body_ += "<text" + attribute("x", at.x()) + attribute("y", at.y()) + (style.empty() ? "" : " ") + std::string(style) + '>' +
           escaped(words) + "</text>\n";
}

void Svg::arrow(const Vector2& from, const Vector2& to, std::string_view colour, double width) {
  const Vector2 along = (to - from).normalized(), across(-along.y(), along.x());
  const double length = 3 + 3 * width;  // of the arrowhead
  line(from, to - 0.7 * length * along, "stroke=\"" + std::string(colour) + "\" stroke-width=\"" + coordinate(width) + '"');
  polygon({to, to - length * along + 0.4 * length * across, to - length * along - 0.4 * length * across},
          "fill=\"" + std::string(colour) + '"');
}

void Svg::begin_group(std::string_view style) { body_ += "<g " + std::string(style) + ">\n"; }

void Svg::begin_clipped(const Polyline& points) {
  const std::string name = "clip" + std::to_string(++clips_);
  body_ += "<clipPath id=\"" + name + "\"><path d=\"" + path_of(points) + "Z\"/></clipPath>\n";
  begin_group("clip-path=\"url(#" + name + ")\"");
}

void Svg::begin_clipped(const Box& box) {
  begin_clipped({{box.x, box.y}, {box.right(), box.y}, {box.right(), box.bottom()}, {box.x, box.bottom()}});
}

}  // namespace explain_pair
