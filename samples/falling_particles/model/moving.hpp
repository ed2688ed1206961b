// Containers that are made of moving walls (model/container_walls.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry.hpp"

namespace falling_particles {

/// A drum that rotates about the line x = 0, z = diameter / 2, from y = 0 to y = length. Its shell has `segments` flat sides around
/// a circle of `diameter`. The ends are closed and rotate with it.
struct Drum {
  double diameter;  ///< m
  double length;    ///< m
  int segments;
  double rpm;       ///< revolutions per minute; for a positive number the floor of the drum moves towards -x
  bool is_smooth;   ///< whether only the surface moves while the flat sides stand
  double turns_at;  ///< s

  double radius() const { return diameter / 2; }                                            ///< m
  double outer_radius() const { return radius() / std::cos(std::numbers::pi / segments); }  ///< m, of the edges

  Rectangle plan() const { return {{-radius(), 0}, {diameter, length}}; }
  double lowest() const { return 0; }
  double ceiling() const { return diameter; }
  /// Whether the box from `lower` on is within the inscribed cylinder.
  bool has_room(const Point& lower, const Point& size) const {
    const double x = std::max(std::abs(lower[0]), std::abs(lower[0] + size[0]));
    const double z = std::max(std::abs(lower[2] - radius()), std::abs(lower[2] + size[2] - radius()));
    return std::hypot(x, z) <= radius();
  }
  Region room() const {
    const double outer = outer_radius();
    return {{-outer, 0, radius() - outer}, {2 * outer, length, 2 * outer}};
  }
  bool contains(const Point& p) const { return p[1] > 0 && p[1] < length && std::hypot(p[0], p[2] - radius()) < outer_radius(); }
};

/// A vibrating tray: a floor at z = 0 and four walls around 0 < x < width[0], 0 < y < width[1].
struct Tray {
  std::array<double, 2> width;  ///< m
  double wall_height;           ///< m
  double thickness;             ///< m, of floor and walls
  Point direction;              ///< of the vibration, unit
  double amplitude;             ///< m
  double frequency;             ///< Hz
  double phase;                 ///< rad
  double shakes_at;             ///< s

  Rectangle plan() const { return {{0, 0}, width}; }
  double lowest() const { return 0; }
  /// Within the walls at any phase of the vibration, or above them.
  Region room() const {
    const auto way = [this](std::size_t axis) { return 2 * amplitude * std::abs(direction[axis]); };
    return {{-way(0), -way(1), -way(2)}, {width[0] + 2 * way(0), width[1] + 2 * way(1), INFINITY}};
  }
  bool contains(const Point& p) const { return room().contains(p); }
};

/// A direct shear test: a box cut at half its height. The lower half moves along x below the upper one. A lid that can move up and
/// down presses on the grains.
struct ShearCell {
  std::array<double, 2> width;  ///< m
  double height;                ///< m
  double cut;                   ///< m, z of the cut
  double thickness;             ///< m, of floor, walls and lid
  double speed;                 ///< m/s, of the lower half along x
  double pressure;              ///< Pa, of the lid on the plan
  double lid_mass;              ///< kg
  double lid;                   ///< m, z of the lid's lower side at the start
  double presses_at;            ///< s; until then the lid is held
  double shears_at;             ///< s

  Rectangle plan() const { return {{0, 0}, width}; }
  double lowest() const { return 0; }
  double ceiling() const { return lid; }
  /// Within the upper half or the lower one, which moves by less than the thickness of the walls.
  Region room() const { return {{-thickness, 0, 0}, {width[0] + 2 * thickness, width[1], height + thickness}}; }
  bool contains(const Point& p) const { return room().contains(p); }
};

/// A belt around two rollers, from x = 0 to x = length, between two side walls. At its end grains drop to a floor at z = 0 with a
/// wall at its end.
struct ConveyorBelt {
  double length;       ///< m, between the axes of the rollers
  double width;        ///< m
  double height;       ///< m, z of the belt
  double thickness;    ///< m, of the belt and the walls, and the diameter of the rollers
  double wall_height;  ///< m, height of the walls above the belt
  double speed;        ///< m/s, along x
  double drop_length;  ///< m, from the end of the belt to the last wall
  double starts_at;    ///< s

  double roller_rpm() const { return 60 / (2 * std::numbers::pi) * speed / (thickness / 2); }
  double end() const { return length + drop_length; }  ///< m

  Rectangle plan() const { return {{0, 0}, {length / 2, width}}; }
  double lowest() const { return height; }
  Region room() const { return {{0, 0, 0}, {end(), width, INFINITY}}; }
  bool contains(const Point& p) const { return room().contains(p); }
};

}  // namespace falling_particles
