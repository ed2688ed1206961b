// Rigid surfaces in contact with particles: a plane, a box and a cylinder; mesh_wall.hpp has triangles.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "kernel/face_contact.hpp"
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

/// The half-space behind a plane.
class PlaneWall final : public Wall {
 public:
  /// A point of the plane, m, and its normal out of the wall, any length but 0. Throws std::invalid_argument otherwise.
  PlaneWall(const Vector3& point, const Vector3& normal);

  void add_contacts(const ParticleShape& shape, const supernormal::Pose& pose, std::vector<WallContact>& contacts) override;

 private:
  Vector3 normal_;
  double offset_;  // m; normal . x on the plane
};

/// Six flat walls that face inwards.
class BoxWall final : public Wall {
 public:
  /// The lowest and the highest corner, m. Throws std::invalid_argument unless low < high.
  BoxWall(const Vector3& low, const Vector3& high);

  void add_contacts(const ParticleShape& shape, const supernormal::Pose& pose, std::vector<WallContact>& contacts) override;

 private:
  std::vector<std::unique_ptr<PlaneWall>> sides_;
};

/// The outside of an infinite cylinder.
///
/// A body K protrudes from a cylinder by max |p - axis| - radius over its points p. |p| is the largest p.u over the unit vectors u
/// perpendicular to the axis. So the protrusion is the largest support function h(u) of the body, relative to the axis, minus the
/// radius. This leaves one unknown angle. Each maximum is a contact, so a long particle rests on both of its ends. The minimum
/// between two of them is subtracted.
class CylinderWall final : public Wall {
 public:
  /// A point of the axis, m; its direction, any length but 0; the radius, m, > 0. Throws std::invalid_argument otherwise.
  CylinderWall(const Vector3& point, const Vector3& axis, double radius);

  void add_contacts(const ParticleShape& shape, const supernormal::Pose& pose, std::vector<WallContact>& contacts) override;

 private:
  Vector3 point_;
  Vector3 across1_, across2_;  // unit; a frame together with the axis
  double radius_;
};

}  // namespace granular
