// One geom of every convex kind that collides with a body of ours, for tests that make the same checks for all of them.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "support/ode_fixture.hpp"

namespace supernormal::test {

enum class ColliderKind { Body, Plane, Sphere, Box, Capsule, Cylinder, Convex };

inline constexpr std::array kColliderKinds = {ColliderKind::Body,  ColliderKind::Plane,   ColliderKind::Sphere,
                                              ColliderKind::Box,   ColliderKind::Capsule, ColliderKind::Cylinder,
                                              ColliderKind::Convex};

/// The kinds that have a place and are solved as pairs.
inline constexpr std::array kSolidKinds = {ColliderKind::Body,    ColliderKind::Sphere,   ColliderKind::Box,
                                           ColliderKind::Capsule, ColliderKind::Cylinder, ColliderKind::Convex};

inline std::string name_of(ColliderKind kind) {
  constexpr std::array kNames = {"body", "dPlane", "dSphere", "dBox", "dCapsule", "dCylinder", "dConvex"};
  return kNames[static_cast<std::size_t>(kind)];
}

/// The arrays to which a dConvex refers. Our library reads only the points; ODE requires planes and polygons.
class ConvexArrays {
 public:
  explicit ConvexArrays(const std::vector<Vec>& points) {
    for (const Vec& point : points) {
      for (const double coordinate : point) points_.push_back(dReal(coordinate));
    }
    points_.resize(points_.size() + 9);  // ODE reads a triangle, here of points behind the valid ones
    const auto first = static_cast<unsigned>(points.size());
    polygon_ = {3, first, first + 1, first + 2};
    count_ = first;
  }

  dGeomID create(dSpaceID space) const { return dCreateConvex(space, plane_.data(), 1, points_.data(), count_, polygon_.data()); }
  void give_to(dGeomID convex) const { dGeomSetConvex(convex, plane_.data(), 1, points_.data(), count_, polygon_.data()); }

 private:
  std::vector<dReal> points_;
  std::vector<dReal> plane_ = {0, 0, 1, 100};
  std::vector<unsigned> polygon_;
  unsigned count_ = 0;
};

/// A dConvex and its arrays.
class ConvexGeom {
 public:
  explicit ConvexGeom(const std::vector<Vec>& points, dSpaceID space = nullptr) : arrays_(points), geom_(arrays_.create(space)) {}
  operator dGeomID() const { return geom_; }  // NOLINT(google-explicit-constructor): as ODE's own dGeom

 private:
  ConvexArrays arrays_;
  Geom geom_;
};

/// Draws 4 to 20 points in a box with sides 0.6...2 around the origin.
inline std::vector<Vec> random_hull(Random& random) {
  const Vec half = {random.uniform(0.3, 1), random.uniform(0.3, 1), random.uniform(0.3, 1)};
  std::vector<Vec> points(static_cast<std::size_t>(random.uniform(4, 21)));
  for (Vec& point : points) {
    const Vec n = random.direction();
    point = {half[0] * n[0], half[1] * n[1], half[2] * n[2]};
  }
  return points;
}

/// A geom of a kind in a random orientation, 0.2...2 across.
class ColliderGeom {
 public:
  ColliderGeom(ColliderKind kind, Random& random, dSpaceID space = nullptr)
      : arrays_(kind == ColliderKind::Convex ? random_hull(random) : std::vector<Vec>()), geom_(create(kind, random, space)) {
    if (kind != ColliderKind::Plane) random.turn(geom_);
  }
  explicit ColliderGeom(dGeomID geom) : arrays_({}), geom_(geom) {}
  operator dGeomID() const { return geom_; }  // NOLINT(google-explicit-constructor): as ODE's own dGeom

 private:
  dGeomID create(ColliderKind kind, Random& random, dSpaceID space) const {
    const auto length = [&](double low, double high) { return dReal(random.uniform(low, high)); };
    const dReal x = length(0.2, 2), y = length(0.2, 2), z = length(0.2, 2);
    const Vec n = random.direction();
    switch (kind) {
      case ColliderKind::Body:
        return random_body(random, space);
      case ColliderKind::Plane:
        return dCreatePlane(space, dReal(n[0]), dReal(n[1]), dReal(n[2]), length(-1.5, -0.2));
      case ColliderKind::Sphere:
        return dCreateSphere(space, x / 2);
      case ColliderKind::Box:
        return dCreateBox(space, x, y, z);
      case ColliderKind::Capsule:
        return dCreateCapsule(space, x / 2, y);
      case ColliderKind::Cylinder:
        return dCreateCylinder(space, x / 2, y);
      case ColliderKind::Convex:
        return arrays_.create(space);
    }
    return nullptr;
  }

  ConvexArrays arrays_;
  Geom geom_;
};

/// Half of the smallest extent of the geom's box, with the geom rotated parallel to the axes.
inline double size_of(dGeomID geom) {
  dMatrix3 turned;
  std::copy(dGeomGetRotation(geom), dGeomGetRotation(geom) + 12, turned);
  dMatrix3 identity;
  dRSetIdentity(identity);
  dGeomSetRotation(geom, identity);
  dReal aabb[6];
  dGeomGetAABB(geom, aabb);
  dGeomSetRotation(geom, turned);
  return 0.5 * double{std::min({aabb[1] - aabb[0], aabb[3] - aabb[2], aabb[5] - aabb[4]})};
}

/// Moves the body from outside straight to the collider and `depth` into it. It overlaps by this depth, or by less if another
/// translation separates it.
inline void overlap(dGeomID body, dGeomID collider, double depth, Random& random) {
  place(body, 6.0 * random.direction());
  snProximity apart;
  snGeomProximity(body, collider, &apart);
  move(body, (apart.gap + depth) * to_vec(apart.normal));
}

}  // namespace supernormal::test
