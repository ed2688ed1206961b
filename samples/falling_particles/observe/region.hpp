// Where a measurement looks.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/toml_input.hpp"
#include "model/scene.hpp"
#include "pair_contact.hpp"
#include "world/world.hpp"

namespace falling_particles {

/// A box along the axes, of any size.
struct Bounds {
  Vector3 lower, upper;  ///< m; what is on the lower side is inside, on the upper it is not

  bool contains(const Vector3& p) const { return (p.array() >= lower.array()).all() && (p.array() < upper.array()).all(); }
  double volume() const { return (upper - lower).prod(); }  ///< m^3
  /// The share of the way from a to b that is inside, in [0, 1].
  double share_of(const Vector3& a, const Vector3& b) const;
};

/// A region of a scene file: `lower` and `upper`, or all of a periodic cell, or everywhere.
class SamplingRegion {
 public:
  enum class Without { Refused, Everywhere };
  /// Throws InputError. `without`: what a scene without the two keys gets where it is not periodic.
  SamplingRegion(const TomlTable& table, const Scene& scene, Without without);

  Bounds bounds(const World& world) const;

 private:
  std::optional<Bounds> given_;
  bool is_cell_ = false;
};

/// m, after which a world repeats itself along x, y and z; 0 where it does not.
Vector3 periods_of(const World& world);

/// m, the centre of a grain; in a periodic world the one within the cell.
Vector3 place_of(const Grain& grain, const World& world);

/// The share of the way from a to b that is in the bounds, all images of the way in a periodic world together.
double share_of_images(const Bounds& bounds, const Vector3& a, const Vector3& b, const Vector3& periods);

/// 0 for "x", 1 for "y", 2 for "z".
std::size_t read_axis(const TomlTable& table, const char* key);

/// Cells of a region along x, y and z.
using CellCounts = std::array<std::size_t, 3>;
CellCounts read_cells(const TomlTable& table);
/// The cell of a point, x first, then y; nothing where it is in none.
std::optional<std::size_t> cell_of(const Vector3& point, const Bounds& bounds, const CellCounts& cells);
inline std::size_t number_of(const CellCounts& cells) { return cells[0] * cells[1] * cells[2]; }

/// The kinds of the scene's grains that `key` names.
std::string read_grain(const TomlTable& table, const char* key, const Scene& scene);
std::vector<std::string> names_of_grains(const Scene& scene);

}  // namespace falling_particles
