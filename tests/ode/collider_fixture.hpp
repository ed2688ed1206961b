// One geom of every convex kind that collides with a body of ours, for tests that make the same checks for all of them; bodies of
// every kind; poses in the form of the core.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "supernormal/proximity/pose.hpp"
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

inline dReal ellipsoid_support(const void* user, const dReal direction[3]) {
  const auto* const axes = static_cast<const dReal*>(user);
  return std::hypot(axes[0] * direction[0], axes[1] * direction[1], axes[2] * direction[2]);
}

inline void ellipsoid_point(const void* user, const dReal direction[3], dReal point[3]) {
  const auto* const axes = static_cast<const dReal*>(user);
  const dReal h = ellipsoid_support(user, direction);
  for (int k = 0; k < 3; ++k) point[k] = axes[k] * axes[k] * direction[k] / h;
}

inline dReal user_axes[3] = {dReal(0.6), dReal(0.9), dReal(0.4)};

/// Draws a body of any kind: ellipsoids; round, boxy and pointed superellipsoids; rounded bodies; user shapes.
inline dGeomID draw_body(Random& random) {
  const auto axis = [&] { return dReal(random.uniform(0.2, 1)); };
  const auto exponent = [&] { return dReal(1 + 0.02 * std::pow(1e4, random.uniform(0, 1))); };  // 1.02…201
  const dReal a = axis(), b = axis(), c = axis(), delta = exponent(), epsilon = exponent();
  const double sort = random.uniform(0, 6);
  const snShape shape = {ellipsoid_support, ellipsoid_point, nullptr, user_axes, nullptr};
  const dGeomID geom = sort < 1   ? snCreateEllipsoid(nullptr, a, b, c)
                       : sort < 2 ? snCreateConvex(nullptr, &shape)
                                  : snCreateSuperellipsoid(nullptr, a, b, c, delta, epsilon);
  if (sort > 5) snGeomSetRounding(geom, dReal(random.uniform(0.01, 0.3)));
  random.turn(geom);
  return geom;
}

/// Poses and vectors of ODE in the form of the core.
inline Eigen::Vector3d to_eigen(const Vec& v) { return {v[0], v[1], v[2]}; }

inline Pose pose_of(dGeomID geom) {
  const dReal* const rotation = dGeomGetRotation(geom);
  Pose pose{to_eigen(to_vec(dGeomGetPosition(geom))), {}};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) pose.rotation(row, column) = double{rotation[4 * row + column]};
  }
  return pose;
}

}  // namespace supernormal::test
