#include "region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <variant>

#include "common/nearest_word.hpp"
#include "world/grain.hpp"

namespace falling_particles {
namespace {

constexpr double kFarthest = 1e6;  // m
constexpr double kMostCells = 1000;

constexpr double kAlong = 1e-9;  // of a unit vector: rounding of orientations

/// The axis along which two walls are apart.
std::size_t axis_of(const FacingFaces& faces) {
  Eigen::Index axis = 0;
  faces.normal.cwiseAbs().maxCoeff(&axis);
  return static_cast<std::size_t>(axis);
}

/// Whether no motion and no drive of the wall can change this direction (unit, of its normal at the start).
bool keeps(const Wall& wall, const Vector3& direction) {
  const auto tilts = [&](const Vector3& axis) { return axis.cross(direction).norm() > kAlong; };
  const auto is_tilted_by = [&](const WallMotion& motion) {
    const auto* const rotation = std::get_if<Rotation>(&motion.kind);
    return rotation != nullptr && tilts(rotation->axis);
  };
  return !wall.flight && std::ranges::none_of(wall.motions, is_tilted_by) &&
         !(wall.drive && wall.drive->turns() && tilts(wall.drive->axis));
}

/// `pairs`: along x, y and z.
Bounds bounds_between(const std::vector<FacingWalls>& pairs, const World& world) {
  Bounds bounds{};
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const FacingFaces faces = world.walls().faces_between(pairs[static_cast<std::size_t>(axis)]);
    if (std::abs(faces.normal[axis]) < 1 - kAlong) {  // motions may change during a run
      const auto& [first, second] = pairs[static_cast<std::size_t>(axis)];
      throw std::runtime_error(std::string("walls \"")
                                   .append(first)
                                   .append("\" and \"")
                                   .append(second)
                                   .append("\" have rotated, and are no longer across x, y or z"));
    }
    const double sign = faces.normal[axis] < 0 ? -1 : 1;
    bounds.lower[axis] = std::min(sign * faces.first, sign * faces.second);
    bounds.upper[axis] = std::max(sign * faces.first, sign * faces.second);
  }
  return bounds;
}

std::optional<FacingFaces> find_faces(const FacingWalls& pair, const std::vector<Wall>& walls) {
  const Wall& first = wall_named(pair[0], walls);
  const Wall& second = wall_named(pair[1], walls);
  return facing_faces(first.shape, first.start, second.shape, second.start);
}

}  // namespace

const Wall& wall_named(const std::string& name, const std::vector<Wall>& walls) {
  return *std::ranges::find(walls, name, &Wall::name);
}

Stay Bounds::stay_of(const Vector3& a, const Vector3& b) const {
  double from = 0;
  double to = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double way = b[axis] - a[axis];
    if (way == 0) {
      if (a[axis] < lower[axis] || a[axis] >= upper[axis]) return {0, 0};
      continue;
    }
    const double one = (lower[axis] - a[axis]) / way;
    const double two = (upper[axis] - a[axis]) / way;
    from = std::max(from, std::min(one, two));
    to = std::min(to, std::max(one, two));
  }
  return {from, to};
}

SamplingRegion::SamplingRegion(const TomlTable& table, const Scene& scene, Without without) {
  if (table.has("between")) {
    read_between(table, scene);
    return;
  }
  if (!table.has("lower") && !table.has("upper")) {
    is_cell_ = std::holds_alternative<Periodic>(scene.container);
    if (is_cell_ || without == Without::Everywhere) return;
  }
  const Interval anywhere = Interval::closed(-kFarthest, kFarthest, "m");
  given_ = Bounds{Vector3(table.numbers("lower", 3, anywhere).data()), Vector3(table.numbers("upper", 3, anywhere).data())};
  for (int axis = 0; axis < 3; ++axis) {
    if (given_->lower[axis] < given_->upper[axis]) continue;
    table.refuse("upper", "[" + std::to_string(axis) + "] is " + shortest(given_->upper[axis]) + "; allowed: a number above " +
                              table.full_name("lower") + "[" + std::to_string(axis) + "], " + shortest(given_->lower[axis]) + " m");
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    const std::optional<Period>& period = scene.periodic[axis];
    if (!period || (given_->lower[i] >= period->lower && given_->upper[i] <= period->upper())) continue;
    const bool is_below = given_->lower[i] < period->lower;
    const char* const key = is_below ? "lower" : "upper";
    table.refuse(key, "[" + std::to_string(axis) + "] is " + shortest(is_below ? given_->lower[i] : given_->upper[i]) +
                          "; allowed: from " + shortest(period->lower) + " to " + shortest(period->upper()) +
                          " m, within the periodic cell");
  }
}

// Contacts have shares in a box with sides along the axes.
void SamplingRegion::read_between(const TomlTable& table, const Scene& scene) {
  for (const char* key : {"lower", "upper"}) {
    if (table.has(key)) table.refuse(key, " is given besides between; allowed: one of both");
  }
  between_.resize(3);
  start_lengths_.emplace();
  for (const FacingWalls& pair : read_facing_walls(table, "between", 3, scene.walls, Vector3::Zero())) {
    const FacingFaces faces = faces_at_start(pair, scene.walls);
    const std::size_t axis = axis_of(faces);
    if (std::abs(faces.normal[static_cast<Eigen::Index>(axis)]) < 1 - kAlong) {
      table.refuse("between",
                   " has \"" + pair[0] + "\" and \"" + pair[1] + "\", which are not across x, y or z; allowed: walls that are");
    }
    for (const std::string& name : pair) {
      if (keeps(wall_named(name, scene.walls), faces.normal)) continue;
      table.refuse("between", " has \"" + name + "\", which rotates; allowed: walls that stay across x, y or z");
    }
    between_[axis] = pair;
    (*start_lengths_)[static_cast<Eigen::Index>(axis)] = faces.distance();
  }
}

Bounds SamplingRegion::bounds(const World& world) const {
  if (given_) return *given_;
  if (!between_.empty()) return bounds_between(between_, world);
  if (is_cell_) return {Vector3::Zero(), periods_of(world)};
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  Bounds everywhere{Vector3::Constant(-kEndless), Vector3::Constant(kEndless)};
  if (world.cell() == nullptr) return everywhere;
  for (int axis = 0; axis < 3; ++axis) {  // each grain has one image in the cell
    const std::optional<Period>& period = world.cell()->axes()[static_cast<std::size_t>(axis)];
    if (!period) continue;
    everywhere.lower[axis] = period->lower;
    everywhere.upper[axis] = period->upper();
  }
  return everywhere;
}

Vector3 periods_of(const World& world) {
  Vector3 periods = Vector3::Zero();
  if (world.cell() == nullptr) return periods;
  for (int axis = 0; axis < 3; ++axis) {
    const std::optional<Period>& period = world.cell()->axes()[static_cast<std::size_t>(axis)];
    if (period) periods[axis] = period->length;
  }
  return periods;
}

Vector3 image_in_cell(const Vector3& place, const World& world) {
  if (world.cell() == nullptr) return place;
  return to_vector(world.cell()->wrapped(to_point(place)));
}

Vector3 place_of(const Grain& grain, const World& world) { return to_vector(world.place_of(grain)); }

Vector3 place_before(const Grain& grain, const World& world) {
  return image_in_cell(position_before(grain.body, world.scene().time.step), world);
}

std::vector<Stay> stays_of_images(const Bounds& bounds, const Vector3& a, const Vector3& b, const Vector3& periods) {
  std::vector<Stay> stays;
  const auto most = [&periods](int axis) { return periods[axis] > 0 ? 1 : 0; };
  for (int i = -most(0); i <= most(0); ++i) {
    for (int j = -most(1); j <= most(1); ++j) {
      for (int k = -most(2); k <= most(2); ++k) {
        const Vector3 shift(i * periods[0], j * periods[1], k * periods[2]);
        const Stay stay = bounds.stay_of(a + shift, b + shift);
        if (stay.to > stay.from) stays.push_back(stay);
      }
    }
  }
  std::ranges::sort(stays, {}, &Stay::from);
  return stays;
}

double share_of_images(const Bounds& bounds, const Vector3& a, const Vector3& b, const Vector3& periods) {
  double share = 0;
  for (const Stay& stay : stays_of_images(bounds, a, b, periods)) share += stay.to - stay.from;
  return share;
}

std::size_t read_axis(const TomlTable& table, const char* key) {
  return static_cast<std::size_t>(table.choice(key, {"x", "y", "z"}).front() - 'x');
}

CellCounts read_cells(const TomlTable& table) {
  const std::vector<double> numbers = table.numbers("cells", 3, Interval::closed(1, kMostCells, "(a whole one)"));
  CellCounts cells{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (numbers[axis] != std::floor(numbers[axis])) {
      table.refuse("cells", "[" + std::to_string(axis) + "] is " + shortest(numbers[axis]) +
                                "; allowed: an array of 3 whole numbers from 1 to " + shortest(kMostCells));
    }
    cells[axis] = static_cast<std::size_t>(numbers[axis]);
  }
  constexpr std::size_t kMostOfAll = 1'000'000;
  if (number_of(cells) > kMostOfAll) {
    table.refuse("cells", " makes " + std::to_string(number_of(cells)) + " cells; allowed: up to " + std::to_string(kMostOfAll));
  }
  return cells;
}

std::optional<std::size_t> cell_of(const Vector3& point, const Bounds& bounds, const CellCounts& cells) {
  if (!bounds.contains(point)) return std::nullopt;
  std::array<std::size_t, 3> at{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    const double relative = (point[i] - bounds.lower[i]) / (bounds.upper[i] - bounds.lower[i]);
    at[axis] = std::min(static_cast<std::size_t>(relative * static_cast<double>(cells[axis])), cells[axis] - 1);
  }
  return at[0] + cells[0] * (at[1] + cells[1] * at[2]);
}

std::vector<std::string> names_of_grains(const Scene& scene) {
  std::vector<std::string> names;
  names.reserve(scene.kinds.size());
  for (const GrainCount& entry : scene.kinds) names.push_back(entry.kind.name);
  return names;
}

std::vector<std::string> read_surfaces(const TomlTable& table, const Scene& scene) {
  const std::vector<std::string> names = names_of(scene.walls);
  if (names.empty()) {
    table.fail("surfaces", table.text("kind") + " in a " + kind_of(scene.container) + "; allowed: where there is a wall");
  }
  std::vector<std::string> chosen = table.has("surfaces") ? table.choices("surfaces", names) : names;
  if (chosen.empty()) table.refuse("surfaces", " is empty; allowed: words of " + join(names));
  return chosen;
}

FacingFaces faces_at_start(const FacingWalls& pair, const std::vector<Wall>& walls) { return find_faces(pair, walls).value(); }

std::vector<FacingWalls> read_facing_walls(const TomlTable& table, const char* key, std::size_t count,
                                           const std::vector<Wall>& walls, const Vector3& across) {
  constexpr double kAcross = 1e-9;  // of a product of unit normals: rounding of orientations
  const std::vector<std::string> names = table.choices(key, names_of(walls));
  const std::string allowed = "; allowed: " + std::to_string(count) +
                              " pairs of planes or boxes that face each other at right angles to the other pairs" +
                              (across.isZero() ? "" : " and to the axis of the drive");
  if (names.size() != 2 * count) {
    table.refuse(key, " has " + counted(names.size(), "wall") + allowed);
  }
  std::vector<FacingWalls> pairs;
  std::vector<Vector3> directions = {across};
  for (std::size_t i = 0; i < count; ++i) {
    const FacingWalls pair = {names[2 * i], names[2 * i + 1]};
    const std::optional<FacingFaces> faces = find_faces(pair, walls);
    const auto is_along = [&](const Vector3& other) { return std::abs(other.dot(faces->normal)) > kAcross; };
    if (!faces || faces->distance() <= 0 || std::ranges::any_of(directions, is_along)) {
      table.refuse(key, " has \"" + pair[0] + "\" and \"" + pair[1] + "\", which are no such pair" + allowed);
    }
    directions.push_back(faces->normal);
    pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace falling_particles
