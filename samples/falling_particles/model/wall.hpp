// Parts of a scene: walls that stand or move.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "geometry.hpp"
#include "motion.hpp"

namespace falling_particles {

/// The half-space below the part's xy-plane.
struct PlaneShape {
  double shown_radius = 0;  ///< m, of the disc around the part's position that pictures show; 0: a square as wide as the scene
};

/// A solid box around the part's position.
struct BoxShape {
  Vector3 size;  ///< m, along the part's axes
};

/// A solid cylinder around the part's position, along its z-axis.
struct CylinderShape {
  double radius;  ///< m
  double length;  ///< m
};

/// One of our own bodies: an ellipsoid, a superellipsoid, a superovoid.
struct SmoothShape {
  Vector3 half_axes;  ///< m
  double delta = 2, epsilon = 2;
  double taper_x = 0, taper_y = 0;
};

/// Triangles in the part's frame.
struct MeshShape : Mesh {
  bool two_sided = false;  ///< whether grains meet it from the side on which their centres are, or from the front alone
};

using WallShape = std::variant<PlaneShape, BoxShape, CylinderShape, SmoothShape, MeshShape>;

/// Drives a part along an axis by a force: a piston, which can neither leave its axis nor tilt. It has inertia and weight.
struct Drive {
  Vector3 axis;                                            ///< unit, at the start; it turns with the part
  double force;                                            ///< N, along the axis
  double mass;                                             ///< kg
  double damping = 0;                                      ///< N s/m
  double from = 0;                                         ///< s; until then the part is held
  double until = std::numeric_limits<double>::infinity();  ///< s; then only its weight is left
  std::array<double, 2> travel = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};  ///< m
};

/// A wall of a scene.
struct Wall {
  std::string name;
  WallShape shape;
  WallPose start = {};
  std::vector<WallMotion> motions = {};
  std::optional<Drive> drive = {};
  std::optional<double> friction = {};     ///< coefficient of grains on it; as for other walls if empty
  std::optional<double> restitution = {};  ///< of grains on it; as for other walls if empty

  bool moves() const { return !motions.empty() || drive.has_value(); }
};

/// m, of a sphere around the part's position that holds the part; infinite for a plane.
double bounding_radius(const WallShape& shape);

}  // namespace falling_particles
