#include "polygon.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <vector>

#include "common/interval.hpp"

namespace fit {
namespace {

/// Triangulates a polygon as a fan from one vertex, if no triangle gets reversed. Returns false if there is no such vertex.
bool append_fan(const std::vector<std::uint32_t>& corners, Data& data) {
  const std::size_t count = corners.size();
  if (count < 3) return true;  // zero area
  const auto area = [&](std::size_t from, std::size_t k) -> Eigen::Vector3d {
    const auto at = [&](std::size_t i) -> const Eigen::Vector3d& { return data.vertices.points[corners[(from + i) % count]]; };
    return (at(k) - at(0)).cross(at(k + 1) - at(0));
  };
  Eigen::Vector3d whole = Eigen::Vector3d::Zero();
  for (std::size_t k = 1; k + 1 < count; ++k) whole += area(0, k);
  for (std::size_t from = 0; from < count; ++from) {
    bool is_fan = true;
    for (std::size_t k = 1; k + 1 < count && is_fan; ++k) is_fan = count == 3 || !(area(from, k).dot(whole) < 0);
    if (!is_fan) continue;
    for (std::size_t k = 1; k + 1 < count; ++k) {
      data.triangles.push_back({corners[from], corners[(from + k) % count], corners[(from + k + 1) % count]});
    }
    return true;
  }
  return false;
}

}  // namespace

std::string append_polygon(std::span<const double> corners, Data& data) {
  const std::size_t count = data.vertices.points.size();
  std::vector<std::uint32_t> polygon;
  for (const double index : corners) {
    const bool is_vertex = index >= 0 && index < static_cast<double>(count) && index == std::floor(index);
    if (!is_vertex) {
      return "there is no vertex " + common::shortest(index) +
             "; allowed: " + (count == 0 ? "none" : "0 to " + std::to_string(count - 1));
    }
    polygon.push_back(static_cast<std::uint32_t>(index));
  }
  return append_fan(polygon, data) ? "" : "a polygon is so concave that it is not cut; give triangles";
}

}  // namespace fit
