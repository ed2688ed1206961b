// The region of a measurement, and its cells.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/toml_input.hpp"
#include "measurement.hpp"
#include "model/scene.hpp"
#include "pair_contact.hpp"
#include "world/world.hpp"

namespace falling_particles {

/// Reads `key`, an array of the names of 2 `count` walls, which face each other two by two. Throws InputError unless each two are
/// planes or boxes with parallel faces and a distance at the start, and all distances are at right angles to each other and to
/// `across` (unit or zero).
std::vector<FacingWalls> read_facing_walls(const TomlTable& table, const char* key, std::size_t count,
                                           const std::vector<Wall>& walls, const Vector3& across);

/// The first of a name, which must exist.
const Wall& wall_named(const std::string& name, const std::vector<Wall>& walls);

/// The faces of a pair at the start, in the order of the names. The walls must exist and have such faces.
FacingFaces faces_at_start(const FacingWalls& pair, const std::vector<Wall>& walls);

/// A part of a segment from a to b, as fractions of it in [0, 1].
struct Stay {
  double from, to;
};

/// A box with sides along the axes; it may be infinite.
struct Bounds {
  Vector3 lower, upper;  ///< m; the lower sides are inside, the upper ones are not

  bool contains(const Vector3& p) const { return (p.array() >= lower.array()).all() && (p.array() < upper.array()).all(); }
  double volume() const { return (upper - lower).prod(); }  ///< m^3
  /// The part of the segment from a to b that is inside; empty if `to` is not above `from`.
  Stay stay_of(const Vector3& a, const Vector3& b) const;
};

/// A region of a scene file: `lower` and `upper`, or `between` walls, or the whole periodic cell, or everywhere.
class SamplingRegion {
 public:
  enum class Without { Refused, Everywhere };
  /// Throws InputError. `without`: the result if both keys are missing and the container is not periodic.
  SamplingRegion(const TomlTable& table, const Scene& scene, Without without);

  Bounds bounds(const World& world) const;
  /// m, the distances along x, y and z at the start, of a region between walls; empty for any other one.
  const std::optional<Vector3>& start_lengths() const { return start_lengths_; }

 private:
  void read_between(const TomlTable& table, const Scene& scene);

  std::optional<Bounds> given_;
  std::vector<FacingWalls> between_;  // along x, y and z; or empty
  std::optional<Vector3> start_lengths_;
  bool is_cell_ = false;
};

/// m, the periods of a world along x, y and z; 0 along axes that are not periodic.
Vector3 periods_of(const World& world);

/// m, the image of a place in the periodic cell; the place itself in a world without one.
Vector3 image_in_cell(const Vector3& place, const World& world);

/// m, the centre of a grain; in a periodic world, its image within the cell.
Vector3 place_of(const Grain& grain, const World& world);

/// m, the same before the last step, up to rounding; of a grain that a feeder inserted in this step, where it was inserted.
Vector3 place_before(const Grain& grain, const World& world);

/// The parts of the segment from a to b, and of all its images in a periodic world, that are in the bounds, in their order.
std::vector<Stay> stays_of_images(const Bounds& bounds, const Vector3& a, const Vector3& b, const Vector3& periods);
/// The fraction of the segment in all of them, in [0, 1].
double share_of_images(const Bounds& bounds, const Vector3& a, const Vector3& b, const Vector3& periods);

/// A plane at right angles to an axis, 0, 1 or 2 for x, y and z.
struct AxisPlane {
  std::size_t axis;
  double at;  ///< m, along the axis
};

/// 0 for "x", 1 for "y", 2 for "z".
std::size_t read_axis(const TomlTable& table, const char* key);

/// The numbers of cells of a region along x, y and z.
using CellCounts = std::array<std::size_t, 3>;
CellCounts read_cells(const TomlTable& table);
/// The index of a point's cell, with x fastest, then y; empty outside the bounds.
std::optional<std::size_t> cell_of(const Vector3& point, const Bounds& bounds, const CellCounts& cells);
inline std::size_t number_of(const CellCounts& cells) { return cells[0] * cells[1] * cells[2]; }

std::vector<std::string> names_of_grains(const Scene& scene);

/// The names of walls under `surfaces` of a measurement, or those of all walls of the scene ("floor", "x_low", "x_high", "y_low",
/// "y_high" of a box or a hopper's tray, "lid", "hopper", "dish", "ground"; names of parts). Throws InputError.
std::vector<std::string> read_surfaces(const TomlTable& table, const Scene& scene);

}  // namespace falling_particles
