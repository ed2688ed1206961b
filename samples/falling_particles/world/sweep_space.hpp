// ODE's sweep-and-prune space with a changing axis.
#pragma once

#include <ode/ode.h>

#include <array>
#include <optional>

#include "model/axis.hpp"

namespace falling_particles {

/// ODE's sweep-and-prune space along the axis that suits the positions of the bodies. A sweep tests every pair of bounding boxes
/// that overlap along its axis. For N bodies spread over a length L these are about N^2 d / L, with d their diameter, so the axis
/// of the largest spread is the best (Ericson 2005, section 7.5.1). Grains that wait to fall form a tower, and settle to a bed
/// that is wider than high: so the axis is chosen again during a run, from their positions alone.
///
/// It is for bodies with finite bounding boxes. Others belong outside: ODE would pair them with every other geom.
class SweepSpace {
 public:
  /// Always sweeps along `axis`, if there is one.
  explicit SweepSpace(std::optional<Axis> axis);
  ~SweepSpace();
  SweepSpace(const SweepSpace&) = delete;
  SweepSpace& operator=(const SweepSpace&) = delete;

  dSpaceID id() const { return space_; }  ///< valid until the axis is chosen again
  Axis axis() const { return order_[0]; }

  /// Chooses the axis in the first step and again now and then; call it before a step.
  void before_step();

  /// Calls visit(geom) for all geoms but the marks.
  template <typename Visit>
  void for_each_geom(const Visit& visit) const {
    const int count = dSpaceGetNumGeoms(space_);
    for (int i = 0; i < count; ++i) {
      const dGeomID geom = dSpaceGetGeom(space_, i);
      if (!is_end_marker(geom)) visit(geom);
    }
  }

  /// In the near callback of dSpaceCollide: whether this is no pair of bodies, but the mark after the last one.
  bool is_end_marker(dGeomID geom) const { return geom == markers_[0] || geom == markers_[1]; }

 private:
  using Order = std::array<Axis, 3>;
  void choose_axis();
  void move_to(const Order& order);

  std::optional<Axis> fixed_;
  Order order_;
  dSpaceID space_ = nullptr;
  std::array<dGeomID, 2> markers_ = {};
  int steps_ = 0;
};

}  // namespace falling_particles
