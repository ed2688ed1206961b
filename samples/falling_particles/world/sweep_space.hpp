// ODE's sweep-and-prune space with an axis that is chosen at run time.
#pragma once

#include <ode/ode.h>

#include <array>

#include "model/geometry.hpp"

namespace falling_particles {

/// ODE's sweep-and-prune space along the best axis for the positions of the bodies. A sweep tests every pair of bounding boxes that
/// overlap along its axis. N bodies of diameter d over a length L have about N^2 d / L such pairs. So the axis of the largest
/// spread is the best (Ericson 2005, section 7.5.1). Grains start as a tower and settle to a wide bed. So the axis is chosen again
/// during a run, from the positions alone.
///
/// All bodies must have finite bounding boxes. ODE pairs a geom with an infinite box with every other geom.
class SweepSpace {
 public:
  SweepSpace();
  ~SweepSpace();
  SweepSpace(const SweepSpace&) = delete;
  SweepSpace& operator=(const SweepSpace&) = delete;

  dSpaceID id() const { return space_; }  ///< valid until the axis changes
  Axis axis() const { return order_[0]; }

  /// Chooses the axis in the first step and again at intervals. Call it before a step.
  void before_step();

  /// Calls visit(geom) for all geoms but the end markers.
  void for_each_geom(const auto& visit) const {
    const int count = dSpaceGetNumGeoms(space_);
    for (int i = 0; i < count; ++i) {
      const dGeomID geom = dSpaceGetGeom(space_, i);
      if (!is_end_marker(geom)) visit(geom);
    }
  }

  /// Whether the geom is an end marker. ODE names the pair of end markers after all pairs of bodies, in the near callback of
  /// dSpaceCollide.
  bool is_end_marker(dGeomID geom) const { return geom == markers_[0] || geom == markers_[1]; }

 private:
  using Order = std::array<Axis, 3>;
  void choose_axis();
  void move_to(const Order& order);

  Order order_ = {Axis::X, Axis::Y, Axis::Z};
  dSpaceID space_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
  std::array<dGeomID, 2> markers_ = {};
  int steps_ = 0;
};

}  // namespace falling_particles
