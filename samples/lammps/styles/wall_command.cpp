#include "styles/wall_command.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "common/mesh.hpp"
#include "common/nearest_word.hpp"
#include "kernel/contact_material.hpp"
#include "kernel/walls/mesh_wall.hpp"
#include "kernel/walls/wall.hpp"
#include "styles/words.hpp"

namespace granular {

namespace {

constexpr double kLargest = std::numeric_limits<double>::max();
constexpr double kLeast = std::numeric_limits<double>::min();
// The turn of a wall is an angle within half a revolution either way, as in falling_particles.
constexpr double kLargestTurn = 170;  // degrees

const std::map<std::string, std::size_t> kSizes = {
    {"axis", 3},          {"force", 1}, {"pressure", 1},      {"power", 1},          {"torque", 1},
    {"stress", 1},        {"area", 1},  {"largest_force", 1}, {"largest_torque", 1}, {"gain", 1},
    {"largest_speed", 1}, {"mass", 1},  {"moment", 1},        {"point", 3},          {"damping", 1},
    {"from", 1},          {"until", 1}, {"travel", 2},        {"gravity", 0},        {"between", 0},
};

/// The numbers of a drive by keyword.
class Numbers {
 public:
  Numbers(Words& words, DriveCommand& command) {
    while (!words.is_empty()) {
      const std::string keyword = words.next("drive");
      const auto size = kSizes.find(keyword);
      if (size == kSizes.end()) throw std::invalid_argument("drive: " + keyword + " is none of " + names());
      if (has(keyword)) throw std::invalid_argument("drive: " + keyword + " is given twice");
      std::vector<double>& values = values_[keyword];
      if (keyword == "gravity") command.gravity = words.next(keyword);
      while (keyword == "between" && command.between.size() < 4) command.between.push_back(words.next(keyword));
      while (values.size() < size->second) values.push_back(words.number(keyword));
    }
  }

  bool has(const std::string& keyword) const { return values_.contains(keyword); }

  /// A number within [low, high].
  double number(const std::string& keyword, double low, double high, const std::string& range) const {
    const double value = find(keyword)[0];
    if (!(value >= low && value <= high)) refuse("drive: " + keyword, value, range);
    return value;
  }
  double positive(const std::string& keyword) const { return number(keyword, kLeast, kLargest, "(0, inf)"); }
  double any(const std::string& keyword) const { return number(keyword, -kLargest, kLargest, "(-inf, inf)"); }
  double not_negative(const std::string& keyword) const { return has(keyword) ? number(keyword, 0, kLargest, "[0, inf)") : 0; }
  const std::vector<double>& find(const std::string& keyword) const {
    const auto found = values_.find(keyword);
    if (found == values_.end()) throw std::invalid_argument("drive: " + keyword + " is missing");
    return found->second;
  }
  Vector3 vector(const std::string& keyword) const { return Vector3::Map(find(keyword).data()); }

  /// The one law that is given.
  std::string law() const {
    std::vector<std::string> given;
    for (const char* name : {"force", "pressure", "power", "torque", "stress"}) {
      if (has(name)) given.emplace_back(name);
    }
    if (given.size() != 1) {
      throw std::invalid_argument("drive: it has " + (given.empty() ? "no law" : common::join(given)) +
                                  "; allowed: one of force, pressure, power, torque, stress");
    }
    return given.front();
  }

  void refuse_others(std::vector<std::string> allowed) const {
    for (const char* common : {"axis", "from", "until", "travel", "gravity"}) allowed.emplace_back(common);
    for (const auto& [keyword, values] : values_) {
      if (std::ranges::find(allowed, keyword) == allowed.end()) {
        throw std::invalid_argument("drive: " + keyword + " has no meaning here; allowed: " + common::join(allowed));
      }
    }
  }

 private:
  static std::string names() {
    std::vector<std::string> all;
    all.reserve(kSizes.size());
    for (const auto& [name, size] : kSizes) all.push_back(name);
    return common::join(all);
  }

  std::map<std::string, std::vector<double>> values_;
};

void read_sliding(const Numbers& numbers, const std::string& law, common::Drive& drive) {
  if (law == "force") {
    numbers.refuse_others({"force", "mass", "damping"});
    drive.force = numbers.any("force");
  } else if (law == "pressure") {
    numbers.refuse_others({"pressure", "area", "mass", "damping"});
    drive.force = numbers.any("pressure") * numbers.positive("area");
  } else {
    numbers.refuse_others({"power", "largest_force", "mass", "damping"});
    drive.power = numbers.positive("power");
    drive.force = numbers.positive("largest_force");
  }
  drive.mass = numbers.positive("mass");
  drive.damping = numbers.not_negative("damping");
}

void read_turning(const Numbers& numbers, const std::string& law, common::Drive& drive) {
  drive.point = numbers.vector("point");
  if (law == "torque") {
    numbers.refuse_others({"torque", "point", "moment", "mass", "damping"});
    drive.force = numbers.any("torque");
  } else {
    numbers.refuse_others({"power", "largest_torque", "point", "moment", "mass", "damping"});
    drive.power = numbers.positive("power");
    drive.force = numbers.positive("largest_torque");
  }
  drive.mass = numbers.positive("moment");
  drive.hung_mass = numbers.not_negative("mass");
  drive.damping = numbers.not_negative("damping");
}

void read_servo(const Numbers& numbers, common::Drive& drive) {
  const bool has_walls = numbers.has("between");
  numbers.refuse_others({"stress", "gain", "largest_speed", has_walls ? "between" : "area"});
  if (numbers.has("gravity")) throw std::invalid_argument("drive: gravity has no meaning with stress: a servo has no mass");
  drive.servo = common::Servo{numbers.positive("stress"), numbers.positive("gain"), numbers.positive("largest_speed"),
                              has_walls ? 0 : numbers.positive("area")};
}

void read_travel(const Numbers& numbers, common::Drive& drive) {
  if (!numbers.has("travel")) return;
  const double low = numbers.find("travel")[0], high = numbers.find("travel")[1];
  const double largest = drive.turns() ? kLargestTurn : kLargest;
  const auto require = [](double value, bool holds, const char* range) {
    if (!holds) refuse("drive: travel", value, range);
  };
  require(low, low >= -largest && low <= 0, drive.turns() ? "[-170, 0] degrees" : "(-inf, 0]");
  require(high, high >= 0 && high > low && high <= largest,
          drive.turns() ? "[0, 170] degrees, and above the first" : "[0, inf), and above the first");
  const double unit = drive.turns() ? std::numbers::pi / 180 : 1;
  drive.travel = {low * unit, high * unit};
}

/// Parses, in any order,
///     axis X Y Z, one of
///     force F | pressure P area A | power P largest_force F, each with mass M
///     torque T | power P largest_torque T, each with point X Y Z, moment J and optional mass M
///     stress S gain G largest_speed V, with area A or between FIX FIX FIX FIX
/// and the optional words damping C (not with stress), from T, until T, travel LOW HIGH (m or degrees), gravity FIX. Units are as
/// in [part.drive] of falling_particles. Throws std::invalid_argument with the error.
DriveCommand read_drive(Words& words) {
  DriveCommand command{};
  const Numbers numbers(words, command);
  common::Drive& drive = command.drive;
  drive.axis = direction_of("drive: axis", numbers.vector("axis"));
  const std::string law = numbers.law();
  if (law == "stress") {
    read_servo(numbers, drive);
  } else if (law == "torque" || (law == "power" && numbers.has("point"))) {
    read_turning(numbers, law, drive);
  } else {
    read_sliding(numbers, law, drive);
  }
  if (numbers.has("from")) drive.from = numbers.any("from");
  if (numbers.has("until")) drive.until = numbers.any("until");
  if (drive.until <= drive.from) refuse("drive: until", drive.until, "(from, inf)");
  read_travel(numbers, drive);
  return command;
}

std::vector<supernormal::MeshTriangle> load_triangles(const std::string& file, double unit) {
  const common::Mesh mesh = common::load_mesh(file, unit);
  std::vector<supernormal::MeshTriangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& corners : mesh.triangles) {
    supernormal::MeshTriangle triangle;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto& vertex = mesh.vertices.at(corners.at(k));
      triangle.vertices.at(k) = Eigen::Vector3f(vertex[0], vertex[1], vertex[2]).cast<double>();
    }
    triangle.index = static_cast<int>(triangles.size());
    triangles.push_back(triangle);
  }
  return triangles;
}

/// Each wall is created around its anchor, the reference point of its torque.
void read_shape(Words& words, WallCommand& command) {
  const std::string kind = words.next("wall/supernormal");
  if (kind == "plane") {
    command.anchor = words.vector(kind);
    command.normal = words.direction("plane: normal");
    command.wall = std::make_unique<PlaneWall>(Vector3::Zero(), *command.normal);
  } else if (kind == "box") {
    const Vector3 low = words.vector(kind), high = words.vector(kind);
    command.anchor = 0.5 * (low + high);
    command.wall = std::make_unique<BoxWall>(low - command.anchor, high - command.anchor);
  } else if (kind == "cylinder") {
    command.anchor = words.vector(kind);
    const Vector3 axis = words.direction("cylinder: axis");
    command.wall = std::make_unique<CylinderWall>(Vector3::Zero(), axis, words.number(kind));
  } else if (kind == "mesh") {
    const std::string file = words.next(kind);
    const double unit = words.number("mesh: unit");
    if (!(unit > 0)) refuse("mesh: unit", unit, "(0, inf)");
    command.wall = std::make_unique<MeshWall>(load_triangles(file, unit));
  } else {
    throw std::invalid_argument(kind + " is none of plane, box, cylinder, mesh");
  }
}

common::WallMotion read_motion(Words& words) {
  const std::string kind = words.next("move");
  if (kind == "linear") return {common::Translation{words.vector(kind)}};
  if (kind == "conveyor") return {common::Conveyor{words.vector(kind), {Vector3::UnitZ(), Vector3::Zero(), 0}}};
  if (kind == "rotate") {
    const Vector3 axis = words.direction("move rotate: axis"), point = words.vector(kind);
    return {common::Rotation{axis, point, words.number(kind)}};
  }
  if (kind == "vibrate") {
    const Vector3 amplitude = words.vector(kind);
    const double frequency = words.number(kind);
    if (!(frequency > 0)) refuse("move vibrate: frequency", frequency, "(0, inf)");
    return {common::Vibration{amplitude, frequency, words.number(kind)}};
  }
  throw std::invalid_argument("move " + kind + " is none of linear, rotate, vibrate, conveyor");
}

}  // namespace

WallCommand read_wall_command(Words words) {
  WallCommand command;
  read_shape(words, command);
  if (words.accept("type")) {
    command.type = words.integer("type");
  } else {
    const Coefficients coefficients = read_coefficients(words.take_until({"move", "drive"}));
    if (!coefficients.has_material) throw std::invalid_argument("the law is missing: hooke, hertz or type");
    if (coefficients.has_exponents) throw std::invalid_argument("exponents belong to the particles' types: pair_coeff");
    command.material = coefficients.material;
  }
  while (!words.is_empty()) {
    const std::string keyword = words.next("move");
    if (keyword == "drive") {
      command.drive = read_drive(words);
      break;
    }
    if (keyword != "move") throw std::invalid_argument(keyword + " is none of move, drive");
    command.motions.push_back(read_motion(words));
    if (words.accept("from")) command.motions.back().from = words.number("from");
    if (words.accept("until")) command.motions.back().until = words.number("until");
    const auto& [ignored, from, until] = command.motions.back();
    if (until <= from) refuse("move: until", until, "(from, inf)");
  }
  const auto moves_surface = [](const common::WallMotion& motion) { return std::holds_alternative<common::Conveyor>(motion.kind); };
  if (command.drive && std::ranges::any_of(command.motions, moves_surface)) {
    throw std::invalid_argument("drive besides move conveyor; allowed: with the other motions");
  }
  return command;
}

}  // namespace granular
