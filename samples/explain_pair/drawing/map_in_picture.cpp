#include "drawing/map_in_picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace explain_pair {
namespace {

constexpr std::size_t kSphereColumns = 181, kSphereRows = 91;  // 2 degrees
constexpr std::size_t kCloseUpNodes = 97;

Eigen::AlignedBox2d room_in(const Box& box) {
  const Vector2 margin(12, 12);
  return {Vector2(box.x, box.y) + margin, Vector2(box.right(), box.bottom()) - margin};
}

}  // namespace

MapInPicture hammer_in(const Box& box, const Frame& frame) {
  const double scale = std::min(0.5 * box.width / HammerMap::kHalfWidth, 0.5 * box.height / HammerMap::kHalfHeight);
  const Vector2 centre = box.centre();
  const auto to_px = [scale, centre](const Place& place) {
    const Vector2 point = HammerMap::to_plane(place);
    return Vector2(centre + scale * Vector2(point.x(), -point.y()));
  };
  const auto place = [](double column, double row) {
    return Place{std::numbers::pi * (2 * column / (kSphereColumns - 1) - 1), std::numbers::pi * (row / (kSphereRows - 1) - 0.5)};
  };
  return {kSphereColumns,
          kSphereRows,
          [=](const Vector2& node) { return to_px(place(node.x(), node.y())); },
          [=](double column, double row) { return normal_at(frame, place(column, row)); },
          [=](const Vector3& normal) { return to_px(place_of(frame, normal)); },
          room_in(box),
          0.3 * box.width};
}

MapInPicture lambert_in(const Box& box, const Frame& frame, double half_angle) {
  const double reach = 2 * std::sin(half_angle / 2);
  const double scale = 0.5 * std::min(box.width, box.height) / reach;
  const Vector2 centre = box.centre();
  const auto point = [reach](double column, double row) {
    return Vector2(reach * Vector2(2 * column / (kCloseUpNodes - 1) - 1, 2 * row / (kCloseUpNodes - 1) - 1));
  };
  const auto to_px = [scale, centre](const Vector2& p) { return Vector2(centre + scale * Vector2(p.x(), -p.y())); };
  return {kCloseUpNodes,
          kCloseUpNodes,
          [=](const Vector2& node) { return to_px(point(node.x(), node.y())); },
          [=](double column, double row) { return LambertMap::to_sphere(frame, point(column, row)); },
          [=](const Vector3& normal) { return to_px(LambertMap::to_plane(frame, normal)); },
          room_in(box),
          std::numeric_limits<double>::infinity()};
}

Grid grid_of(const MapInPicture& map, const std::function<double(const Vector3&)>& value) {
  Grid grid(map.columns, map.rows);
  grid.fill([&](double column, double row) { return value(map.normal(column, row)); });
  return grid;
}

std::vector<Polyline> in_picture(std::vector<Polyline> lines, const MapInPicture& map) {
  for (Polyline& line : lines) {
    for (Vector2& point : line) point = map.node_to_px(point);
    line = simplified(line, kMapLineError);
  }
  return lines;
}

}  // namespace explain_pair
