#pragma once

#include <ode/ode.h>

#include <array>
#include <optional>

namespace falling_particles {

enum class Axis { X, Y, Z };

/// "x", "y" or "z"
const char* name_of(Axis axis);

/// ODE's sweep-and-prune space with the axis that suits where the bodies are. A sweep tests every pair of bounding boxes that
/// overlap along its axis; of N bodies spread over a length L these are about N^2 d / L, d their diameter, so the axis of the
/// largest spread is the best (Ericson 2005, section 7.5.1). Grains that wait to fall form a tower, and settle to a bed that is
/// wider than high: so the axis is chosen again as they go, from their positions alone.
///
/// For bodies with finite bounding boxes. What has none belongs outside: ODE would pair it with every other geom.
class SweepSpace {
 public:
  /// Always sweeps along `axis`, if there is one.
  explicit SweepSpace(std::optional<Axis> axis);
  ~SweepSpace();
  SweepSpace(const SweepSpace&) = delete;
  SweepSpace& operator=(const SweepSpace&) = delete;

  dSpaceID id() const { return space_; }  ///< until the axis is chosen again
  Axis axis() const { return order_[0]; }

  /// Before a step: chooses the axis in the first one and again now and then.
  void before_step();

  /// In the near callback of dSpaceCollide: this is no pair of bodies, but says that none follows.
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
