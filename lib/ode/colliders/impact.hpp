// Time of impact of two geoms that move with the velocities of their bodies.
#pragma once

#include <ode/ode.h>

#include <algorithm>

#include "supernormal/impact/time_of_impact.hpp"

namespace supernormal::ode {

/// The motion of a geom with this pose: its body moves it about the centre of mass. Without a body it rests.
Motion motion_of(dGeomID geom, const Pose& pose);

/// The first impact of a geom of ours (body 1) and a collider. Throws std::invalid_argument when the pair is not supported.
Impact find_impact(dGeomID ours, dGeomID collider, double horizon);

/// The first impact of a geom of ours with a surface of triangles.
Impact find_trimesh_impact(dGeomID ours, dGeomID collider, double horizon);
Impact find_heightfield_impact(dGeomID ours, dGeomID collider, double horizon);

/// The path of a body past a surface, in pieces no longer than a few of its sizes. So few triangles are near each piece.
class Path {
 public:
  /// `reach` (m): radius of a ball about the body's centre of mass that contains the body.
  Path(const Motion& body, const Motion& surface, double reach, double horizon);

  /// The farthest that any point of the body moves relative to the surface in one piece, m.
  double travel() const { return travel_; }

  /// Calls find(body, surface, duration) for each piece in turn, with the motions at its start, until the first impact.
  Impact first(auto find) const {
    Impact all;
    int evaluations = 0;
    for (int piece = 0; piece < pieces_; ++piece) {
      const double start = horizon_ * piece / pieces_;
      const double duration = horizon_ * (piece + 1) / pieces_ - start;
      all = find(later(body_, start), later(surface_, start), duration);
      evaluations += all.evaluations;
      all.time = std::min(all.time + start, horizon_);
      all.apart_until = std::min(all.apart_until + start, horizon_);
      if (all.status != ImpactStatus::Apart) break;
    }
    all.evaluations = evaluations;
    return all;
  }

 private:
  static Motion later(const Motion& motion, double time);

  Motion body_, surface_;
  double horizon_;     // s
  double travel_ = 0;  // m
  int pieces_ = 1;
};

}  // namespace supernormal::ode
