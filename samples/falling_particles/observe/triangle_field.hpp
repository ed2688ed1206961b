// Numbers on the triangles of walls.
#pragma once

#include <string>
#include <vector>

namespace falling_particles {

/// A number on each triangle of some walls, for pictures.
struct TriangleField {
  std::string name;
  std::vector<std::vector<double>> of_walls;  ///< in the order of the triangles; empty for walls without numbers

  bool operator==(const TriangleField&) const = default;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(name, of_walls);
  }
};

}  // namespace falling_particles
