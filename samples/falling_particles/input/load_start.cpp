#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "common/motion.hpp"
#include "common/nearest_word.hpp"
#include "load_sections.hpp"
#include "model/grain_shape.hpp"
#include "model/wall.hpp"
#include "state_table.hpp"
#include "world/grain.hpp"

namespace falling_particles {
namespace {

// LAMMPS writes six digits. So the lengths of a dump have an error of up to 5e-6.
constexpr double kSizeError = 1e-5;
// Typed components of a quaternion may have three digits; the norm of a wrong one is off by more. ODE scales quaternions to 1.
constexpr double kUnitError = 1e-3;
constexpr double kLargestSpin = 1e6;  // rad/s
constexpr double kOverlap = 0.1;      // default of start.overlap; start.md has its reason
constexpr std::size_t kMostIndex = 1'000'000'000'000;

const std::vector<std::string> kPosition = {"x_m", "y_m", "z_m"};
const std::vector<std::string> kOrientation = {"qw", "qx", "qy", "qz"};
const std::vector<std::string> kVelocity = {"vx_m_per_s", "vy_m_per_s", "vz_m_per_s"};
const std::vector<std::string> kSpin = {"wx_rad_per_s", "wy_rad_per_s", "wz_rad_per_s"};
const std::vector<std::string> kAngularMomentum = {"angmomx", "angmomy", "angmomz"};  // kg m^2/s, of dumps
const std::vector<std::string> kDiameters = {"shapex", "shapey", "shapez"};           // m, of dumps
const std::vector<std::string> kRoundness = {"roundness_phi", "roundness_theta"};     // 2 / exponent, of dumps

using Row = StateTable::Row;

template <std::size_t size>
std::array<double, size> read_numbers(const StateTable& table, const Row& row, const std::vector<std::string>& columns,
                                      const Interval& allowed) {
  std::array<double, size> numbers{};
  for (std::size_t i = 0; i < size; ++i) numbers[i] = table.number(row, columns[i], allowed);
  return numbers;
}

std::array<double, 3> read_position(const StateTable& table, const Row& row) {
  return read_numbers<3>(table, row, kPosition, Interval::closed(-kLargestLength, kLargestLength, "m"));
}

std::array<double, 4> read_orientation(const StateTable& table, const Row& row) {
  const auto q = read_numbers<4>(table, row, kOrientation, Interval::closed(-2, 2, ""));
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (std::abs(norm - 1) <= kUnitError) return q;
  table.fail(row.line, "qw, qx, qy, qz are a quaternion of norm " + rounded(norm) + "; allowed: 1, to " + rounded(kUnitError));
}

std::array<double, 3> read_velocity(const StateTable& table, const Row& row) {
  return read_numbers<3>(table, row, kVelocity, Interval::closed(-kLargestSpeed, kLargestSpeed, "m/s"));
}

std::array<double, 3> read_spin(const StateTable& table, const Row& row) {
  return read_numbers<3>(table, row, kSpin, Interval::closed(-kLargestSpin, kLargestSpin, "rad/s"));
}

/// Reads the grains of a table as grains of a scene's kinds.
class StateReader {
 public:
  StateReader(const StateTable& table, const std::vector<GrainCount>& kinds) : table_(table), kinds_(kinds) {
    for (const GrainCount& entry : kinds) names_.push_back(entry.kind.name);
    check_columns();
  }

  std::vector<StartGrain> read() {
    std::vector<StartGrain> grains;
    grains.reserve(table_.rows().size());
    for (const auto& [number, row] : ordered_rows()) {
      grains.push_back(read_grain(*row));
      grains.back().number = number;
    }
    return grains;
  }

  bool has_velocities() const { return has_any(kVelocity) || has_any(kSpin) || has_any(kAngularMomentum); }

 private:
  bool has_any(const std::vector<std::string>& columns) const {
    return std::ranges::any_of(columns, [this](const std::string& column) { return table_.has(column); });
  }
  void require_all_if_any(const std::vector<std::string>& columns) const {
    if (has_any(columns)) table_.require(columns);
  }

  void check_columns() const {
    if (table_.is_dump()) {
      table_.require({"body", "type"});
      table_.require(kDiameters);
    } else {
      std::vector<std::string> known = {"time_s", "body", "grain", "scale"};
      for (const auto& columns : {kPosition, kOrientation, kVelocity, kSpin}) {
        known.insert(known.end(), columns.begin(), columns.end());
      }
      table_.refuse_others(known);
      table_.require({"grain"});
      const auto has_sizes = [](const GrainCount& entry) { return entry.size.has_value(); };
      if (const auto sized = std::ranges::find_if(kinds_, has_sizes); sized != kinds_.end()) {
        table_.require({"scale"}, ", which grain \"" + sized->kind.name + "\" with sizes needs");
      }
    }
    table_.require(kPosition);
    table_.require(kOrientation);
    for (const auto& columns : {kVelocity, kSpin, kAngularMomentum, kRoundness}) require_all_if_any(columns);
  }

  /// By the numbers of the grains, if the table has them. LAMMPS writes atoms in any order.
  std::vector<std::pair<std::size_t, const Row*>> ordered_rows() const {
    std::vector<std::pair<std::size_t, const Row*>> rows;
    std::set<std::size_t> seen;
    for (const Row& row : table_.rows()) {
      const std::size_t number = table_.has("body") ? table_.whole_number(row, "body", 0, kMostIndex) : rows.size();
      if (!seen.insert(number).second) {
        table_.fail(row.line, "body is " + std::to_string(number) + ", which another line has; allowed: a number of its own");
      }
      rows.emplace_back(number, &row);
    }
    std::ranges::sort(rows);
    return rows;
  }

  StartGrain read_grain(const Row& row) const {
    StartGrain grain{.kind = table_.is_dump() ? table_.whole_number(row, "type", 1, kinds_.size()) - 1 : read_kind(row)};
    grain.line = row.line;
    grain.scale = read_scale(row, kinds_[grain.kind]);
    grain.position = read_position(table_, row);
    grain.quaternion = read_orientation(table_, row);
    if (has_any(kVelocity)) grain.velocity = read_velocity(table_, row);
    if (has_any(kSpin)) {
      grain.angular_velocity = read_spin(table_, row);
    } else if (has_any(kAngularMomentum)) {
      const Interval any = Interval::finite("an angular momentum, kg m^2/s");
      grain.angular_velocity = spin_of(grain, read_numbers<3>(table_, row, kAngularMomentum, any));
    }
    return grain;
  }

  std::size_t read_kind(const Row& row) const {
    const std::string name(table_.word(row, "grain"));
    const auto found = std::ranges::find(names_, name);
    if (found != names_.end()) return static_cast<std::size_t>(found - names_.begin());
    table_.fail(row.line, "grain is \"" + name + "\"" + did_you_mean(name, names_) + "; allowed (the scene's): " + join(names_));
  }

  /// The factor on the lengths of the kind. Within the error of a dump, it is exactly 1 for a kind of one size.
  double read_scale(const Row& row, const GrainCount& entry) const {
    const double scale = table_.is_dump()      ? scale_of_dump(row, entry.kind)
                         : table_.has("scale") ? table_.number(row, "scale", Interval::positive(kLargestLength, ""))
                                               : 1;
    const double least = entry.size ? entry.size->smallest() : 1;
    const double most = entry.size ? entry.size->largest() : 1;
    if (!(scale >= (1 - kSizeError) * least && scale <= (1 + kSizeError) * most)) {
      table_.fail(row.line, "grain \"" + entry.kind.name + "\" has " + shortest(scale) +
                                " of the size of the catalogue; allowed: " +
                                (entry.size ? shortest(least) + " to " + shortest(most) + ", as in grain.size of the scene"
                                            : "1, since grain.size of the scene is missing"));
    }
    return entry.size ? scale : 1;
  }

  double scale_of_dump(const Row& row, const GrainKind& kind) const {
    if (!kind.components.empty()) {
      table_.fail(row.line, "grain \"" + kind.name + "\" is a compound, whose pose a dump lacks; allowed: final_state.csv");
    }
    const Interval diameters = Interval::positive(2 * kLargestLength, "m");
    const std::array<double, 3> found = read_numbers<3>(table_, row, kDiameters, diameters);
    const double scale = found[0] / (2 * kind.half_axes[0]);
    for (std::size_t i = 1; i < 3; ++i) {
      const double expected = 2 * scale * kind.half_axes[i];
      if (std::abs(found[i] - expected) <= 2 * kSizeError * expected) continue;
      table_.fail(row.line, kDiameters[i] + " is " + shortest(found[i]) + " m; allowed: " + rounded(expected) + " m beside " +
                                kDiameters[0] + " = " + shortest(found[0]) + " m, of grain \"" + kind.name + "\", type " +
                                std::string(table_.word(row, "type")));
    }
    if (has_any(kRoundness)) check_roundness(row, kind);
    return scale;
  }

  void check_roundness(const Row& row, const GrainKind& kind) const {
    const auto found = read_numbers<2>(table_, row, kRoundness, Interval::positive(2, ""));
    const std::array<double, 2> expected = {2 / kind.delta, 2 / kind.epsilon};
    for (std::size_t i = 0; i < 2; ++i) {
      if (std::abs(found[i] - expected[i]) <= kSizeError * expected[i]) continue;
      table_.fail(row.line, kRoundness[i] + " is " + shortest(found[i]) + "; allowed: " + rounded(expected[i]) + ", of grain \"" +
                                kind.name + '"');
    }
  }

  /// rad/s, of a grain with this angular momentum in LAMMPS.
  Point spin_of(const StartGrain& grain, const Point& momentum) const {
    const supernormal::Vector3 spin =
        lammps_inertia(kinds_[grain.kind].kind, grain.scale, grain.quaternion).ldlt().solve(to_vector(momentum));
    return {spin.x(), spin.y(), spin.z()};
  }

  const StateTable& table_;
  const std::vector<GrainCount>& kinds_;
  std::vector<std::string> names_;
};

std::filesystem::path find_file(const TomlTable& section, const char* key, const char* allowed, const std::string& scene_path) {
  const std::filesystem::path path = std::filesystem::path(scene_path).parent_path() / section.text(key);
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) return path;
  section.refuse(key,
                 ": there is no file \"" + path.string() + "\"; allowed: " + allowed + ", its path relative to the scene file");
}

std::optional<TomlTable> find_section(const TomlTable& root) { return root.find_table("start", {"file", "overlap", "parts"}); }

/// Starts a wall where the row has it. The velocity of a free one is that of its centre of mass.
void place(Wall& wall, const StateTable& table, const Row& row) {
  const auto [x, y, z] = read_position(table, row);
  const auto [w, i, j, k] = read_orientation(table, row);
  wall.start = {{x, y, z}, Eigen::Quaterniond(w, i, j, k).normalized()};
  if (!wall.flight) return;
  const auto [vx, vy, vz] = read_velocity(table, row);
  const auto [wx, wy, wz] = read_spin(table, row);
  const Vector3 spin(wx, wy, wz);
  wall.flight->velocity = {Vector3(vx, vy, vz) + spin.cross(wall.start.rotation * wall.flight->centre), spin};
}

}  // namespace

std::optional<StartState> load_start(const TomlTable& root, const std::vector<GrainCount>& kinds, const std::string& scene_path) {
  const std::optional<TomlTable> section = find_section(root);
  if (!section) return std::nullopt;
  StartState start{.overlap = kOverlap};
  if (section->has("overlap")) {
    start.overlap = section->number("overlap", Interval::positive(1, "(of the smallest half-axis)"));
  }
  start.file = find_file(*section, "file", "final_state.csv or trajectory.csv of a run, another CSV file, or a text dump of LAMMPS",
                         scene_path);
  const StateTable table(start.file);
  StateReader reader(table, kinds);
  start.time = table.time();
  start.has_velocities = reader.has_velocities();
  start.grains = reader.read();
  return start;
}

void place_walls(const TomlTable& root, const std::string& scene_path, std::vector<Wall>& walls) {
  const std::optional<TomlTable> section = find_section(root);
  if (!section || !section->has("parts")) return;
  const std::filesystem::path path = find_file(*section, "parts", "parts.csv of a run", scene_path);
  const StateTable table(path);
  for (const auto& columns : {std::vector<std::string>{"part"}, kPosition, kOrientation, kVelocity, kSpin}) table.require(columns);
  bool has_any = false;
  for (const Row& row : table.rows()) {
    const auto wall = std::ranges::find(walls, table.word(row, "part"), &Wall::name);
    if (wall == walls.end()) continue;
    place(*wall, table, row);
    has_any = true;
  }
  if (!has_any) section->fail("parts", "start.parts: \"" + path.string() + "\" names no part of the scene; allowed: one that does");
}

}  // namespace falling_particles
