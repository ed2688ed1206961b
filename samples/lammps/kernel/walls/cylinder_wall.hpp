// A drum or a pipe with particles inside.
#pragma once

#include "kernel/walls/wall.hpp"

namespace granular {

/// The outside of an infinite cylinder.
///
/// A body K sticks out of a cylinder by max |p - axis| - radius over its points p, and since |p| is the largest p.u over the unit
/// vectors u across the axis, that is the largest support function h(u) of the body, seen from the axis, less the radius: one
/// unknown angle. Each of its maxima is a contact, so that a long particle lies on both of its ends.
class CylinderWall final : public Wall {
 public:
  /// A point of the axis, m; its direction, of any length but 0; the radius, m, > 0. std::invalid_argument otherwise.
  CylinderWall(const Vector3& point, const Vector3& axis, double radius);

  void add_contacts(const ParticleShape& shape, const supernormal::Pose& pose, std::vector<WallContact>& contacts) override;

 private:
  Vector3 point_;
  Vector3 across1_, across2_;  // unit, with the axis a frame
  double radius_;
};

}  // namespace granular
