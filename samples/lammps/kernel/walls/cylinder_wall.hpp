// A drum or a pipe around the particles.
#pragma once

#include "kernel/walls/wall.hpp"

namespace granular {

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
