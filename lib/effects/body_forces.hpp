// Forces on bodies: each listed effect makes one pass over the added bodies.
#pragma once

#include <ode/ode.h>

#include <optional>
#include <vector>

#include "effects/pair_material.hpp"
#include "supernormal/effects.hpp"
#include "supernormal/shapes/submerged_volume.hpp"

namespace supernormal::effects {

class BodyForces {
 public:
  BodyForces(const std::vector<Effect>& list, double step);

  bool is_empty() const { return !quadratic_drag_ && !stokes_drag_ && !buoyancy_; }

  void add(dBodyID body);
  void remove(dBodyID body);

  /// A pass of one effect over the awake bodies; `run` returns the number of bodies that it visited.
  struct Listed {
    EffectIndex effect;
    unsigned long long (BodyForces::*run)();
  };
  const std::vector<Listed>& passes() const { return passes_; }

 private:
  /// One of our geoms on a body; a body may have several.
  struct Part {
    dGeomID geom;
    const Shape* shape;
    double surface = 0;                               // m^2; for Stokes drag
    std::optional<SubmergedVolume> submerged_volume;  // for buoyancy
  };
  struct Entry {
    dBodyID body;
    std::vector<Part> parts;
  };

  template <typename Force>
  unsigned long long visit(const Force& force);
  unsigned long long apply_buoyancy();
  unsigned long long apply_quadratic_drag();
  unsigned long long apply_stokes_drag();

  double step_;
  Vector3 gravity_ = Vector3::Zero();
  std::optional<QuadraticDrag> quadratic_drag_;
  std::optional<StokesDrag> stokes_drag_;
  std::optional<Buoyancy> buoyancy_;
  std::vector<Listed> passes_;
  std::vector<Entry> bodies_;
};

}  // namespace supernormal::effects
