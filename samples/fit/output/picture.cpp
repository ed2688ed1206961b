#include "picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <vector>

#include "model/distance.hpp"

namespace fit {
namespace {

constexpr double kSide = 300, kMargin = 24, kTop = 40;  // px; per view
constexpr std::size_t kDots = 1500;

using Point = Eigen::Vector2d;
using Outline = std::vector<Point>;

struct Dot {
  Vector3 place;
  double distance;
};

std::string text_of(double value, const char* pattern = "%.1f") {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), pattern, value);
  return text.data();
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (static_cast<unsigned char>(c) >= 32) {
      result += c;
    }
  }
  return result;
}

/// The outline of a body along the view direction u x v: the boundary points whose normals lie in the plane of u and v.
Outline outline_of(const DistanceFunction& function, const Vector3& u, const Vector3& v) {
  constexpr int kSteps = 720;
  const Body& body = function.body();
  const Matrix3 R = body.rotation();
  Outline outline;
  for (int i = 0; i < kSteps; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSteps;
    const Vector3 n = std::cos(angle) * u + std::sin(angle) * v;
    const Vector3 x = body.position + R * function.shape().point(function.to_body(n).normalized());
    outline.emplace_back(u.dot(x), v.dot(x));
  }
  return outline;
}

std::string colour_of(double distance, double rms) {
  const double share = rms > 0 ? std::clamp(distance / (2 * rms), -1.0, 1.0) : 0;
  const int weak = static_cast<int>(170 * (1 - std::abs(share)));
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "rgb(%d,%d,%d)", share > 0 ? 200 : weak, weak, share > 0 ? weak : 200);
  return text.data();
}

/// Draws one view about `middle` (px).
std::string draw_view(std::span<const DistanceFunction> functions, std::span<const Dot> dots, const Vector3& u, const Vector3& v,
                      double scale, const Vector3& centre, const Point& middle, double rms) {
  const Point origin(u.dot(centre), v.dot(centre));
  const auto place = [&](const Point& p) {
    const Point q = scale * (p - origin);
    return text_of(middle.x() + q.x()) + "," + text_of(middle.y() - q.y());
  };
  std::string text;
  for (const Dot& dot : dots) {
    const std::string at = place({u.dot(dot.place), v.dot(dot.place)});
    const std::size_t comma = at.find(',');
    text += "<circle cx='" + at.substr(0, comma) + "' cy='" + at.substr(comma + 1) + "' r='1.2' fill='" +
            colour_of(dot.distance, rms) + "'/>\n";
  }
  for (const DistanceFunction& function : functions) {
    text += "<polygon fill='none' stroke='black' stroke-width='1.2' stroke-linejoin='round' points='";
    for (const Point& p : outline_of(function, u, v)) text += place(p) + " ";
    text += "'/>\n";
  }
  return text;
}

}  // namespace

std::string draw(std::span<const Body> bodies, const Cloud& data, double rms, const std::string& title) {
  const std::vector<DistanceFunction> functions(bodies.begin(), bodies.end());
  std::vector<Dot> dots;
  for (const Eigen::Vector3d& x : thinned(data, kDots).points) dots.push_back({x, least_distance(functions, x)});
  const Matrix3 axes = bodies.front().rotation();
  // The box of the data and the bodies along these axes.
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (int i = 0; i < 3; ++i) {
    const Vector3 up = axes.col(i);
    for (const Dot& dot : dots) low[i] = std::min(low[i], up.dot(dot.place)), high[i] = std::max(high[i], up.dot(dot.place));
    for (const DistanceFunction& f : functions) {
      high[i] = std::max(high[i], up.dot(f.body().position) + f.shape().support(f.to_body(up).normalized()));
      low[i] = std::min(low[i], up.dot(f.body().position) - f.shape().support(f.to_body(-up).normalized()));
    }
  }
  const Vector3 centre = axes * ((low + high) / 2);
  const double scale = kSide / (high - low).maxCoeff();
  const double width = 3 * kSide + 4 * kMargin, height = kSide + kTop + 2 * kMargin;
  std::string text = "<svg xmlns='http://www.w3.org/2000/svg' width='" + text_of(width, "%.0f") + "' height='" +
                     text_of(height, "%.0f") +
                     "' font-family='sans-serif' font-size='13'>\n<rect width='100%' height='100%' fill='white'/>\n";
  text += "<text x='" + text_of(kMargin) + "' y='24'>" + escaped(title) + ": data red outside of the bodies, blue inside</text>\n";
  constexpr std::array kViews = {std::array{0, 1}, std::array{0, 2}, std::array{1, 2}};
  for (std::size_t k = 0; k < kViews.size(); ++k) {
    const auto [first, second] = kViews[k];
    const Point middle(kMargin + kSide / 2 + static_cast<double>(k) * (kSide + kMargin), kTop + kSide / 2);
    text += draw_view(functions, dots, axes.col(first), axes.col(second), scale, centre, middle, rms);
    text += "<text x='" + text_of(middle.x()) + "' y='" + text_of(height - kMargin / 2) + "' text-anchor='middle'>" + "xyz"[first] +
            " and " + "xyz"[second] + "</text>\n";
  }
  return text + "</svg>\n";
}

}  // namespace fit
