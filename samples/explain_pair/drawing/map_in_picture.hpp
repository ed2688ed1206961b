// Maps of the sphere of normals, placed in the picture.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <vector>

#include "drawing/svg.hpp"
#include "method/contours.hpp"
#include "method/sphere_map.hpp"

namespace explain_pair {

constexpr double kMapLineError = 0.12;  ///< px; of a line on a map
constexpr double kNumbersApart = 20;    ///< px; a number closer than this to another is omitted

/// A map in the picture: where normals are, and the normal at each node of a grid.
struct MapInPicture {
  std::size_t columns, rows;
  std::function<Vector2(const Vector2& node)> node_to_px;
  std::function<Vector3(double column, double row)> normal;
  std::function<Vector2(const Vector3& normal)> to_px;
  Eigen::AlignedBox2d inside;  // px; where numbers fit
  double longest_piece;        // px; if two points of an arc are farther apart, they are on opposite sides of the map
};

/// Hammer's map of the whole sphere, and Lambert's map of the normals within an angle (rad) of the centre.
MapInPicture hammer_in(const Box& box, const Frame& frame);
MapInPicture lambert_in(const Box& box, const Frame& frame, double half_angle);

/// The values of a function of the normal at the nodes of the map's grid.
Grid grid_of(const MapInPicture& map, const std::function<double(const Vector3&)>& value);

/// Maps lines on the grid to lines in the picture.
std::vector<Polyline> in_picture(std::vector<Polyline> lines, const MapInPicture& map);

}  // namespace explain_pair
