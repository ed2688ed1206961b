#include "drawing/view.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <supernormal/shapes/silhouette.hpp>

#include "method/contours.hpp"

namespace explain_pair {
namespace {

// A curve is bisected until its points are this close, or its parameters are practically equal: at a flat face the boundary point
// jumps.
constexpr double kPixelStep = 3;
constexpr double kSmallestStep = 1e-10;
constexpr int kFirstPoints = 32;
constexpr double kRounding = 1e-15;

// Largest deviation of a drawn line from the exact one.
constexpr double kOutlineError = 0.08;

// Relative to the largest area. Among views with nearly as much area, the one with the centres' offset in the picture plane is
// chosen.
constexpr double kPreference = 0.02;

constexpr int kViews = 180;

using Curve = std::function<Vector3(double)>;  // a normal in the body's frame

/// The image of the boundary points with the normals n(t).
Polyline trace(const PlacedBody& body, const View& view, const Curve& normal, double start, double end) {
  Polyline line;
  const auto point_at = [&](double t) {
    return view.to_px(body.pose.position + body.pose.rotation * body.shape->point(normal(t).normalized()));
  };
  const std::function<void(double, const Vector2&, double, const Vector2&)> halve = [&](double from, const Vector2& first,
                                                                                        double to, const Vector2& last) {
    if (std::abs(to - from) > kSmallestStep && (last - first).norm() > kPixelStep) {
      const double middle = 0.5 * (from + to);
      const Vector2 between = point_at(middle);
      halve(from, first, middle, between);
      halve(middle, between, to, last);
    } else {
      line.push_back(last);
    }
  };
  line.push_back(point_at(start));
  for (int k = 0; k < kFirstPoints; ++k) {
    const double from = std::lerp(start, end, static_cast<double>(k) / kFirstPoints);
    const double to = std::lerp(start, end, static_cast<double>(k + 1) / kFirstPoints);
    const Vector2 first = line.back();
    halve(from, first, to, point_at(to));
  }
  return simplified(line, kOutlineError);
}

/// Sets components within rounding of 0 to 0: on a body with flat faces the boundary point is a steep power of them.
Vector3 without_rounding(const Vector3& normal) {
  return normal.unaryExpr([](double component) { return std::abs(component) < kRounding ? 0 : component; });
}

/// The circle of normals at the angle acos(cosine) from an axis. It starts where it is nearest to the viewer.
struct Circle {
  Vector3 axis, nearest, aside;
  double cosine, sine;

  Circle(const Vector3& centre, const Vector3& toward, double c)
      : axis(centre), cosine(c), sine(std::sqrt(std::max(1 - c * c, 0.0))) {
    const Vector3 tangent = toward - toward.dot(axis) * axis;
    nearest = tangent.norm() > 1e-9 ? tangent.normalized() : axis.unitOrthogonal();
    aside = axis.cross(nearest);
  }
  Vector3 operator()(double angle) const { return cosine * axis + sine * (std::cos(angle) * nearest + std::sin(angle) * aside); }
  /// Normals up to this angle on both sides of the start are visible; pi if all are, negative if none is.
  double visible(const Vector3& toward) const {
    const double depth = cosine * axis.dot(toward), reach = sine * nearest.dot(toward);
    if (depth >= reach) return std::numbers::pi;
    if (depth <= -reach) return -1;
    return std::acos(std::clamp(-depth / reach, -1.0, 1.0));
  }
};

}  // namespace

Frame frame_of_picture(const Pair& pair, const Vector3& normal) {
  const Vector3 e1 = normal.unitOrthogonal(), e2 = normal.cross(e1);
  const Vector3 offset = pair.body2.pose.position - pair.body1.pose.position;
  const Vector3 aside = offset - offset.dot(normal) * normal;
  // A point has no area.
  const auto has_area = [](const PlacedBody& body) { return body.shape->half_extents().minCoeff() > 0; };
  const auto area = [&](const PlacedBody& body, const Vector3& view) {
    return has_area(body) ? supernormal::projected_area(*body.shape, body.pose.rotation.transpose() * view) : 0;
  };
  double whole = 0;
  for (const PlacedBody* body : {&pair.body1, &pair.body2}) {
    if (has_area(*body)) whole += supernormal::surface_area(*body->shape);
  }
  double best = -std::numeric_limits<double>::infinity();
  Frame frame{normal, e1, e2};
  for (int k = 0; k < kViews; ++k) {
    const double angle = std::numbers::pi * k / kViews;
    const Vector3 toward = std::cos(angle) * e1 + std::sin(angle) * e2;
    const double hidden = aside.norm() > 0 ? std::abs(aside.dot(toward)) / aside.norm() : 0;
    const double seen = whole > 0 ? (area(pair.body1, toward) + area(pair.body2, toward)) / whole : 0;
    const double merit = seen - kPreference * hidden;
    if (merit > best) {
      best = merit;
      frame = {normal, toward.cross(normal), toward};
    }
  }
  // The upward direction is as close as possible to the upward direction of the world.
  if (frame.up.z() < 0) frame = {normal, -frame.up, -frame.toward};
  return frame;
}

View::View(const Frame& frame, const std::vector<const PlacedBody*>& bodies, const Box& box)
    : View(frame, Vector3::Zero(), 1, box) {
  const auto extent = [&](const Vector3& direction) {
    double reach = -std::numeric_limits<double>::infinity();
    for (const PlacedBody* body : bodies) reach = std::max(reach, body->reach(direction));
    return reach;
  };
  const double right = extent(frame.right), left = -extent(-frame.right), top = extent(frame.up), bottom = -extent(-frame.up);
  middle_ = 0.5 * (left + right) * frame.right + 0.5 * (bottom + top) * frame.up;
  scale_ = std::min(box.width / (right - left), box.height / (top - bottom));
}

View::View(const Frame& frame, const Vector3& middle, double scale, const Box& box)
    : frame_(frame), middle_(middle), scale_(scale), centre_(box.centre()) {}

Vector2 View::to_px(const Vector3& point) const {
  const Vector3 from_middle = point - middle_;
  return centre_ + scale_ * Vector2(frame_.right.dot(from_middle), -frame_.up.dot(from_middle));
}

Polyline outline(const PlacedBody& body, const View& view) {
  const Matrix3 to_body = body.pose.rotation.transpose();
  const Vector3 right = to_body * view.frame().right, up = to_body * view.frame().up;
  const Curve normal = [&](double t) { return without_rounding(std::cos(t) * right + std::sin(t) * up); };
  return trace(body, view, normal, -std::numbers::pi, std::numbers::pi);
}

Polyline lit_part(const PlacedBody& body, const View& view, const Vector3& light, double cosine) {
  const Matrix3 to_body = body.pose.rotation.transpose();
  const Vector3 toward = to_body * view.frame().toward, source = to_body * light;
  const Circle circle(source, toward, cosine);
  const double end = circle.visible(toward);
  if (end < 0) return {};
  Polyline part = trace(body, view, circle, -end, end);
  if (end == std::numbers::pi) return part;
  // Return along the outline, on the side of the light.
  const Vector3 middle = (source - source.dot(toward) * toward).normalized(), aside = toward.cross(middle);
  const auto angle_of = [&](const Vector3& normal) { return std::atan2(normal.dot(aside), normal.dot(middle)); };
  const Curve rim = [&](double t) { return without_rounding(std::cos(t) * middle + std::sin(t) * aside); };
  const Polyline back = trace(body, view, rim, angle_of(circle(end)), angle_of(circle(-end)));
  part.insert(part.end(), back.begin(), back.end());
  return part;
}

std::vector<Polyline> graticule(const PlacedBody& body, const View& view, double spacing) {
  const Vector3 toward = body.pose.rotation.transpose() * view.frame().toward;
  std::vector<Polyline> lines;
  const auto add = [&](const Vector3& axis, double cosine) {
    const Circle circle(axis, toward, cosine);
    const double end = circle.visible(toward);
    if (end > 0) lines.push_back(trace(body, view, circle, -end, end));
  };
  for (int k = 1; k * spacing < 180; ++k) add(Vector3::UnitZ(), std::cos(k * spacing * std::numbers::pi / 180));
  for (int k = 0; k * spacing < 180; ++k) {
    const double angle = k * spacing * std::numbers::pi / 180;
    add(without_rounding({std::cos(angle), std::sin(angle), 0}), 0);
  }
  return lines;
}

}  // namespace explain_pair
