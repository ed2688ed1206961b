// Walls of a scene, which stand or move: its sections [[part]], and the walls of some containers.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "geometry.hpp"
#include "motion.hpp"

namespace falling_particles {

/// The half-space below the wall's xy-plane.
struct PlaneShape {
  double shown_radius =
      0;  ///< m, radius of the disc around the wall's position that pictures show; 0: a square as wide as the scene
};

/// A solid box around the wall's position.
struct BoxShape {
  Vector3 size;  ///< m, along the wall's axes
};

/// A solid cylinder around the wall's position, along its z-axis.
struct CylinderShape {
  double radius;  ///< m
  double length;  ///< m
};

/// A smooth body of the library: an ellipsoid, a superellipsoid or a superovoid.
struct SmoothShape {
  Vector3 half_axes;  ///< m
  double delta = 2, epsilon = 2;
  double taper_x = 0, taper_y = 0;
};

/// Triangles in the wall's frame.
struct MeshShape : Mesh {
  bool two_sided = false;  ///< whether grains meet it from the side of their centres, or only from the front
};

using WallShape = std::variant<PlaneShape, BoxShape, CylinderShape, SmoothShape, MeshShape>;

/// A force that drives a wall along an axis, as a piston. The wall can neither leave its axis nor tilt. It has inertia and weight.
struct Drive {
  Vector3 axis;                                            ///< unit, at the start; it rotates with the wall
  double force;                                            ///< N, along the axis
  double mass;                                             ///< kg
  double damping = 0;                                      ///< N s/m
  double from = 0;                                         ///< s; until then the wall is held
  double until = std::numeric_limits<double>::infinity();  ///< s; then only its weight acts
  std::array<double, 2> travel = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};  ///< m
};

/// A wall of a scene.
struct Wall {
  std::string name;
  WallShape shape;
  WallPose start = {};
  std::vector<WallMotion> motions = {};
  std::optional<Drive> drive = {};
  std::optional<double> friction = {};     ///< coefficient of grains on it; as on other walls if empty
  std::optional<double> restitution = {};  ///< of grains on it; as on other walls if empty

  bool moves() const { return !motions.empty() || drive.has_value(); }
};

/// m, radius of a sphere around the wall's position that contains the wall; infinite for a plane.
double bounding_radius(const WallShape& shape);

}  // namespace falling_particles
