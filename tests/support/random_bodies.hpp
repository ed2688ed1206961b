// Random pairs of every kind of body, placed at a normal.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/superellipsoid_classes.hpp"
#include "support/without_hessian.hpp"

namespace supernormal::test {

enum class RandomPartner { Superellipsoid, WithoutHessian, Box, Capsule, Cylinder, Polytope };

/// Body 1 is a superellipsoid of the class. Body 2 is another one, or a body with faces and edges. Without Hessians both are
/// callbacks.
struct RandomKind {
  std::string name;
  SuperellipsoidClass surfaces;
  RandomPartner partner;
};

/// Every class with itself, the widest classes with every collider, and some without Hessians.
inline std::vector<RandomKind> random_kinds() {
  std::vector<RandomKind> kinds;
  for (const SuperellipsoidClass& surfaces : kSuperellipsoidClasses) {
    kinds.push_back({surfaces.name, surfaces, RandomPartner::Superellipsoid});
  }
  const SuperellipsoidClass any{"any", 0.5, 1.5, 1.02, 200};
  kinds.push_back({"any and box", any, RandomPartner::Box});
  kinds.push_back({"any and capsule", any, RandomPartner::Capsule});
  kinds.push_back({"any and cylinder", any, RandomPartner::Cylinder});
  kinds.push_back({"any and polytope", any, RandomPartner::Polytope});
  for (const SuperellipsoidClass& surfaces : kSuperellipsoidClasses) {
    kinds.push_back({std::string(surfaces.name) + " without Hessians", surfaces, RandomPartner::WithoutHessian});
  }
  return kinds;
}

/// Body 1 is at the origin.
struct RandomPair {
  std::shared_ptr<const Shape> shape1, shape2;
  Pose pose2;
  double unit = 0;    ///< m; the smallest half-extent of the two
  double placed = 0;  ///< m; s at the normal at which the bodies were placed, where s is stationary

  double rolling_radius() const { return shape1->rolling_radius() + shape2->rolling_radius(); }
};

class RandomBodies {
 public:
  RandomBodies(RandomKind kind, unsigned seed) : kind_(std::move(kind)), engine_(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }

  /// Two bodies in any orientation.
  RandomPair draw_apart() {
    RandomPair pair{body(), nullptr, {}, 0, 0};
    pair.shape2 = partner();
    pair.unit = std::min(pair.shape1->half_extents().minCoeff(), pair.shape2->half_extents().minCoeff());
    pair.pose2.rotation = Eigen::Quaterniond(Eigen::Vector4d{gauss_(engine_), gauss_(engine_), gauss_(engine_), gauss_(engine_)})
                              .normalized()
                              .toRotationMatrix();
    return pair;
  }

  /// Moves body 2 so that the witness points of a random normal are `gap` (m) apart along it. This is the gap if it is positive, or
  /// no deeper than the rolling radius. If it is deeper, another normal may be higher.
  void place(RandomPair& pair, double gap) {
    const Vector3 n = direction();
    const Vector3 point2 = pair.pose2.rotation * pair.shape2->point(-(pair.pose2.rotation.transpose() * n));
    pair.pose2.position = pair.shape1->point(n) + gap * n - point2;
    pair.placed = gap;
  }

  /// Both of these; `gap` in units of the smallest half-extent.
  RandomPair draw(double gap) {
    RandomPair pair = draw_apart();
    place(pair, gap * pair.unit);
    return pair;
  }

 private:
  // Braces, here and below, fix the order of evaluation.
  Vector3 direction() { return Vector3{gauss_(engine_), gauss_(engine_), gauss_(engine_)}.normalized(); }

  Vector3 lengths() {
    const double least = kind_.surfaces.least_axis, largest = kind_.surfaces.largest_axis;
    return Vector3{log_uniform(least, largest), log_uniform(least, largest), log_uniform(least, largest)};
  }

  std::shared_ptr<const Shape> surface() {
    const Vector3 half_axes = lengths();
    const double least = kind_.surfaces.least_exponent, largest = kind_.surfaces.largest_exponent;
    if (least == largest) return std::make_shared<Ellipsoid>(half_axes);
    const double delta = log_uniform(least, largest);
    return std::make_shared<Superellipsoid>(half_axes, delta, log_uniform(least, largest));
  }

  std::shared_ptr<const Shape> body() {
    if (kind_.partner != RandomPartner::WithoutHessian) return surface();
    return std::make_shared<CallbackShape>(without_hessian(surface()));
  }

  std::shared_ptr<const Shape> partner() {
    const Vector3 a = lengths();
    switch (kind_.partner) {
      case RandomPartner::Box:
        return std::make_shared<Box>(a);
      case RandomPartner::Capsule:
        return std::make_shared<Capsule>(a.x(), a.z());
      case RandomPartner::Cylinder:
        return std::make_shared<Cylinder>(a.x(), a.z());
      case RandomPartner::Polytope: {
        corners_.emplace_back(static_cast<std::size_t>(std::uniform_int_distribution<int>(4, 12)(engine_)));
        for (Vector3& corner : corners_.back()) corner = a.cwiseProduct(direction());
        return std::make_shared<Polytope>(corners_.back());
      }
      case RandomPartner::Superellipsoid:
      case RandomPartner::WithoutHessian:
        break;
    }
    return body();
  }

  RandomKind kind_;
  std::mt19937_64 engine_;
  std::normal_distribution<double> gauss_;
  std::vector<std::vector<Vector3>> corners_;  // points of the polytopes, which refer to them
};

}  // namespace supernormal::test
