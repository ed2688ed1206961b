// A convex geom as a shape of the core.
#pragma once

#include <ode/ode.h>

#include <array>

#include "ode/colliders/convex/primitives.hpp"
#include "supernormal/proximity/pose.hpp"

namespace supernormal::ode {

/// A geom of ours, a convex geom of ODE, or a dRay as a segment. The pose has the geom's position. The vertices of a dConvex belong
/// to the thread, so there is one at a time.
class PosedShape {
 public:
  /// Throws std::invalid_argument if the geom has no shape or is of another class, or if its numbers are refused.
  explicit PosedShape(dGeomID geom);
  ~PosedShape() = default;
  PosedShape(const PosedShape&) = delete;
  PosedShape(PosedShape&&) = delete;
  PosedShape& operator=(const PosedShape&) = delete;
  PosedShape& operator=(PosedShape&&) = delete;

  const Shape& shape() const { return *shape_; }
  const Pose& pose() const { return pose_; }

 private:
  void take_hull(dGeomID convex);
  void take_ray(dGeomID ray);

  KeptShape kept_;
  std::array<Vector3, 2> ends_;
  const Shape* shape_ = nullptr;
  Pose pose_;
};

/// Whether the class of a geom has a PosedShape.
bool has_shape(dGeomID geom);

}  // namespace supernormal::ode
