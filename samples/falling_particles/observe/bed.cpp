#include "bed.hpp"

#include <supernormal/supernormal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace falling_particles {
namespace {

constexpr std::size_t kPointsPerAxis = 48;  // 110 592 points in a box: standard error below 0.0016

/// Finds the grains that may contain a point by vertical columns of the container: a bed is much wider than a grain, and not high.
class Columns {
 public:
  Columns(const World& world, const Rectangle& plan) : plan_(plan), cells_(kPerAxis * kPerAxis) {
    world.for_each_grain_geom([this](dGeomID geom) { add({geom, aabb_of(geom)}); });
  }

  /// The grain that contains the point, or null.
  const Grain* find_grain(const Point& point) const {
    const auto [x, y, z] = point;
    const std::vector<Entry>& column = cells_[index(x, 0) * kPerAxis + index(y, 1)];
    const auto found = std::ranges::find_if(column, [x = x, y = y, z = z](const Entry& entry) {
      const Aabb& a = entry.aabb;
      const bool near = x >= a[0] && x <= a[1] && y >= a[2] && y <= a[3] && z >= a[4] && z <= a[5];
      if (!near) return false;
      const dReal depth = snGeomPointDepth(entry.geom, x, y, z);
      if (std::isnan(depth)) throw std::runtime_error(std::string("snGeomPointDepth: ") + snLastError());
      return depth > 0;
    });
    return found == column.end() ? nullptr : grain_of(found->geom);
  }

 private:
  struct Entry {
    dGeomID geom;
    Aabb aabb;
  };
  static constexpr std::size_t kPerAxis = 32;

  void add(const Entry& entry) {
    for (std::size_t i = index(entry.aabb[0], 0); i <= index(entry.aabb[1], 0); ++i) {
      for (std::size_t j = index(entry.aabb[2], 1); j <= index(entry.aabb[3], 1); ++j) cells_[i * kPerAxis + j].push_back(entry);
    }
  }

  std::size_t index(double x, std::size_t axis) const {
    const double scaled = (x - plan_.corner[axis]) / plan_.width[axis] * static_cast<double>(kPerAxis);
    return static_cast<std::size_t>(std::clamp(scaled, 0.0, static_cast<double>(kPerAxis - 1)));
  }

  Rectangle plan_;
  std::vector<std::vector<Entry>> cells_;
};

/// m, z of the centre of the volume of the grains whose centres are from `lowest` on.
double mean_z(const World& world, double lowest) {
  double volume = 0;
  double moment = 0;
  for (const Grain& grain : world.present()) {
    if (grain.position()[2] < lowest) continue;
    volume += grain.volume();
    moment += grain.volume() * dBodyGetPosition(grain.body)[2];
  }
  return volume > 0 ? moment / volume : lowest;  // without grains there is no bed
}

double bed_height(const World& world, const Box&) { return 2 * mean_z(world, 0); }

double bed_height(const World& world, const Hopper& hopper) {
  const double mean = mean_z(world, hopper.clearance) - hopper.clearance;
  // The height of a cone on its tip is 4/3 of the mean height, the height of a cylinder twice the mean height. The bed's height
  // lies between these.
  double low = 4.0 / 3 * mean;
  double high = 2 * mean;
  constexpr int kHalvings = 60;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (low + high) / 2;
    (hopper.mean_height(hopper.clearance + middle) < mean ? low : high) = middle;
  }
  return high;
}

template <class Vessel>
Bed measure(const World& world, const Vessel& vessel, Random& random) {
  const double height = bed_height(world, vessel);
  const Rectangle plan = vessel.plan();
  const Columns columns(world, plan);
  constexpr double kStep = 1.0 / static_cast<double>(kPointsPerAxis);
  std::size_t points = 0;
  std::size_t inside = 0;
  double density = 0;
  for (std::size_t i = 0; i < kPointsPerAxis; ++i) {
    for (std::size_t j = 0; j < kPointsPerAxis; ++j) {
      for (std::size_t k = 0; k < kPointsPerAxis; ++k) {
        const double x = plan.corner[0] + plan.width[0] * kStep * (static_cast<double>(i) + random.uniform());
        const double y = plan.corner[1] + plan.width[1] * kStep * (static_cast<double>(j) + random.uniform());
        const double level = kStep * (static_cast<double>(k) + random.uniform());
        const Point point{x, y, vessel.lowest() + height * std::lerp(kSlabBottom, kSlabTop, level)};
        if (!vessel.contains(point)) continue;
        ++points;
        const Grain* grain = columns.find_grain(point);
        if (grain == nullptr) continue;
        ++inside;
        density += grain->kind->density;
      }
    }
  }
  if (points == 0) return {height, 0, 0, 0};  // the grains are not in the vessel
  const auto all = static_cast<double>(points);
  const double fraction = static_cast<double>(inside) / all;
  return {height, fraction, std::sqrt(fraction * (1 - fraction) / all), density / all};
}

constexpr int kSectors = 12;
constexpr int kArcs = 24;
constexpr int kRaysPerArc = 12;

}  // namespace

Line fit(const std::vector<std::array<double, 2>>& points) {
  const auto n = static_cast<double>(points.size());
  double x = 0, y = 0;
  for (const auto& point : points) {
    x += point[0] / n;
    y += point[1] / n;
  }
  double xx = 0, xy = 0, yy = 0;
  for (const auto& point : points) {
    xx += (point[0] - x) * (point[0] - x);
    xy += (point[0] - x) * (point[1] - y);
    yy += (point[1] - y) * (point[1] - y);
  }
  const double slope = xy / xx;
  return {slope, y - slope * x, std::sqrt(std::max(0.0, yy - slope * xy) / (n - 2) / xx)};
}

Bed measure_bed(const World& world, const Box& box, Random& random) { return measure(world, box, random); }

Bed measure_bed(const World& world, const Hopper& hopper, Random& random) { return measure(world, hopper, random); }

std::optional<double> Tops::height_at(double x, double y, double least) const {
  std::optional<double> height;
  for (const auto& [geom, a] : tops_) {
    if (x < a[0] || x > a[1] || y < a[2] || y > a[3] || a[5] <= height.value_or(least)) continue;
    const double start = a[5] + (a[5] - a[4]);
    dGeomRaySetLength(ray_.get(), start - a[4]);
    dGeomRaySet(ray_.get(), x, y, start, 0, 0, -1);
    dContactGeom hit;
    if (dCollide(ray_.get(), geom, 1, &hit, sizeof hit) > 0 && hit.pos[2] > height.value_or(least)) height = hit.pos[2];
  }
  return height;
}

Heap measure_heap(const World& world, const Point& centre, double radius) {
  Tops tops;
  std::size_t grains = 0;
  for (const Grain& grain : world.present()) {
    const Point p = grain.position();
    if (p[2] < centre[2] || std::hypot(p[0] - centre[0], p[1] - centre[1]) > radius) continue;
    for (const dGeomID geom : grain.geoms()) tops.add(geom);
    ++grains;
  }
  double sum = 0;
  double squares = 0;
  double height = 0;
  bool has_flank = false;
  for (int sector = 0; sector < kSectors; ++sector) {
    std::vector<std::array<double, 2>> flank;  // m, distance and height
    for (int arc = 0; arc < kArcs; ++arc) {
      const double distance = radius * std::lerp(kFlankFrom, kFlankTo, (arc + 0.5) / kArcs);
      double mean = 0;
      for (int i = 0; i < kRaysPerArc; ++i) {
        const double around = 2 * std::numbers::pi * (sector + (i + 0.5) / kRaysPerArc) / kSectors;
        const double x = centre[0] + distance * std::cos(around);
        const double y = centre[1] + distance * std::sin(around);
        const double above = tops.height_at(x, y, centre[2]).value_or(centre[2]) - centre[2];
        has_flank = has_flank || above > 0;
        mean += above / kRaysPerArc;
      }
      flank.push_back({distance, mean});
    }
    const Line line = fit(flank);
    const double angle = std::atan(-line.slope) * 180 / std::numbers::pi;
    sum += angle;
    squares += angle * angle;
    height += line.at_zero / kSectors;
  }
  const double mean = sum / kSectors;
  const double variance = std::max(0.0, squares / kSectors - mean * mean) / (kSectors - 1);
  return {mean, std::sqrt(variance), height, grains, has_flank};
}

}  // namespace falling_particles
