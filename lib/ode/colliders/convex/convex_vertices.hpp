// The vertices of a dConvex, which ODE has no function to ask for.
#pragma once

#include <ode/ode.h>

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal::ode {

/// Collides the geom with a plane through its middle, from both sides: the contacts are all its vertices (dCollideConvexPlane in
/// ODE's convex.cpp). They are read anew for every query, because dGeomSetConvex may have changed them. Keeps its memory from one
/// query to the next.
class ConvexVertices {
 public:
  ConvexVertices();
  ~ConvexVertices();
  ConvexVertices(const ConvexVertices&) = delete;
  ConvexVertices(ConvexVertices&&) = delete;
  ConvexVertices& operator=(const ConvexVertices&) = delete;
  ConvexVertices& operator=(ConvexVertices&&) = delete;

  /// Returns false when the pose of the geom or one of its vertices is not finite. Throws std::invalid_argument when ODE does not
  /// tell its vertices: more than 65534 on one side, none at all, or a bounding box that is out of date since dGeomSetConvex
  /// (dGeomMoved renews it).
  bool read(dGeomID convex);

  /// The vertices, m, in the frame of pose(). Each is listed once, in an order that depends on nothing but vertices and pose.
  std::span<const Vector3> points() const { return points_; }

  /// A number for the vertices, whatever their order and wherever the geom is: another one for other vertices.
  double fingerprint() const;

  /// The attitude of the geom, with the middle of its vertices as origin.
  const Pose& pose() const { return pose_; }

 private:
  bool list(dGeomID convex, const Eigen::AlignedBox3d& box);
  bool list_below(dGeomID convex, int axis, double side, double offset, bool with_plane);
  void move_to_middle(const Pose& geom_pose);

  dGeomID plane_;  // not in a space; it outlives dCloseODE
  std::vector<dContactGeom> contacts_;
  std::vector<Vector3> points_;
  Pose pose_;
};

}  // namespace supernormal::ode
