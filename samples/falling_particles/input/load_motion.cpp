#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <string>
#include <supernormal/shapes/shape.hpp>
#include <tuple>
#include <vector>

#include "common/nearest_word.hpp"
#include "load_sections.hpp"
#include "observe/region.hpp"

namespace falling_particles {
namespace {

Rotation read_rotation(const TomlTable& table, const Time& time) {
  table.refuse_unknown_keys({"kind", "axis", "point", "rpm", "from", "until"});
  return {read_direction(table, "axis"), read_vector(table, "point", Interval::closed(-kLargestLength, kLargestLength, "m")),
          read_rpm(table, time)};
}

Vibration read_vibration(const TomlTable& table, const Time& time) {
  table.refuse_unknown_keys({"kind", "direction", "amplitude", "frequency", "phase", "from", "until"});
  Vibration vibration{};
  vibration.amplitude = table.number("amplitude", Interval::positive(kLargestLength, "m")) * read_direction(table, "direction");
  constexpr double kStepsPerPeriod = 10;
  vibration.frequency =
      table.number("frequency", Interval::positive(1 / (kStepsPerPeriod * time.step), "Hz (a period has at least ten time.step)"));
  if (table.has("phase")) vibration.phase = table.number("phase", Interval::closed(-360, 360, "degrees")) * std::numbers::pi / 180;
  return vibration;
}

Conveyor read_conveyor(const TomlTable& table, const Time& time) {
  table.refuse_unknown_keys({"kind", "velocity", "axis", "point", "rpm", "from", "until"});
  Conveyor conveyor{Vector3::Zero(), {Vector3::UnitZ(), Vector3::Zero(), 0}};
  const bool turns = table.has("axis") || table.has("point") || table.has("rpm");
  if (table.has("velocity") || !turns) {
    conveyor.velocity =
        read_vector(table, "velocity", Interval::closed(-kLargestSpeed, kLargestSpeed, "m/s (or axis, point and rpm)"));
  }
  if (turns) {
    conveyor.turn = {read_direction(table, "axis"),
                     read_vector(table, "point", Interval::closed(-kLargestLength, kLargestLength, "m")), read_rpm(table, time)};
  }
  return conveyor;
}

decltype(WallMotion::kind) read_kind(const TomlTable& table, const Time& time) {
  const std::string kind = table.choice("kind", {"velocity", "rotation", "vibration", "conveyor"});
  if (kind == "rotation") return read_rotation(table, time);
  if (kind == "vibration") return read_vibration(table, time);
  if (kind == "conveyor") return read_conveyor(table, time);
  table.refuse_unknown_keys({"kind", "velocity", "from", "until"});
  return Translation{read_vector(table, "velocity", Interval::closed(-kLargestSpeed, kLargestSpeed, "m/s"))};
}

WallMotion read_motion(const TomlTable& table, const Time& time) {
  const auto kind = read_kind(table, time);
  const auto [from, until] = read_times(table);
  return {kind, from, until};
}

// ODE inverts a moment of inertia with its square. The bounds are those of a wall of 1e-12 kg and 1 mm, and of 1e6 kg and 1 km.
const Interval kMoments = Interval::closed(1e-18, 1e12, "kg m^2, about the centre of mass, along the axes of the part");

Eigen::Matrix3d read_inertia(const TomlTable& table) {
  const Vector3 moments = read_vector(table, "inertia", kMoments);
  constexpr double kRounding = 1e-9;  // of a plate, whose largest moment is the sum of the others
  if (2 * moments.maxCoeff() > (1 + kRounding) * moments.sum()) {
    table.refuse("inertia", " is [" + shortest(moments.x()) + ", " + shortest(moments.y()) + ", " + shortest(moments.z()) +
                                "] kg m^2, which no body has; allowed: moments of which none exceeds the sum of the others");
  }
  return moments.asDiagonal();
}

void read_solid(const TomlTable& table, const Wall& wall, Flight& flight) {
  const std::optional<supernormal::MassProperties> solid = solid_of(wall.shape);
  if (solid) {
    flight.centre = solid->centroid;
    flight.inertia = flight.mass / solid->volume * solid->inertia();
  } else if (!table.has("inertia")) {
    table.fail("", table.full_name("inertia") +
                       " is missing, and the mesh has no volume: it is two-sided, or its triangles do not close, "
                       "with their fronts outside; allowed: three numbers, " +
                       kMoments.unit);
  }
  if (table.has("inertia")) flight.inertia = read_inertia(table);
  if (table.has("centre")) {
    flight.centre = read_vector(table, "centre", Interval::closed(-kLargestLength, kLargestLength, "m, in the frame of the part"));
  }
}

Vector3 read_spin(const TomlTable& table, const Time& time) {
  const double most = 2 * std::numbers::pi * kLargestTurn / time.step;
  const Vector3 spin = read_vector(table, "angular_velocity", Interval::finite("rad/s"));
  if (spin.norm() > most) {
    table.refuse("angular_velocity", " is " + rounded(spin.norm()) + " rad/s; allowed: up to " + rounded(most) +
                                         " rad/s, a tenth of a revolution in a step");
  }
  return spin;
}

constexpr double kLargest = 1e9;  // N, N m, Pa, W, N s/m or N m s
constexpr double kRadians = std::numbers::pi / 180;

const std::vector<std::string> kLaws = {"force", "pressure", "torque", "power", "stress"};

/// `drive`: the name of the table.
std::string find_law(const TomlTable& table, const std::string& drive) {
  std::vector<std::string> given;
  std::ranges::copy_if(kLaws, std::back_inserter(given), [&](const std::string& law) { return table.has(law); });
  if (given.size() == 1) return given.front();
  if (given.empty()) table.fail("", table.full_name("force") + " is missing; allowed: one of " + join(kLaws));
  table.fail(given.back(), drive + " has both " + given[0] + " and " + given[1] + "; allowed: one of " + join(kLaws));
}

/// m^2, the projected area of a wall along the axis of its drive. `axis` is in the wall's frame. 0 if the scene must give the area.
double plan_area(const WallShape& shape, const Vector3& axis) {
  if (const auto* box = std::get_if<BoxShape>(&shape)) {
    const Vector3& s = box->size;
    return Vector3(s.y() * s.z(), s.z() * s.x(), s.x() * s.y()).dot(axis.cwiseAbs());
  }
  if (const auto* cylinder = std::get_if<CylinderShape>(&shape)) {
    const double across = std::hypot(axis.x(), axis.y());
    return std::numbers::pi * cylinder->radius * cylinder->radius * std::abs(axis.z()) +
           2 * cylinder->radius * cylinder->length * across;
  }
  return 0;
}

double read_area(const TomlTable& table, const Wall& wall, const Vector3& axis) {
  const double area = plan_area(wall.shape, wall.start.rotation.conjugate() * axis);
  if (area > 0 && !table.has("area")) return area;
  return table.number("area", Interval::positive(1e6, "m^2, on which the pressure acts"));
}

/// Reads `travel`; `largest`: of the wall's unit, with its name.
void read_travel(const TomlTable& table, double largest, const char* unit, const char* about, Drive& drive) {
  if (!table.has("travel")) return;
  const std::vector<double> travel = table.numbers("travel", 2, Interval::closed(-largest, largest, unit));
  if (travel[0] > 0 || travel[1] < 0 || travel[0] == travel[1]) {
    table.refuse("travel", " is [" + shortest(travel[0]) + ", " + shortest(travel[1]) +
                               "]; allowed: from 0 or less to 0 or more, " + unit + ' ' + about + ' ' + table.full_name("axis"));
  }
  drive.travel = {travel[0], travel[1]};
}

/// The keys of a law, with the keys that all laws have.
std::vector<std::string> with_times(std::vector<std::string> keys) {
  for (const char* key : {"axis", "from", "until", "travel"}) keys.emplace_back(key);
  return keys;
}

void read_sliding(const TomlTable& table, const std::string& law, const Wall& wall, Drive& drive) {
  std::vector<std::string> keys = {law, "mass", "damping"};
  if (law == "pressure") keys.emplace_back("area");
  if (law == "power") keys.emplace_back("largest_force");
  table.refuse_unknown_keys(with_times(std::move(keys)));
  if (law == "force") drive.force = table.number("force", Interval::closed(-kLargest, kLargest, "N, along its axis"));
  if (law == "pressure") {
    const double area = read_area(table, wall, drive.axis);
    drive.force = area * table.number("pressure", Interval::closed(-kLargest, kLargest, "Pa, along its axis"));
  }
  if (law == "power") {
    drive.power = table.number("power", Interval::positive(kLargest, "W, along its axis"));
    drive.force = table.number("largest_force", Interval::positive(kLargest, "N, at rest"));
  }
  drive.mass = table.number("mass", Interval::closed(kLightest, kHeaviest, "kg"));
  if (table.has("damping")) drive.damping = table.number("damping", Interval::closed(0, kLargest, "N s/m"));
  read_travel(table, kLargestLength, "m", "along", drive);
}

void read_turning(const TomlTable& table, const std::string& law, Drive& drive) {
  // ODE has the angle of a hinge from -180 to 180 degrees. A stop near the ends would be passed in a step.
  constexpr double kLargestTravel = 170;
  std::vector<std::string> keys = {law, "point", "moment", "mass", "damping"};
  if (law == "power") keys.emplace_back("largest_torque");
  table.refuse_unknown_keys(with_times(std::move(keys)));
  drive.point = read_vector(table, "point", Interval::closed(-kLargestLength, kLargestLength, "m, on its axis"));
  if (law == "torque") {
    drive.force = table.number("torque", Interval::closed(-kLargest, kLargest, "N m, about its axis"));
  } else {
    drive.power = table.number("power", Interval::positive(kLargest, "W, about its axis"));
    drive.force = table.number("largest_torque", Interval::positive(kLargest, "N m, at rest"));
  }
  drive.mass = table.number("moment", Interval::closed(kLightest, kHeaviest, "kg m^2, about its axis"));
  if (table.has("mass")) drive.hung_mass = table.number("mass", Interval::closed(0, kHeaviest, "kg"));
  if (table.has("damping")) drive.damping = table.number("damping", Interval::closed(0, kLargest, "N m s"));
  read_travel(table, kLargestTravel, "degrees", "about", drive);
  for (double& end : drive.travel) end *= kRadians;
}

void read_servo(const TomlTable& table, const Wall& wall, const std::vector<FacingWalls>& between, Drive& drive) {
  table.refuse_unknown_keys(with_times({"stress", "gain", "largest_speed", table.has("between") ? "between" : "area"}));
  Servo servo{};
  servo.stress = table.number("stress", Interval::positive(kLargest, "Pa, of the grains against its axis"));
  servo.gain = table.number("gain", Interval::positive(kLargest, "m/(s Pa)"));
  servo.largest_speed = table.number("largest_speed", Interval::positive(kLargestSpeed, "m/s"));
  const bool is_given = table.has("area") || table.has("between");
  if (!is_given) servo.between = between;
  if (!table.has("between") && servo.between.empty()) servo.area = read_area(table, wall, drive.axis);
  drive.servo = servo;
  read_travel(table, kLargestLength, "m", "along", drive);
}

}  // namespace

Vector3 read_vector(const TomlTable& table, const char* key, const Interval& allowed) {
  return Vector3(table.numbers(key, 3, allowed).data());
}

Vector3 read_direction(const TomlTable& table, const char* key) {
  const Vector3 v = read_vector(table, key, Interval::closed(-1e6, 1e6, "(a direction, not 0)"));
  if (v.norm() > 1e-6) return v.normalized();
  table.refuse(key, " is [0, 0, 0]; allowed: a direction, not 0");
}

Region read_region(const TomlTable& table) {
  const Vector3 corner = read_vector(table, "corner", Interval::closed(-kLargestLength, kLargestLength, "m"));
  const Vector3 size = read_vector(table, "size", Interval::positive(kLargestLength, "m"));
  return {{corner.x(), corner.y(), corner.z()}, {size.x(), size.y(), size.z()}};
}

double read_rpm(const TomlTable& table, const Time& time) {
  const double most = 60 * kLargestTurn / time.step;
  return table.number("rpm", Interval::closed(-most, most, "revolutions a minute (a tenth of one in time.step)"));
}

std::pair<double, double> read_times(const TomlTable& table) {
  constexpr double kLatest = 1e6;
  const double from = table.has("from") ? table.number("from", Interval::closed(0, kLatest, "s")) : 0;
  const double until = table.has("until") ? table.number("until", {from, kLatest, false, true, "s (after from)"})
                                          : std::numeric_limits<double>::infinity();
  return {from, until};
}

std::vector<WallMotion> read_motions(const TomlTable& part, const Time& time) {
  std::vector<WallMotion> motions;
  const std::vector<std::string> keys = {"kind",      "velocity",  "axis",  "point",     "rpm",  "from",
                                         "direction", "amplitude", "phase", "frequency", "until"};
  for (const TomlTable& table : part.tables("motion", keys)) motions.push_back(read_motion(table, time));
  return motions;
}

std::optional<Flight> read_flight(const TomlTable& part, const Wall& wall, const Time& time) {
  const auto table = part.find_table("free", {"mass", "inertia", "centre", "velocity", "angular_velocity", "from"});
  if (!table) return std::nullopt;
  if (!wall.motions.empty() || wall.drive) {
    part.fail("free", std::string("part.free beside part.") + (wall.drive ? "drive" : "motion") +
                          "; allowed: one of both, or part.free.velocity at the start");
  }
  if (!std::isfinite(bounding_radius(wall.shape))) {
    part.fail("free", "part.free of a plane, which is infinite; allowed: with the other shapes");
  }
  Flight flight;
  flight.mass = table->number("mass", Interval::closed(kLightest, kHeaviest, "kg"));
  read_solid(*table, wall, flight);
  if (table->has("velocity")) {
    flight.velocity.linear = read_vector(*table, "velocity", Interval::closed(-kLargestSpeed, kLargestSpeed, "m/s"));
  }
  if (table->has("angular_velocity")) flight.velocity.angular = read_spin(*table, time);
  flight.from = read_times(*table).first;
  return flight;
}

std::optional<Drive> read_drive(const TomlTable& part, const Wall& wall, const std::vector<FacingWalls>& between) {
  const auto table = part.find_table(
      "drive", {"axis", "force", "pressure", "area", "torque", "point", "moment", "power", "largest_force", "largest_torque",
                "stress", "gain", "largest_speed", "between", "mass", "damping", "from", "until", "travel"});
  if (!table) return std::nullopt;
  for (const WallMotion& motion : wall.motions) {
    if (std::holds_alternative<Conveyor>(motion.kind)) {
      part.refuse("drive", " besides a motion of kind \"conveyor\"; allowed: with the other kinds");
    }
  }
  Drive drive{};
  const std::string law = find_law(*table, part.full_name("drive"));
  const auto* const plane = std::get_if<PlaneShape>(&wall.shape);
  drive.axis = plane == nullptr || table->has("axis") ? read_direction(*table, "axis") : wall.start.rotation * plane->normal;
  if (law == "stress") {
    read_servo(*table, wall, between, drive);
  } else if (law == "torque" || (law == "power" && table->has("point"))) {
    read_turning(*table, law, drive);
  } else {
    read_sliding(*table, law, wall, drive);
  }
  std::tie(drive.from, drive.until) = read_times(*table);
  return drive;
}

void load_servos(const TomlTable& root, Scene& scene) {
  for (const auto& [table, index] : tables_of_walls(root, scene)) {
    Wall& wall = scene.walls[index];
    if (!wall.drive || !wall.drive->servo || wall.drive->servo->area > 0 || !wall.drive->servo->between.empty()) continue;
    wall.drive->servo->between = read_facing_walls(table.table("drive"), "between", 2, scene.walls, wall.drive->axis);
  }
}

}  // namespace falling_particles
