#include "bed.hpp"

#include <supernormal/supernormal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace falling_particles {
namespace {

constexpr std::size_t kPointsPerAxis = 48;  // 110 592 points: standard error below 0.0016

using Aabb = std::array<dReal, 6>;  // x, x, y, y, z, z

/// The grains that may hold a point, by columns of the box: a bed is much wider than a grain, and not high.
class Columns {
 public:
  Columns(const World& world, const Box& box) : box_(box), cells_(kPerAxis * kPerAxis) {
    for (const Body& body : world.bodies()) {
      Entry entry{body.geom, {}};
      dGeomGetAABB(body.geom, entry.aabb.data());
      for (std::size_t i = index(entry.aabb[0], 0); i <= index(entry.aabb[1], 0); ++i) {
        for (std::size_t j = index(entry.aabb[2], 1); j <= index(entry.aabb[3], 1); ++j) cells_[i * kPerAxis + j].push_back(entry);
      }
    }
  }

  bool in_grain(double x, double y, double z) const {
    return std::ranges::any_of(cells_[index(x, 0) * kPerAxis + index(y, 1)], [&](const Entry& entry) {
      const Aabb& a = entry.aabb;
      const bool near = x >= a[0] && x <= a[1] && y >= a[2] && y <= a[3] && z >= a[4] && z <= a[5];
      if (!near) return false;
      const dReal depth = snGeomPointDepth(entry.geom, x, y, z);
      if (std::isnan(depth)) throw std::runtime_error(std::string("snGeomPointDepth: ") + snLastError());
      return depth > 0;
    });
  }

 private:
  struct Entry {
    dGeomID geom;
    Aabb aabb;
  };
  static constexpr std::size_t kPerAxis = 32;

  std::size_t index(double x, std::size_t axis) const {
    const double scaled = x / box_.width[axis] * static_cast<double>(kPerAxis);
    return static_cast<std::size_t>(std::clamp(scaled, 0.0, static_cast<double>(kPerAxis - 1)));
  }

  const Box& box_;
  std::vector<std::vector<Entry>> cells_;
};

double bed_height(const World& world) {
  double volume = 0;
  double moment = 0;
  for (const Body& body : world.bodies()) {
    volume += body.volume();
    moment += body.volume() * dBodyGetPosition(body.body)[2];
  }
  return 2 * moment / volume;
}

}  // namespace

Bed measure_bed(const World& world, const Box& box, Random& random) {
  const double height = bed_height(world);
  const Columns columns(world, box);
  constexpr double kStep = 1.0 / static_cast<double>(kPointsPerAxis);
  std::size_t inside = 0;
  for (std::size_t i = 0; i < kPointsPerAxis; ++i) {
    for (std::size_t j = 0; j < kPointsPerAxis; ++j) {
      for (std::size_t k = 0; k < kPointsPerAxis; ++k) {
        const double x = box.width[0] * kStep * (static_cast<double>(i) + random.uniform());
        const double y = box.width[1] * kStep * (static_cast<double>(j) + random.uniform());
        const double level = kStep * (static_cast<double>(k) + random.uniform());
        if (columns.in_grain(x, y, height * std::lerp(kSlabBottom, kSlabTop, level))) ++inside;
      }
    }
  }
  constexpr auto kPoints = static_cast<double>(kPointsPerAxis * kPointsPerAxis * kPointsPerAxis);
  const double fraction = static_cast<double>(inside) / kPoints;
  return {height, fraction, std::sqrt(fraction * (1 - fraction) / kPoints)};
}

}  // namespace falling_particles
