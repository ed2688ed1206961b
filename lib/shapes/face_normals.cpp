#include "shapes/face_normals.hpp"

#include <algorithm>
#include <cmath>

namespace supernormal {
namespace {

// Coordinates are often short binary fractions of one another; from where the lattice lies it is as unlikely as can be that one of
// them is halfway between two places (or the size between two scales), where rounding would decide.
constexpr double kLatticeShift = 0.3819660112501051;  // of a step
constexpr double kScaleShift = 1.3819660112501051;

constexpr double kSmallestSize = 1e-290;  // m; of a smaller hull, which is a point for all purposes, the scale would overflow

// The finalizer of splitmix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014).
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

std::uint64_t hash_of(const LatticePoint& point) {
  std::uint64_t hash = 0;
  for (const std::int64_t coordinate : point) hash = mixed(hash + 0x9e3779b97f4a7c15U + static_cast<std::uint64_t>(coordinate));
  return hash;
}

}  // namespace

FaceNormals::Key FaceNormals::lay_on_lattice(std::span<const Vector3> points) {
  double size = 0;
  for (const Vector3& point : points) size = std::max(size, point.lpNorm<Eigen::Infinity>());
  // The power of two that brings the largest coordinate into [1/2.8, 1/1.38) of the lattice's half width.
  int exponent = 0;
  std::frexp(size * kScaleShift, &exponent);
  const double scale = size > kSmallestSize ? std::ldexp(static_cast<double>(kLatticeHalfWidth), -exponent) : 0;
  Key key;
  key.count = points.size();
  lattice_points_.clear();
  for (const Vector3& point : points) {
    LatticePoint& place = lattice_points_.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      place[axis] = static_cast<std::int64_t>(std::floor(scale * point[static_cast<Eigen::Index>(axis)] + kLatticeShift));
    }
    const std::uint64_t hash = hash_of(place);
    key.sums[0] += hash;
    key.sums[1] += mixed(hash);
  }
  return key;
}

std::span<const Vector3> FaceNormals::find(std::span<const Vector3> points) {
  if (sets_.empty()) sets_.resize(kSets);
  const Key key = lay_on_lattice(points);
  auto& set = sets_[key.sums[0] % kSets];
  auto known = std::find_if(set.begin(), set.end(), [&](const Entry& entry) { return entry.key == key; });
  if (known == set.end()) {
    known = set.end() - 1;  // the one not used for longest makes room
    known->key = Key{};     // if the next lines run out of memory
    hull_.build(lattice_points_);
    known->normals.clear();
    hull_.add_face_normals(known->normals);
    known->key = key;
  }
  std::rotate(set.begin(), known, known + 1);
  return set.front().normals;
}

}  // namespace supernormal
