// The contacts of a step with their forces, one for each pair of grains or of grain and wall.
#pragma once

#include <ode/ode.h>

#include <deque>
#include <supernormal/effects.hpp>
#include <vector>

#include "world/stepper.hpp"
#include "world/world.hpp"

namespace falling_particles {

using supernormal::Vector3;

/// The contact of a grain with another grain or with a wall. A pair of bodies has up to kContactsPerPair points. All points of a
/// pair of grains form one contact. Its force is the sum of their forces. In a periodic cell the grains are the images that meet.
/// Points on both sides of the cell are shifted to the side of the first one.
struct PairContact {
  const Grain* grain1;  ///< the grain with the lower index; never null
  const Grain* grain2;  ///< null for a wall
  dGeomID geom2;        ///< of grain 2, possibly of an image, or of the wall
  Vector3 centre1;      ///< m, of grain 1 when the contact was found: before the step with these forces
  Vector3 centre2;      ///< m, of grain 2; `position` for a wall
  Vector3 position;     ///< m, mean of the points, weighted by their repulsive normal forces
  Vector3 normal;       ///< unit, towards grain 1; a mean with the same weights
  double overlap;       ///< m, of the deepest point
  Vector3 force;        ///< N, on grain 1
  Vector3 moment;       ///< N m, of these forces, on grain 1 about the origin
  int points;

  double normal_force() const { return force.dot(normal); }  ///< N, positive if repulsive
  bool bears_force() const { return normal_force() > 0; }
};

/// The contacts of a measuring step of length `step` (s), sorted by their grains, walls last.
std::vector<PairContact> gather_contacts(const std::deque<MeasuredContact>& measured, const World& world, double step);

}  // namespace falling_particles
