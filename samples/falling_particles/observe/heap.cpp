#include "heap.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace falling_particles {
namespace {

constexpr int kSectors = 12;
constexpr int kArcs = 24;
constexpr int kRaysPerArc = 12;

struct Top {
  dGeomID geom;
  std::array<dReal, 6> aabb;
};

/// m, the highest point of the grains on the vertical line through x and y; `base` if there is none above it.
double surface_height(std::span<const Top> grains, dGeomID ray, double x, double y, double base) {
  double height = base;
  for (const Top& grain : grains) {
    const auto& a = grain.aabb;
    if (x < a[0] || x > a[1] || y < a[2] || y > a[3] || a[5] <= height) continue;
    const double start = a[5] + (a[5] - a[4]);
    dGeomRaySetLength(ray, start - a[4]);
    dGeomRaySet(ray, x, y, start, 0, 0, -1);
    dContactGeom hit;
    if (dCollide(ray, grain.geom, 1, &hit, sizeof hit) > 0) height = std::max<double>(height, hit.pos[2]);
  }
  return height;
}

struct Line {
  double slope, at_zero;
};

Line fit(std::span<const double> x, std::span<const double> y) {
  const auto n = static_cast<double>(x.size());
  double sx = 0;
  double sy = 0;
  double sxx = 0;
  double sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sx += x[i];
    sy += y[i];
    sxx += x[i] * x[i];
    sxy += x[i] * y[i];
  }
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  return {slope, (sy - slope * sx) / n};
}

}  // namespace

Heap measure_heap(const World& world, const Point& centre, double radius) {
  std::vector<Top> tops;
  std::size_t grains = 0;
  for (const Grain& grain : world.present()) {
    const Point p = grain.position();
    if (p[2] < centre[2] || std::hypot(p[0] - centre[0], p[1] - centre[1]) > radius) continue;
    for (const dGeomID geom : grain.geoms()) {
      Top& top = tops.emplace_back(Top{geom, {}});
      dGeomGetAABB(geom, top.aabb.data());
    }
    ++grains;
  }
  const std::unique_ptr<dxGeom, decltype(&dGeomDestroy)> ray(dCreateRay(nullptr, 1), dGeomDestroy);
  double sum = 0;
  double squares = 0;
  double height = 0;
  bool has_flank = false;
  for (int sector = 0; sector < kSectors; ++sector) {
    std::vector<double> distances;
    std::vector<double> heights;
    for (int arc = 0; arc < kArcs; ++arc) {
      const double distance = radius * std::lerp(kFlankFrom, kFlankTo, (arc + 0.5) / kArcs);
      double mean = 0;
      for (int i = 0; i < kRaysPerArc; ++i) {
        const double around = 2 * std::numbers::pi * (sector + (i + 0.5) / kRaysPerArc) / kSectors;
        const double x = centre[0] + distance * std::cos(around);
        const double y = centre[1] + distance * std::sin(around);
        const double above = surface_height(tops, ray.get(), x, y, centre[2]) - centre[2];
        has_flank = has_flank || above > 0;
        mean += above / kRaysPerArc;
      }
      distances.push_back(distance);
      heights.push_back(mean);
    }
    const Line line = fit(distances, heights);
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
