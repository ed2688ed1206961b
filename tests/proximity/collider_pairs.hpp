// A smooth body and a collider with faces and edges, at a prescribed distance or depth, and the reference for their gap.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "collider_reference.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/draw.hpp"

namespace supernormal::test {

enum class ColliderKind { Box, Capsule, Cylinder, Triangle, Hull };

inline constexpr std::array kColliderKinds = {ColliderKind::Box, ColliderKind::Capsule, ColliderKind::Cylinder,
                                              ColliderKind::Triangle, ColliderKind::Hull};

const char* name_of(ColliderKind kind);

/// A collider that can be made again in another unit of length.
struct Collider {
  ColliderKind kind;
  Vector3 lengths = Vector3::Zero();  ///< m; half-lengths of a box; radius and half-length of a capsule or cylinder
  std::vector<Vector3> points;        ///< m; points of a triangle or a hull, with their mean at the origin

  std::unique_ptr<const Shape> make() const;  ///< the shape must not outlive `points`
  Collider scaled(double factor) const;
};

/// Gap / unit at which a pair is placed: apart, touching, shallow and deep.
inline constexpr std::array<double, 7> kColliderGaps = {0.5, 0.05, 0, -0.01, -0.02, -0.1, -0.3};

struct ColliderPair {
  std::string name;
  double nominal = 0;  ///< one of kColliderGaps
  Superellipsoid surface{Vector3::Ones(), 2, 2};
  std::shared_ptr<const Shape> body;  ///< surface, as a program would make it; at rest in the origin
  Collider collider;
  std::unique_ptr<const Shape> shape;  ///< shape of the collider
  Pose pose;                           ///< pose of the collider
  double unit = 0;                     ///< m; smallest half-extent of the two; for a triangle, which is flat, the body's
  double size = 0;                     ///< m; size of the numbers that s is the difference of
  GapBounds reference;                 ///< kReferenceWidth wide

  bool is_deep() const { return nominal < -0.2; }
};

/// The width of the reference interval, relative to the unit.
inline constexpr double kReferenceWidth = 1e-12;

/// Random pairs, the same in every run: half-axes and colliders with aspect ratios up to 20, exponents 1.02...200, any orientation
/// and direction.
class ColliderPairs : private Draw {
 public:
  ColliderPairs(ColliderKind kind, unsigned seed) : Draw(seed), kind_(kind) {}

  ColliderPair draw(double nominal);

 private:
  double exponent();
  Superellipsoid surface();
  Collider collider();

  ColliderKind kind_;
  int drawn_ = 0;
};

/// Writes everything that the pair is made of with 17 digits.
std::string describe(const ColliderPair& pair);

}  // namespace supernormal::test
