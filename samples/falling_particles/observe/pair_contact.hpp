// The contacts of a step, a pair of bodies at a time, with their forces.
#pragma once

#include <ode/ode.h>

#include <deque>
#include <supernormal/effects.hpp>
#include <vector>

#include "world/contact_joints.hpp"
#include "world/world.hpp"

namespace falling_particles {

using supernormal::Vector3;

/// The contact of a grain with another one or with a wall: all points in which the two meet, up to kContactsPerPair for each
/// pair of their bodies, are one contact, and their forces are summed. In a periodic cell the bodies are those of the images that
/// meet; where some points of a contact are on one side of the cell and some on the other, they are put together at the first.
struct PairContact {
  const Grain* grain1;  ///< of lower index; never a wall
  const Grain* grain2;  ///< null for a wall
  dGeomID geom2;        ///< of body 2, an image's maybe, or of the wall
  Vector3 centre1;      ///< m, of body 1 when the contact was found: before the step whose forces these are
  Vector3 centre2;      ///< m, of body 2; of a wall it is `position`
  Vector3 position;     ///< m, mean of the points, weighted by their normal forces where these push
  Vector3 normal;       ///< unit, towards body 1, a mean likewise
  double overlap;       ///< m, of the deepest point
  Vector3 force;        ///< N, on body 1
  Vector3 moment;       ///< N m, on body 1 about the origin, of the points' forces
  int points;

  double normal_force() const { return force.dot(normal); }  ///< N, positive where it pushes
  bool bears_force() const { return normal_force() > 0; }
};

/// The contacts that a measuring step of length `step` (s) left, sorted by their bodies, walls last.
std::vector<PairContact> gather_contacts(const std::deque<MeasuredContact>& measured, const World& world, double step);

}  // namespace falling_particles
