// When two geoms will meet, with the velocities of their bodies.
#pragma once

#include <ode/ode.h>

#include <algorithm>

#include "supernormal/impact/time_of_impact.hpp"

namespace supernormal::ode {

/// The motion of a geom that has this pose: that of its body, about the body's centre of mass; at rest without a body.
Motion motion_of(dGeomID geom, const Pose& pose);

/// The first impact of a geom of ours (body 1) and a collider. Throws std::invalid_argument when the pair is not supported.
Impact find_impact(dGeomID ours, dGeomID collider, double horizon);

/// A geom of ours on its way past a surface of triangles.
Impact find_trimesh_impact(dGeomID ours, dGeomID collider, double horizon);
Impact find_heightfield_impact(dGeomID ours, dGeomID collider, double horizon);

/// The way of a body past a surface, in pieces that are no longer than a few of its sizes: so few triangles are near each.
class Way {
 public:
  /// `reach` (m): a ball of this radius about the body's centre of mass holds the body.
  Way(const Motion& body, const Motion& surface, double reach, double horizon);

  /// m; no point of the body comes farther in one piece, as seen from the surface.
  double travel() const { return travel_; }

  /// Calls find(body, surface, duration) for one piece after the other, with the motions at the start of each, up to the first
  /// impact.
  template <typename Find>
  Impact first(Find find) const {
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
