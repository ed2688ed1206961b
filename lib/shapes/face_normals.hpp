// The face normals of hulls that come back in query after query as mere points.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "shapes/convex_hull.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// Remembers the face normals of the hulls asked for last; about a thousand of them.
///
/// Points are known by their places on a lattice, some millionths of the hull's size wide, so that the rounding in coordinates read
/// from a moving geom makes no difference, and the normals are those of the hull of the lattice points: they depend on these points
/// only, neither on their order nor on what was asked before. Good as starting directions (Polytope); the wider a face, the nearer
/// to its true normal.
class FaceNormals {
 public:
  /// Of the hull of the points (finite, relative to about their middle), unit. Valid until the next call.
  std::span<const Vector3> find(std::span<const Vector3> points);

 private:
  /// Two sums of hash values over the points, so that their order does not matter. Hulls that share both by chance would share
  /// their starting directions, no more.
  struct Key {
    std::array<std::uint64_t, 2> sums{};
    std::size_t count = 0;  // 0: of nothing
    bool operator==(const Key&) const = default;
  };
  struct Entry {
    Key key;
    std::vector<Vector3> normals;
  };

  static constexpr std::size_t kWays = 4;
  static constexpr std::size_t kSets = 256;

  Key lay_on_lattice(std::span<const Vector3> points);

  std::vector<LatticePoint> lattice_points_;
  ConvexHull hull_;
  std::vector<std::array<Entry, kWays>> sets_;  // in each the last used first
};

}  // namespace supernormal
