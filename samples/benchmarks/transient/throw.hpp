// Superellipsoids thrown into each other and into a box, in a world of ODE with any method for the pairs of bodies.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include "common/ode_world.hpp"
#include "pairs.hpp"

namespace transient {

using supernormal::Vector3;

struct Setup {
  accuracy_cost::BodyClass body_class = accuracy_cost::BodyClass::Ellipsoid;
  int bodies = 8;
  bool has_friction = false;  ///< friction of 0.5, gravity and no bounce; otherwise elastic, without friction and gravity
  double step = 1e-3;         ///< s
  std::uint64_t seed = 1;
};

/// The numbers of two bodies whose bounding boxes meet, the smaller first.
using Neighbours = std::pair<std::size_t, std::size_t>;

/// A method's answer for the two bodies: the contact, if they overlap.
struct Touch {
  bool overlaps = false;
  double depth = 0;                    ///< m
  Vector3 normal = Vector3::UnitX();   ///< unit, from body 1 to body 2
  Vector3 position = Vector3::Zero();  ///< m
};

/// The start depends only on the class, the number and the seed. A world can start displaced by 1e-12 of a body's size.
class Throw {
 public:
  Throw(const Setup& setup, bool is_disturbed);
  ~Throw();
  Throw(const Throw&) = delete;
  Throw& operator=(const Throw&) = delete;

  /// The present pairs, by exact bounding boxes.
  const std::vector<Neighbours>& neighbours();

  /// Makes a step with these contacts, one for each pair of neighbours(), and with the closed-form contacts at the walls.
  void step(const std::vector<Touch>& touches);

  std::size_t bodies() const { return bodies_.size(); }
  const std::shared_ptr<const supernormal::Shape>& shape(std::size_t body) const { return shapes_[body]; }
  supernormal::Pose pose(std::size_t body) const;
  Vector3 position(std::size_t body) const;

 private:
  void add_wall_contact(dGeomID geom1, dGeomID geom2);
  void place_bodies(bool is_disturbed);
  void add_contact(dContact& contact, dBodyID body1, dBodyID body2);

  Setup setup_;
  common::OdeWorld world_{dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ)};
  dSpaceID walls_ = dSimpleSpaceCreate(nullptr);
  std::vector<std::shared_ptr<const supernormal::Shape>> shapes_;
  std::vector<dBodyID> bodies_;
  std::deque<std::size_t> numbers_;  // numbers of the bodies; geoms refer to them
  std::vector<Neighbours> neighbours_;
};

}  // namespace transient
