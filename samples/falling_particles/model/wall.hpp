// The walls of a scene, which stand or move: the walls of its container, and its sections [[part]].
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <supernormal/effects.hpp>
#include <supernormal/shapes/shape.hpp>
#include <variant>
#include <vector>

#include "common/drive.hpp"
#include "common/mesh.hpp"
#include "common/motion.hpp"
#include "geometry.hpp"

namespace falling_particles {

using namespace common;

/// A wall that is free in all six degrees of freedom. Its weight and the forces of its contacts move it.
struct Flight {
  double mass = 0;                                    ///< kg
  Vector3 centre = Vector3::Zero();                   ///< m, of mass, in the wall's frame
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< kg m^2, about the centre, in the wall's frame
  WallVelocity velocity = {};                         ///< of the centre of mass, when the flight starts
  double from = 0;                                    ///< s; until then the wall is held
};

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

std::vector<std::string> names_of(std::span<const Wall> walls);

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

constexpr supernormal::effects::Material kGrainMaterial = 0;
constexpr supernormal::effects::Material kWallMaterial = 1;
constexpr auto kGrainOnWall = supernormal::effects::MaterialSelector::between(kGrainMaterial, kWallMaterial);

/// The largest number of walls with coefficients of their own.
inline constexpr int kMostWallMaterials = 60;

/// Pa; the contact modulus E* of two bodies of this material (Johnson, Contact Mechanics, 4.2).
inline double contact_modulus(const supernormal::effects::Hertz& hertz) {
  return hertz.youngs_modulus / (2 * (1 - hertz.poisson_ratio * hertz.poisson_ratio));
}

/// The common material of walls, or a material of its own for a wall with coefficients of its own.
supernormal::effects::Material material_of_wall(const std::vector<Wall>& walls, std::size_t index);

/// Adds the effects of walls with coefficients of their own. A coefficient that such a wall does not have is the one of all walls.
void add_wall_effects(const std::vector<Wall>& walls, std::vector<supernormal::effects::Effect>& effects);

/// Collects doubts about walls. Six servos of a cell would get six near-equal sentences: of each kind, the worst gets its sentence,
/// which then names the others.
class WallDoubts {
 public:
  /// `kind`: of doubts that one remedy ends; `excess`: how bad this one is; `text`: what follows the name of the wall.
  void add(const std::string& kind, const Wall& wall, double excess, const std::string& text);

  /// Adds a sentence for each kind, in the order of their first walls.
  void tell(std::vector<std::string>& doubts) const;

 private:
  struct Doubt {
    std::string kind, wall;
    double excess;
    std::string sentence;
  };
  std::vector<std::vector<Doubt>> kinds_;
};

}  // namespace falling_particles
