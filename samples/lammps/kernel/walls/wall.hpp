// A rigid surface in contact with particles.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "kernel/ground.hpp"
#include "kernel/particle_shape.hpp"
#include "supernormal/proximity/pose.hpp"

namespace granular {

/// The cosine of the angle between normals up to which they belong to one contact, 22.5 degrees.
inline const double kSameNormal = std::cos(std::numbers::pi / 8);

/// An overlap of a particle and a wall, in the frame of the wall.
struct WallContact {
  Vector3 normal;                       ///< unit, from the particle to the wall
  Vector3 point;                        ///< m; where the force acts
  double depth = 0;                     ///< m; > 0, or > -bulge of the particle if there is ground or a pipe
  Matrix3 curvature = Matrix3::Zero();  ///< 1/m; of the wall; negative where it is concave
  std::optional<Ground> ground{};       ///< on which faces and sides rest; until the next query
  std::optional<Pipe> pipe{};           ///< along which sides lie
  /// Whether the depth is a minimum between two contacts. Its energy and force are subtracted: where one contact becomes two, the
  /// minimum is as deep as they are, and the sum goes on without a jump.
  bool is_between = false;
};

/// A wall at rest in its own frame.
class Wall {
 public:
  Wall() = default;
  Wall(const Wall&) = delete;
  Wall& operator=(const Wall&) = delete;
  virtual ~Wall() = default;

  /// Appends the contacts of a particle. `pose` is in the frame of the wall.
  virtual void add_contacts(const ParticleShape& shape, const supernormal::Pose& pose, std::vector<WallContact>& contacts) = 0;
};

}  // namespace granular
