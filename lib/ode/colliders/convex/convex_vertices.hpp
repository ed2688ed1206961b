// The vertices of a dConvex. ODE has no function that returns them.
#pragma once

#include <ode/ode.h>

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal::ode {

/// Collides the geom with a plane through its middle, from both sides. The contacts are its vertices (dCollideConvexPlane in the
/// convex.cpp of ODE). Every query reads them again, because dGeomSetConvex may have changed them. Keep an instance to reuse its
/// memory.
class ConvexVertices {
 public:
  ConvexVertices();
  ~ConvexVertices();
  ConvexVertices(const ConvexVertices&) = delete;
  ConvexVertices(ConvexVertices&&) = delete;
  ConvexVertices& operator=(const ConvexVertices&) = delete;
  ConvexVertices& operator=(ConvexVertices&&) = delete;

  /// Returns false when the pose of the geom or a vertex is not finite. Throws std::invalid_argument when the vertices cannot be
  /// read: more than 65534 on one side, none at all, or a bounding box that is stale since dGeomSetConvex (dGeomMoved renews it).
  bool read(dGeomID convex);

  /// The vertices, m, in the frame of pose(). Each occurs once. The order depends only on vertices and pose.
  std::span<const Vector3> points() const { return points_; }

  /// A hash of the vertices, independent of their order and of the pose.
  double fingerprint() const;

  /// The orientation of the geom, with the middle of its vertices as origin.
  const Pose& pose() const { return pose_; }

 private:
  bool list(dGeomID convex, const Eigen::AlignedBox3d& box);
  bool list_below(dGeomID convex, int axis, double side, double offset, bool with_plane);
  void move_to_middle(const Pose& geom_pose);

  dGeomID plane_;  // not in a space; outlives dCloseODE
  std::vector<dContactGeom> contacts_;
  std::vector<Vector3> points_;
  Pose pose_;
};

}  // namespace supernormal::ode
