// Places of a body at a partner.
#pragma once

#include <array>
#include <optional>

#include "ode_bodies.hpp"
#include "random.hpp"
#include "supernormal/solvers/pose.hpp"

namespace accuracy_cost {

inline constexpr int kMaxContacts = 16;  // of a query

struct OdePair {
  dGeomID body;
  dGeomID partner;

  void move_body(const supernormal::Pose& pose) const;
  int collide(std::array<dContactGeom, kMaxContacts>& contacts) const;
};

/// How a body comes to its partner; the same for all bodies.
struct Approach {
  supernormal::Matrix3 attitude;   ///< of the body
  supernormal::Vector3 start;      ///< m; of its centre: inside the partner
  supernormal::Vector3 direction;  ///< unit; out of it
  supernormal::Matrix3 partner_attitude;
  supernormal::Vector3 ray;  ///< unit; perpendicular to the direction
  supernormal::Pose nudge;   ///< of the body, to the other of two poses that follow one another: 1e-3 m, 1e-3 rad

  static Approach draw(PartnerClass partner, falling_particles::Random& random);
  void move_partner(PartnerClass partner, dGeomID geom) const;
  std::array<supernormal::Pose, 2> poses_at(double distance) const;
};

/// The distance from the start of the approach at which the body ceases to collide, by what dCollide says; nothing if it does
/// nowhere.
std::optional<double> touching_distance(const OdePair& pair, const Approach& approach);

}  // namespace accuracy_cost
