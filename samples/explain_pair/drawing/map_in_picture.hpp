// Maps of the sphere of normals at their places in the picture.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <vector>

#include "drawing/svg.hpp"
#include "method/contours.hpp"
#include "method/sphere_map.hpp"

namespace explain_pair {

constexpr double kMapLineError = 0.12;  ///< px; of a line that is drawn on a map
constexpr double kNumbersApart = 20;    ///< px; numbers on a map that would be nearer to others are left out

/// A map into the picture: where normals are, and the normal at each node of a grid.
struct MapInPicture {
  std::size_t columns, rows;
  std::function<Vector2(const Vector2& node)> node_to_px;
  std::function<Vector3(double column, double row)> normal;
  std::function<Vector2(const Vector3& normal)> to_px;
  Eigen::AlignedBox2d inside;  // px; where numbers have room
  double longest_piece;        // px; two points of an arc that are farther apart are on two sides of the map
};

/// Hammer's map of the whole sphere, and Lambert's of the normals up to that angle (rad) to both sides of the centre.
MapInPicture hammer_in(const Box& box, const Frame& frame);
MapInPicture lambert_in(const Box& box, const Frame& frame, double half_angle);

/// A function of the normal at the nodes of the map's grid.
Grid grid_of(const MapInPicture& map, const std::function<double(const Vector3&)>& value);

/// Lines over the grid as lines in the picture.
std::vector<Polyline> in_picture(std::vector<Polyline> lines, const MapInPicture& map);

}  // namespace explain_pair
