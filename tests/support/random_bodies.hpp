// Random pairs of every kind of body, placed at a normal.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/linear_image.hpp"
#include "supernormal/shapes/minkowski_sum.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/shapes/superovoid.hpp"
#include "support/draw.hpp"
#include "support/superellipsoid_classes.hpp"
#include "support/without_hessian.hpp"

namespace supernormal::test {

enum class RandomPartner {
  Superellipsoid,
  WithoutHessian,
  Box,
  Capsule,
  Cylinder,
  Polytope,
  Triangle,
  Superovoid,
  Sum,
  Image,
  RoundedBox,
  Egg,   ///< h = 1 + k nz^3, by callbacks
  Lens,  ///< the intersection of two balls, which has a sharp edge, by callbacks
};

/// Body 1 is a superellipsoid of the class. Body 2 is another one, or a body of another shape. Without Hessians both are callbacks.
struct RandomKind {
  std::string name;
  SuperellipsoidClass surfaces;
  RandomPartner partner;
};

inline constexpr SuperellipsoidClass kAnySuperellipsoid = {"any", 0.5, 1.5, 1.02, 200};

/// Every class with itself, the widest classes with every collider, and some without Hessians.
inline std::vector<RandomKind> random_kinds() {
  std::vector<RandomKind> kinds;
  for (const SuperellipsoidClass& surfaces : kSuperellipsoidClasses) {
    kinds.push_back({surfaces.name, surfaces, RandomPartner::Superellipsoid});
  }
  kinds.push_back({"any and box", kAnySuperellipsoid, RandomPartner::Box});
  kinds.push_back({"any and capsule", kAnySuperellipsoid, RandomPartner::Capsule});
  kinds.push_back({"any and cylinder", kAnySuperellipsoid, RandomPartner::Cylinder});
  kinds.push_back({"any and polytope", kAnySuperellipsoid, RandomPartner::Polytope});
  for (const SuperellipsoidClass& surfaces : kSuperellipsoidClasses) {
    kinds.push_back({std::string(surfaces.name) + " without Hessians", surfaces, RandomPartner::WithoutHessian});
  }
  return kinds;
}

/// Superellipsoids and compositions, tapered bodies and user shapes.
inline std::vector<RandomKind> composed_kinds() {
  return {{"any and triangle", kAnySuperellipsoid, RandomPartner::Triangle},
          {"any and superovoid", kAnySuperellipsoid, RandomPartner::Superovoid},
          {"any and sum", kAnySuperellipsoid, RandomPartner::Sum},
          {"any and linear image", kAnySuperellipsoid, RandomPartner::Image},
          {"any and rounded box", kAnySuperellipsoid, RandomPartner::RoundedBox},
          {"any and egg", kAnySuperellipsoid, RandomPartner::Egg},
          {"any and lens", kAnySuperellipsoid, RandomPartner::Lens}};
}

/// Body 1 is at the origin.
struct RandomPair {
  std::shared_ptr<const Shape> shape1, shape2;
  Pose pose2;
  double unit = 0;    ///< m; the smallest half-extent of the two
  double placed = 0;  ///< m; s at the normal at which the bodies were placed, where s is stationary

  double rolling_radius() const { return shape1->rolling_radius() + shape2->rolling_radius(); }
};

class RandomBodies : public Draw {
 public:
  RandomBodies(RandomKind kind, unsigned seed) : Draw(seed), kind_(std::move(kind)) {}

  /// Two bodies in any orientation.
  RandomPair draw_apart() {
    RandomPair pair{body(), nullptr, {}, 0, 0};
    pair.shape2 = partner();
    pair.unit = std::min(pair.shape1->half_extents().minCoeff(), pair.shape2->half_extents().minCoeff());
    pair.pose2.rotation = rotation();
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
  Vector3 lengths() { return log_within(kind_.surfaces.least_axis, kind_.surfaces.largest_axis); }

  std::shared_ptr<const Shape> surface() {
    if (kind_.surfaces.least_exponent == kind_.surfaces.largest_exponent) return std::make_shared<Ellipsoid>(lengths());
    return std::make_shared<Superellipsoid>(draw_superellipsoid(kind_.surfaces, *this));
  }

  std::shared_ptr<const Shape> body() {
    if (kind_.partner != RandomPartner::WithoutHessian) return surface();
    return std::make_shared<CallbackShape>(without_hessian(surface()));
  }

  std::shared_ptr<const Shape> hull(int count, const Vector3& a) {
    corners_.emplace_back(static_cast<std::size_t>(count));
    for (Vector3& corner : corners_.back()) corner = a.cwiseProduct(direction());
    return std::make_shared<Polytope>(corners_.back());
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
      case RandomPartner::Triangle:
        return hull(3, a);
      case RandomPartner::Polytope:
        return hull(whole(4, 12), a);
      case RandomPartner::Superovoid: {
        const double delta = log_uniform(1.3, 20), epsilon = log_uniform(1.3, 20);
        const double taper = uniform(-0.9, 0.9) * Superovoid::max_taper(epsilon);
        return std::make_shared<Superovoid>(a, delta, epsilon, taper, taper);
      }
      case RandomPartner::Sum:
        return std::make_shared<MinkowskiSum>(
            surface(), std::make_shared<LinearImage>(std::make_shared<Sphere>(uniform(0.1, 0.5)), rotation()));
      case RandomPartner::Image: {
        Matrix3 matrix = rotation() * a.asDiagonal();
        matrix(0, 1) += uniform(-0.2, 0.2);
        return std::make_shared<LinearImage>(surface(), matrix);
      }
      case RandomPartner::RoundedBox:
        return std::make_shared<Rounded>(std::make_shared<Box>(a), uniform(0.05, 0.5));
      case RandomPartner::Egg: {
        const auto point = [k = uniform(0.02, 0.13)](const Vector3& n) -> Vector3 {
          return (1 - 2 * k * n.z() * n.z() * n.z()) * n + Vector3(0, 0, 3 * k * n.z() * n.z());
        };
        return std::make_shared<CallbackShape>([point](const Vector3& n) { return n.dot(point(n)); }, point);
      }
      case RandomPartner::Lens: {
        const double offset = uniform(0.2, 0.7), edge = std::sqrt(1 - offset * offset);
        const auto point = [offset, edge](const Vector3& n) -> Vector3 {
          if (std::abs(n.z()) > offset) return n - Vector3(0, 0, std::copysign(offset, n.z()));
          return edge * Vector3(n.x(), n.y(), 0).normalized();
        };
        return std::make_shared<CallbackShape>([point](const Vector3& n) { return n.dot(point(n)); }, point);
      }
      case RandomPartner::Superellipsoid:
      case RandomPartner::WithoutHessian:
        break;
    }
    return body();
  }

  RandomKind kind_;
  std::vector<std::vector<Vector3>> corners_;  // points of the polytopes, which refer to them
};

}  // namespace supernormal::test
