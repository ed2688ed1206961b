// A hopper with an outlet over a tray, and an optional dish for a heap.
#pragma once

#include <optional>

#include "common/mesh.hpp"
#include "geometry.hpp"

namespace falling_particles {

using namespace common;

/// A round, flat dish with a low rim, solid down to the floor. Grains that are poured on it form a heap; the excess falls off.
struct Dish {
  double diameter;  ///< m, within the rim
  double height;    ///< m, height of its bottom above the floor of the tray
  double rim;       ///< m, height of the rim above the bottom

  double rim_width() const { return 2 * rim; }                        ///< m
  double outer_radius() const { return diameter / 2 + rim_width(); }  ///< m
};

/// A cone with an outlet and a cylinder on top of it, over a tray: a floor at z = 0 and four walls. Cone and cylinder have
/// `segments` flat sides around the z-axis. Radii refer to the inscribed circles of the flat sides. A lid, the plane z = clearance,
/// closes the outlet until `opens_at`.
struct Hopper {
  double outlet;           ///< m, diameter
  double wall_angle;       ///< degrees, of the cone from the vertical
  double diameter;         ///< m, of the cylinder
  double cylinder_height;  ///< m
  int segments;
  double clearance;               ///< m, height of the outlet above the floor of the tray
  double tray_width;              ///< m, the tray is square
  double opens_at;                ///< s; 0: open from the start, without a lid
  std::optional<Dish> dish = {};  ///< below the outlet, around the z-axis

  double cone_height() const;        ///< m
  double top() const;                ///< m, z of the upper rim
  double radius_at(double z) const;  ///< m, for z from the outlet upwards; above the rim it is the cylinder's radius
  bool is_within(double x, double y, double radius) const;     ///< in the polygon with that inscribed radius
  bool is_in_tray(const Point& p) const;                       ///< below the outlet
  bool has_room(const Point& lower, const Point& size) const;  ///< for the box from `lower` on and the space above
  double mean_height(double level) const;                      ///< m, of the volume between outlet and z = level, above the outlet

  Rectangle plan() const { return {{-diameter / 2, -diameter / 2}, {diameter, diameter}}; }
  Rectangle tray() const { return {{-tray_width / 2, -tray_width / 2}, {tray_width, tray_width}}; }
  double lowest() const { return clearance; }
  Region room() const;
  /// Whether the point is in the hopper, above it within the cylinder's continuation, or in the tray.
  bool contains(const Point& p) const;
};

/// The mesh of the cone and the cylinder, closed but for outlet and top; grains are inside.
Mesh make_mesh(const Hopper& hopper);

/// The mesh of the dish's surface, with `segments` sides; grains are above and around it.
Mesh make_mesh(const Dish& dish, int segments);

}  // namespace falling_particles
