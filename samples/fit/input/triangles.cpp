#include "triangles.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "common/interval.hpp"

namespace fit {

namespace {

using Box = Eigen::AlignedBox3d;

std::size_t remove_repeated(std::vector<Triangle>& triangles) {
  std::set<Triangle> known;
  return std::erase_if(triangles, [&](const Triangle& t) {
    Triangle corners = t;
    std::ranges::sort(corners);
    return std::ranges::adjacent_find(corners) != corners.end() || !known.insert(corners).second;
  });
}

/// A connected part of a mesh: its triangles, and for each whether to reverse it to match the first.
struct Part {
  std::vector<std::pair<std::size_t, bool>> triangles;
  Box box;
  bool is_inside_out = false;  // after these reversals
};

bool has_edge(const Triangle& t, std::uint32_t from, std::uint32_t to) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (t[k] == from && t[(k + 1) % 3] == to) return true;
  }
  return false;
}

/// The connected parts: triangles that share an edge.
std::vector<Part> find_parts(const std::vector<Triangle>& triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> on_edge;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) on_edge[std::minmax(triangles[i][k], triangles[i][(k + 1) % 3])].push_back(i);
  }
  std::vector<Part> parts;
  std::vector<bool> is_known(triangles.size(), false);
  for (std::size_t first = 0; first < triangles.size(); ++first) {
    if (is_known[first]) continue;
    is_known[first] = true;
    auto& found = parts.emplace_back(Part{{{first, false}}, {}}).triangles;
    for (std::size_t next = 0; next < found.size(); ++next) {
      const auto [i, is_turned] = found[next];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t from = triangles[i][k], to = triangles[i][(k + 1) % 3];
        const auto& both = on_edge[std::minmax(from, to)];
        if (both.size() != 2) continue;
        const std::size_t other = both[0] == i ? both[1] : both[0];
        if (is_known[other]) continue;
        is_known[other] = true;
        found.emplace_back(other, is_turned != has_edge(triangles[other], from, to));
      }
    }
  }
  return parts;
}

/// Computes the box of a part, and the sign of the volume between its triangles and their mean point.
void measure(Part& part, const Data& data) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& [i, is_turned] : part.triangles) {
    for (const std::uint32_t corner : data.triangles[i]) {
      part.box.extend(data.vertices.points[corner]);
      sum += data.vertices.points[corner];
    }
  }
  const Eigen::Vector3d mean = sum / (3 * static_cast<double>(part.triangles.size()));
  double volume = 0;
  for (const auto& [i, is_turned] : part.triangles) {
    const auto& triangle = data.triangles[i];
    const auto corner = [&](std::size_t k) -> Eigen::Vector3d { return data.vertices.points[triangle[k]] - mean; };
    volume += (is_turned ? -1 : 1) * corner(0).dot(corner(1).cross(corner(2)));
  }
  part.is_inside_out = volume < 0;
}

/// The largest part whose box contains the box of `part`; itself if there is none.
const Part& around(const Part& part, const std::vector<Part>& parts) {
  const Part* outer = &part;
  for (const Part& other : parts) {
    const bool is_larger = other.box.contains(part.box) && other.box.volume() > outer->box.volume();
    if (is_larger) outer = &other;
  }
  return *outer;
}

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

Oriented orient(Data& data) {
  Oriented done;
  done.removed = remove_repeated(data.triangles);
  std::vector<Part> parts = find_parts(data.triangles);
  for (Part& part : parts) measure(part, data);
  for (const Part& part : parts) {
    const bool is_other_way = around(part, parts).is_inside_out;
    for (const auto& [i, is_turned] : part.triangles) {
      if (is_turned == is_other_way) continue;
      std::swap(data.triangles[i][1], data.triangles[i][2]);
      ++done.turned;
    }
  }
  return done;
}

OpenEdges open_edges(std::span<const Triangle> triangles) {
  struct Use {
    int count = 0, balance = 0;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Use> uses;
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = t[k], to = t[(k + 1) % 3];
      Use& use = uses[std::minmax(from, to)];
      ++use.count;
      use.balance += from < to ? 1 : -1;
    }
  }
  OpenEdges edges;
  for (const auto& [edge, use] : uses) {
    if (use.balance != 0) ++(use.count == 1 ? edges.single : edges.other);
  }
  return edges;
}

std::string describe(const OpenEdges& edges) {
  const auto part = [](std::size_t count, const char* what) {
    return std::to_string(count) + (count == 1 ? " edge has " : " edges have ") + what;
  };
  std::string text = "the mesh is open: ";
  if (edges.single > 0) text += part(edges.single, "one triangle");
  if (edges.single > 0 && edges.other > 0) text += ", ";
  if (edges.other > 0) text += part(edges.other, "several triangles that do not pair up");
  return text;
}

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
