#include "method/sphere_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace explain_pair {
const double HammerMap::kHalfWidth = 2 * std::numbers::sqrt2;
const double HammerMap::kHalfHeight = std::numbers::sqrt2;

Vector3 normal_at(const Frame& frame, const Place& place) {
  const double across = std::cos(place.latitude);
  return frame.to_world({across * std::cos(place.longitude), std::sin(place.latitude), -across * std::sin(place.longitude)});
}

Place place_of(const Frame& frame, const Vector3& normal) {
  const Vector3 v = frame.from_world(normal);
  return {std::atan2(-v.z(), v.x()), std::atan2(v.y(), std::hypot(v.x(), v.z()))};
}

Vector2 HammerMap::to_plane(const Place& place) {
  const double across = std::cos(place.latitude);
  const double scale = std::sqrt(2 / (1 + across * std::cos(place.longitude / 2)));
  return {2 * scale * across * std::sin(place.longitude / 2), scale * std::sin(place.latitude)};
}

Place HammerMap::to_sphere(const Vector2& point) {
  const double z = std::sqrt(std::max(1 - point.x() * point.x() / 16 - point.y() * point.y() / 4, 0.0));
  return {2 * std::atan2(z * point.x(), 2 * (2 * z * z - 1)), std::asin(std::clamp(z * point.y(), -1.0, 1.0))};
}

Vector2 LambertMap::to_plane(const Frame& frame, const Vector3& normal) {
  const Vector3 v = frame.from_world(normal);
  const Vector2 across(-v.z(), v.y());
  if (v.x() > 0) return across * std::sqrt(2 / (1 + v.x()));
  // The antipode of the centre is a whole circle of the map. Any point of it is valid.
  const double length = across.norm();
  return std::sqrt(2 * (1 - v.x())) * (length > 0 ? Vector2(across / length) : Vector2(1, 0));
}

Vector3 LambertMap::to_sphere(const Frame& frame, const Vector2& point) {
  const double squared = std::min(point.squaredNorm(), 4.0);
  const double scale = std::sqrt(1 - squared / 4);
  return frame.to_world({1 - squared / 2, scale * point.y(), -scale * point.x()});
}

}  // namespace explain_pair
