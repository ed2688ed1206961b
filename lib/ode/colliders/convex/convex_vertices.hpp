// The vertices of a dConvex, which ODE has no function to ask for.
#pragma once

#include <ode/ode.h>

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal::ode {

/// Collides the geom with a plane through its middle, from both sides: the contacts are all its vertices (ode-facts section 2.3).
/// They are read anew for every query, because dGeomSetConvex may have changed them. Keeps its memory from one query to the next.
class ConvexVertices {
 public:
  ConvexVertices();
  ~ConvexVertices();
  ConvexVertices(const ConvexVertices&) = delete;
  ConvexVertices(ConvexVertices&&) = delete;
  ConvexVertices& operator=(const ConvexVertices&) = delete;
  ConvexVertices& operator=(ConvexVertices&&) = delete;

  /// False when the pose of the geom or one of its vertices is not finite. std::invalid_argument when ODE does not tell its
  /// vertices: more than 65534 on one side, none at all, or a bounding box that dGeomSetConvex has left behind (dGeomMoved renews
  /// it).
  bool read(dGeomID convex);

  /// m; in the frame of pose(). Each vertex once, in an order that depends on nothing but vertices and pose.
  std::span<const Vector3> points() const { return points_; }

  /// The axes of the geom, and the middle of its vertices.
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
