// The walls of a scene, which stand or move: the walls of its container, and its sections [[part]].
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <supernormal/shapes/shape.hpp>
#include <variant>
#include <vector>

#include "common/drive.hpp"
#include "common/mesh.hpp"
#include "common/motion.hpp"
#include "flight.hpp"
#include "geometry.hpp"

namespace falling_particles {

/// The half-space below a plane through the wall's position.
struct PlaneShape {
  /// m, radius of the disc around the wall's position that pictures show; 0: a square as wide as the scene
  double shown_radius = 0;
  Vector3 normal = Vector3::UnitZ();  ///< unit, in the wall's frame; grains are on its side
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

/// A ground over a rectangle around the wall's position, solid below. Its triangles join heights on a grid, as ODE lays them: each
/// cell is divided by the diagonal from its lowest x and y to its highest.
struct GroundShape {
  std::size_t samples;            ///< along x, and along y
  std::array<double, 2> spacing;  ///< m, between samples along x and y
  std::vector<double> heights;    ///< m, along the wall's z-axis; rows along x, from the lowest y on
};

using WallShape = std::variant<PlaneShape, BoxShape, CylinderShape, SmoothShape, MeshShape, GroundShape>;

/// Of a driven or free wall.
inline constexpr double kHeaviest = 1e6;  // kg or kg m^2
// ODE squares the moment of inertia, a thousand times mass times radius squared. Far smaller masses give NaN.
inline constexpr double kLightest = 1e-12;

/// What messages and pictures call a wall.
enum class WallRole {
  Part,  ///< a [[part]], or a wall of a container that moves or rotates
  Side,  ///< of a box, a hopper or a terrain, with which pictures draw it
  Lid,   ///< a side that World::open_outlet() removes
};

/// A wall of a scene.
struct Wall {
  std::string name;
  WallShape shape;
  WallPose start = {};
  std::vector<WallMotion> motions = {};
  std::optional<Drive> drive = {};
  std::optional<Flight> flight = {};       ///< of a free wall, which has neither motions nor a drive
  std::optional<double> friction = {};     ///< coefficient of grains on it; as on other walls if empty
  std::optional<double> restitution = {};  ///< of grains on it; as on other walls if empty
  WallRole role = WallRole::Part;
  bool is_of_container = false;

  std::string called() const;  ///< in messages: part "p", wall "x_low"
  std::string key() const;     ///< of its table in a scene: part, container.x_low
  bool is_part() const { return role == WallRole::Part; }
  bool moves() const { return !motions.empty() || drive || flight; }
};

/// m, radius of a sphere around the wall's position that contains the wall; infinite for a plane and a ground.
double bounding_radius(const WallShape& shape);

/// m, the least length of a solid; infinite for planes, meshes and grounds.
double thinnest(const WallShape& shape);

/// The volume, centroid and moments of a wall's solid, in its frame; empty for walls without a finite volume: planes, grounds,
/// two-sided meshes, and meshes whose triangles do not close with their fronts outside.
std::optional<supernormal::MassProperties> solid_of(const WallShape& shape);

/// Two parallel faces that face each other, of planes or boxes.
struct FacingFaces {
  Vector3 normal;                                     ///< unit, of the first face, towards the second one
  double first, second;                               ///< m, of the faces along the normal
  double distance() const { return second - first; }  ///< m; negative if the walls overlap
};

/// The faces of two walls in these poses with the largest distance; empty unless both walls are planes or boxes and have a pair of
/// parallel ones.
std::optional<FacingFaces> facing_faces(const WallShape& first, const WallPose& at_first, const WallShape& second,
                                        const WallPose& at_second);

}  // namespace falling_particles
