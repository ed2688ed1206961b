#include "doubts.hpp"

#include <supernormal/supernormal.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iterator>
#include <map>
#include <numbers>
#include <stdexcept>

#include "common/input_error.hpp"
#include "common/interval.hpp"
#include "input/load_drive.hpp"
#include "input/state_table.hpp"
#include "model/grain_shape.hpp"
#include "model/lattice.hpp"
#include "model/wall_doubts.hpp"
#include "observe/facing_walls.hpp"
#include "output/wall_mesh.hpp"
#include "world/world.hpp"

namespace falling_particles {
namespace {

struct SurfacePoint {
  Vector3 position;  // m
  Vector3 normal;
};

/// The vertices of the triangles of a wall at its start, with the normals of the triangles.
std::vector<SurfacePoint> surface_of(const Wall& wall, double extent) {
  const Mesh mesh = picture_of(wall, extent).mesh;
  const auto corner = [&](unsigned int index) {
    const auto& [x, y, z] = mesh.vertices[index];
    return wall.moves() ? wall.start(Vector3(x, y, z)) : Vector3(x, y, z);
  };
  std::vector<SurfacePoint> points;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3 normal = (corner(b) - corner(a)).cross(corner(c) - corner(a)).normalized();
    for (const unsigned int index : {a, b, c}) points.push_back({corner(index), normal});
  }
  return points;
}

/// m/s, the largest normal velocity at any time. If `turns`, the wall also rotates, and the direction of a velocity relative to the
/// wall changes.
double normal_speed(const WallMotion& motion, const SurfacePoint& point, bool turns) {
  const auto along = [&](const Vector3& velocity) { return turns ? velocity.norm() : std::abs(point.normal.dot(velocity)); };
  if (const auto* translation = std::get_if<Translation>(&motion.kind)) return along(translation->velocity);
  if (const auto* vibration = std::get_if<Vibration>(&motion.kind)) {
    return along(2 * std::numbers::pi * vibration->frequency * vibration->amplitude);
  }
  if (const auto* rotation = std::get_if<Rotation>(&motion.kind)) {
    const Vector3 spin = 2 * std::numbers::pi / 60 * rotation->rpm * rotation->axis;
    return std::abs(point.normal.dot(spin.cross(point.position - rotation->point)));
  }
  return 0;  // a conveyor stands
}

/// What would make the first displacement of a driven wall smaller, by `factor`.
std::string slower(const Wall& wall, double factor) {
  const Drive& drive = *wall.drive;
  const std::string key = wall.key() + ".drive.";
  if (!drive.servo && drive.mass * factor > kHeaviest) return "a smaller force would do";
  if (drive.servo) return key + "largest_speed up to " + rounded(drive.servo->largest_speed / factor) + " m/s would do";
  return drive.turns() ? key + "moment from " + rounded(drive.mass * factor) + " kg m^2 on would do"
                       : key + "mass from " + rounded(drive.mass * factor) + " kg on would do";
}

/// A remedy in a list of them; none above the most iterations that a scene may have.
std::string more_iterations(double fewest) {
  return fewest > Solver::kMostIterations ? "" : ", solver.iterations from " + std::to_string(std::lround(fewest)) + " on";
}

std::string in_half_axes(double way, const Scene& scene) {
  return rounded(way / scene.smallest_half_axis()) + " of the smallest half-axis (" + rounded(scene.smallest_half_axis(), 6) +
         " m)";
}

/// Adds a doubt about a time that is no multiple of the step.
void add_rounded_times(const Time& time, std::vector<std::string>& doubts) {
  constexpr double kRounding = 1e-6;  // of a step, for typed numbers
  const auto add = [&](const char* key, double value, int steps) {
    if (std::abs(value - steps * time.step) <= kRounding * time.step) return;
    doubts.push_back(std::string(key) + " is " + shortest(value) + " s, no multiple of time.step: it is rounded to " +
                     counted(static_cast<std::size_t>(steps), "step") + "; a multiple of " + shortest(time.step) + " s would do");
  };
  add("time.duration", time.duration, time.steps());
  add("time.frame", time.frame, time.steps_per_frame());
}

bool starts_on_lattice(const Scene& scene) {
  return scene.grains_at_start() > 0 && !scene.start && !std::holds_alternative<Periodic>(scene.container);
}

// m, the largest way along gravity from the lattice, which fills the plan, to the end of the room; infinite where the container is
// open. 0 without gravity, and where grains do not start on a lattice.
double height_of_fall(const Scene& scene) {
  const auto* const gravity = scene.gravity();
  if (gravity == nullptr || !starts_on_lattice(scene)) return 0;
  const Lattice lattice = filled_lattice(scene);
  const auto* const cell = std::get_if<Cell>(&scene.container);  // its planes are around the start
  const Region room = cell != nullptr ? cell->start : room_of(scene.container);
  double height = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double down = gravity->acceleration[axis] / gravity->acceleration.norm();
    if (!(std::abs(down) > 0)) continue;
    // The bounds of an open container may be far below all parts, on which grains land.
    const bool is_bottomless = axis == 2 && is_open(scene.container);
    const double low = is_bottomless ? lowest_start(scene.container) : room.corner[axis],
                 high = room.corner[axis] + room.size[axis];
    const double first = axis == 2 ? lattice.corner()[2] : low, last = axis == 2 ? lattice.top() : high;
    height += down > 0 ? down * (high - first) : -down * (last - low);
  }
  return height;
}

// Adds a doubt about a scene without gravity in which nothing else moves grains.
void add_gravity(const Scene& scene, std::vector<std::string>& doubts) {
  const bool is_at_rest = starts_on_lattice(scene) && scene.feeders.empty() && std::ranges::none_of(scene.walls, &Wall::moves);
  if (scene.gravity() == nullptr && is_at_rest) {
    doubts.emplace_back("the scene has no section [gravity]: grains stay where they start, and nothing moves them");
  }
}

// Adds a doubt about the height of the start. Grains that look ahead are exempt, since they do not pass through what they fall
// onto.
void add_fall(const Scene& scene, std::vector<std::string>& doubts) {
  if (scene.looks_ahead()) return;
  const std::optional<Fall> fall = fall_from_start(scene);
  if (!fall || fall->way <= scene.smallest_half_axis()) return;
  doubts.push_back("from the start grains fall up to " + rounded(fall->height) + " m, and " +
                   moves_too_far("without drag its last grains fall with " + rounded(fall->speed) + " m/s,", fall->way, scene) +
                   "a container with a larger plan, feeders, or time.step up to " +
                   rounded(scene.smallest_half_axis() / fall->speed) + " s would do");
}

/// Adds a doubt about the fastest grain of a state.
void add_speed(const Scene& scene, std::vector<std::string>& doubts) {
  if (!scene.start || scene.looks_ahead()) return;
  const double speed = scene.start->largest_speed();
  if (speed * scene.time.step <= scene.smallest_half_axis()) return;
  doubts.push_back(moves_too_far("the fastest grain of start.file moves", speed * scene.time.step, scene) + "time.step up to " +
                   rounded(scene.smallest_half_axis() / speed) + " s would do");
}

/// m, the depth to which a grain sinks into its support under its own weight; infinite if overlaps are never corrected.
double rest_depth_of(const GrainCount& entry, const Scene& scene) {
  const auto* const gravity = scene.gravity();
  const double weight =
      std::pow(entry.smallest_scale(), 3) * mass_of(entry.kind) * (gravity == nullptr ? 0 : gravity->acceleration.norm());
  return scene.solver.erp == 0 ? INFINITY : scene.solver.cfm * weight * scene.time.step / scene.solver.erp;
}

template <typename Kind>
bool has_effect(const Scene& scene) {
  return std::ranges::any_of(scene.effects, [](const auto& effect) { return std::holds_alternative<Kind>(effect); });
}

/// Whether the scene has contacts with a stiffness of their own.
bool has_soft_contacts(const Scene& scene) {
  return has_effect<supernormal::effects::Compliance>(scene) || has_effect<supernormal::effects::Hertz>(scene);
}

// Adds a doubt about a step in which gravity moves grains so far from rest that their beds sink. README.md, "Before a run", has the
// measurement. A start on a lattice without look-ahead has the doubt about its fall.
void add_sinking(const Scene& scene, std::vector<std::string>& doubts) {
  constexpr double kFar = 0.1;      // of the smallest half-axis; twice as far, beds sink by up to 0.2 of it
  constexpr double kFarAhead = 10;  // the same for grains that look ahead, which sink by up to 0.12
  const auto* const gravity = scene.gravity();
  if (gravity == nullptr || has_soft_contacts(scene) || scene.compression) return;
  const std::optional<Fall> fall = fall_from_start(scene);
  if (!scene.looks_ahead() && fall && fall->way > scene.smallest_half_axis()) return;
  const double acceleration = gravity->acceleration.norm();
  const double way = acceleration * scene.time.step * scene.time.step;
  const double most = (scene.looks_ahead() ? kFarAhead : kFar) * scene.smallest_half_axis();
  if (way <= most) return;
  doubts.push_back("from rest, grains fall " + rounded(way) + " m in a step, " + in_half_axes(way, scene) +
                   ": their beds sink and shake; time.step up to " + rounded(std::sqrt(most / acceleration)) + " s would do");
}

void add_solver(const Scene& scene, std::vector<std::string>& doubts) {
  constexpr double kSunk = 0.1;  // of the smallest half-axis
  if (has_soft_contacts(scene) || scene.compression) return;
  for (const GrainCount& entry : scene.kinds) {
    const double share = rest_depth_of(entry, scene) / (entry.smallest_scale() * entry.kind.smallest_half_axis());
    if (!(share > kSunk)) continue;
    doubts.push_back(std::isfinite(share) ? "grain \"" + entry.kind.name + "\" sinks by " + rounded(share) +
                                                " of its smallest half-axis under its own weight: solver.cfm up to " +
                                                rounded(scene.solver.cfm * kSunk / share) + " s/kg would do"
                                          : "solver.erp is 0: overlaps are never corrected, and grains sink; 0.2 would do");
    return;
  }
}

/// The heaviest and the lightest grain of a scene.
struct Extremes {
  const GrainCount* heavy = nullptr;
  const GrainCount* light = nullptr;
  double most = 0;          // kg
  double least = INFINITY;  // kg
};

Extremes extremes_of(const Scene& scene) {
  Extremes found;
  for (const GrainCount& entry : scene.kinds) {
    if (!scene.has_grains_of(entry)) continue;
    const double mass = mass_of(entry.kind);
    const double most = std::pow(entry.largest_scale(), 3) * mass;
    const double least = std::pow(entry.smallest_scale(), 3) * mass;
    if (most > found.most) {
      found.heavy = &entry;
      found.most = most;
    }
    if (least < found.least) {
      found.light = &entry;
      found.least = least;
    }
  }
  return found;
}

/// m/s, of the correction of overlaps; infinite without a limit.
double largest_correcting_velocity(const Scene& scene) {
  double velocity = INFINITY;
  for (const supernormal::effects::Effect& effect : scene.effects) {
    const auto* const limit = std::get_if<supernormal::effects::MaxCorrectingVelocity>(&effect);
    if (limit != nullptr) velocity = limit->velocity;
  }
  return velocity;
}

/// What presses on grains: a heavy grain, a part with a mass, or a servo.
struct Load {
  double mass;          // kg
  double acceleration;  // m/s^2, without the grains
  double bearers;       // of the lightest grains, that bear it
};

/// A load in steps of a length (s). A servo has the mass step x area / gain.
using LoadInStep = std::function<Load(double)>;

/// How a load sinks into the lightest grains, and what would prevent it.
struct Sinking {
  std::string in_words;
  double excess;      // of the quotient of the remainder
  double step;        // s, the longest
  double iterations;  // the fewest
  double mass;        // kg, the largest with the same acceleration
};

constexpr double kBearers = 4;  // light grains that bear a heavy one; a bed below them spreads the load

/// The quotient f / (1 - f) of a load in a step, with f as below.
struct Remainder {
  double part;     // q
  double unit;     // m; depth for the quotient 1
  double actual;   // the quotient
  double fastest;  // the quotient that no depth makes up for
  double allowed;

  bool is_allowed() const { return !(actual > allowed); }
};

// A light grain of mass m bears the part q m of the load. An iteration of projected Gauss-Seidel on its two contacts leaves
// q / (1 + q) of the error, the squared coupling of the two rows over the product of their diagonals. After n iterations from 0 the
// load still moves with the fraction f = (q / (1 + q))^n of its acceleration. It rests where the correction of its overlap makes up
// for this: (1 - f) erp depth / step = f acceleration step. A servo has no speed from the step before: its acceleration is the
// speed gain x stress over the step. grains.md, "Large and small grains", has the measurements.
Remainder remainder_of(const Load& load, double step, const Extremes& grains, const Scene& scene) {
  constexpr double kDeep = 0.01;  // of the light grain's smallest half-axis: about 1 % of the bed's volume
  const double size = grains.light->smallest_scale() * grains.light->kind.smallest_half_axis();
  const double part = load.mass / grains.least / load.bearers;
  const double unit = load.acceleration * step * step / scene.solver.erp;
  const double fastest = largest_correcting_velocity(scene) / load.acceleration / step;
  return {part, unit, 1 / std::expm1(scene.solver.iterations * std::log1p(1 / part)), fastest,
          std::min(kDeep * size / unit, fastest)};
}

/// The least factor from 1 on for which `holds` is true, if it is so for all larger ones; 1e12 if there is none.
double least_factor(const std::function<bool(double)>& holds) {
  double low = 0, high = std::log(1e12);
  for (int i = 0; i < 50; ++i) {  // to 1e-13
    const double middle = (low + high) / 2;
    (holds(std::exp(middle)) ? high : low) = middle;
  }
  return std::exp(high);
}

/// The answer if quickstep cannot hold the load.
std::optional<Sinking> sinking_of(const LoadInStep& load_in, const Extremes& grains, const Scene& scene) {
  const double step = scene.time.step;
  const Load load = load_in(step);
  if (!(load.acceleration > 0)) return std::nullopt;
  const auto& [part, unit, actual, fastest, allowed] = remainder_of(load, step, grains, scene);
  if (!(actual > allowed)) return std::nullopt;
  const double size = grains.light->smallest_scale() * grains.light->kind.smallest_half_axis();
  const double shorter =
      least_factor([&](double factor) { return remainder_of(load_in(step / factor), step / factor, grains, scene).is_allowed(); });
  return Sinking{"with solver.iterations = " + std::to_string(scene.solver.iterations) + " it sinks into such grains " +
                     (actual > fastest ? "until more than " + std::to_string(std::lround(load.bearers)) + " bear it"
                                       : "by about " + rounded(unit * actual / size) + " of their smallest half-axis"),
                 actual / allowed, step / shorter, std::ceil(std::log1p(1 / allowed) / std::log1p(1 / part)),
                 load.bearers * grains.least / std::expm1(std::log1p(1 / allowed) / scene.solver.iterations)};
}

/// m^2, of a wall as seen from where it presses to, within the plan of the container.
double shown_area(const Wall& wall, const Vector3& direction, const Scene& scene) {
  const Rectangle plan = plan_of(scene.container);
  const std::vector<SurfacePoint> points = surface_of(wall, std::hypot(plan.width[0], plan.width[1]));
  double area = 0;
  for (std::size_t i = 0; i + 2 < points.size(); i += 3) {
    const Vector3 edge = points[i + 1].position - points[i].position;
    area += std::max(0.0, edge.cross(points[i + 2].position - points[i].position).dot(direction) / 2);
  }
  return std::min(area, plan.width[0] * plan.width[1]);
}

/// The lightest grains, as spheres, that lie side by side on an area (m^2).
double bearers_on(double area, const Extremes& grains, const Scene& scene) {
  const double diameter = std::cbrt(6 / std::numbers::pi * grains.least / grains.light->kind.density);
  const double most = scene.feeders.empty() ? static_cast<double>(scene.grains_at_start()) : INFINITY;
  return std::max(kBearers, std::min(area / (diameter * diameter), most));
}

/// The load of a free part, or of one that slides under a force. A smooth body rests on few grains, as a grain does.
Load load_of(const Wall& part, const Extremes& grains, const Scene& scene) {
  const auto* const gravity = scene.gravity();
  Vector3 acceleration = gravity == nullptr ? Vector3::Zero() : gravity->acceleration;
  if (part.drive) {
    acceleration = (part.drive->force / part.drive->mass + acceleration.dot(part.drive->axis)) * part.drive->axis;
  }
  Load load{part.flight ? part.flight->mass : part.drive->mass, acceleration.norm(), kBearers};
  if (std::holds_alternative<SmoothShape>(part.shape) || !(load.acceleration > 0)) return load;
  const double area = shown_area(part, acceleration / load.acceleration, scene);
  if (area == 0) load.acceleration = 0;  // a plane that is drawn off the grains
  load.bearers = bearers_on(area, grains, scene);
  return load;
}

/// m^2, of a servo at the start.
double area_at_start(const Servo& servo, const Scene& scene) {
  double area = servo.area > 0 ? servo.area : 1;
  for (const FacingWalls& pair : servo.between) area *= faces_at_start(pair, scene.walls).distance();
  return area;
}

/// What a doubt says of a load. `remedy`: besides the step and the iterations.
std::string in_words(const Sinking& sinking, const LoadInStep& load, const std::string& remedy, const Extremes& grains,
                     const Scene& scene) {
  return " has " + rounded(load(scene.time.step).mass / grains.least) + " times the mass of the lightest (\"" +
         grains.light->kind.name + "\"): " + sinking.in_words + "; time.step up to " + rounded(sinking.step) + " s" +
         more_iterations(sinking.iterations) + ", or " + remedy + " would do (grains.md)";
}

void add_servo_load(const Wall& part, const Extremes& grains, const Scene& scene, WallDoubts& doubts) {
  const Servo& servo = *part.drive->servo;
  const double area = area_at_start(servo, scene);
  const double bearers = std::holds_alternative<SmoothShape>(part.shape) ? kBearers : bearers_on(area, grains, scene);
  const auto load = [&](double step, double gain) { return Load{step * area / gain, gain * servo.stress / step, bearers}; };
  const LoadInStep load_in = [&](double step) { return load(step, servo.gain); };
  const std::optional<Sinking> sinking = sinking_of(load_in, grains, scene);
  if (!sinking) return;
  const double step = scene.time.step;
  const double larger =
      least_factor([&](double factor) { return remainder_of(load(step, factor * servo.gain), step, grains, scene).is_allowed(); });
  const std::string gain = part.key() + ".drive.gain";
  const std::string remedy = gain + " from " + rounded(larger * servo.gain) + " m/(s Pa) on";
  doubts.add(
      "load of servo", part, sinking->excess,
      " on grains, as a servo of the mass time.step x area / " + gain + ',' + in_words(*sinking, load_in, remedy, grains, scene));
}

/// Adds a doubt if quickstep cannot hold the heaviest grain, or what a part presses, on the lightest grains.
void add_mass_ratio(const Scene& scene, std::vector<std::string>& doubts) {
  const auto* const gravity = scene.gravity();
  const Extremes grains = extremes_of(scene);
  if (grains.heavy == nullptr || has_soft_contacts(scene) || scene.compression || scene.solver.erp == 0) return;
  const Load heaviest{grains.most, gravity == nullptr ? 0 : gravity->acceleration.norm(), kBearers};
  const LoadInStep of_heaviest = [&](double) { return heaviest; };
  if (const std::optional<Sinking> sinking = sinking_of(of_heaviest, grains, scene)) {
    doubts.push_back(
        "the heaviest grain (\"" + grains.heavy->kind.name + "\")" +
        in_words(*sinking, of_heaviest, "densities with masses up to 1 : " + rounded(sinking->mass / grains.least), grains, scene));
  }
  WallDoubts of_walls;
  for (const Wall& part : scene.parts()) {
    if (part.drive && part.drive->servo) add_servo_load(part, grains, scene, of_walls);
    const bool is_pressed = part.drive && !part.drive->servo && !part.drive->turns();
    if (!part.flight && !is_pressed) continue;
    const Load load = load_of(part, grains, scene);
    const LoadInStep load_in = [&](double) { return load; };
    const std::optional<Sinking> sinking = sinking_of(load_in, grains, scene);
    if (!sinking) continue;
    const std::string lighter =
        part.flight ? part.key() + ".free.mass up to " + rounded(sinking->mass) + " kg" : "a smaller force on it";
    of_walls.add(part.flight ? "load of free" : "load of driven", part, sinking->excess,
                 " on grains" + in_words(*sinking, load_in, lighter, grains, scene));
  }
  of_walls.tell(doubts);
}

void add_layer(const Scene& scene, std::vector<std::string>& doubts) {
  if (!scene.looks_ahead()) return;
  for (const supernormal::effects::Effect& effect : scene.effects) {
    const auto* const layer = std::get_if<supernormal::effects::SurfaceLayer>(&effect);
    if (layer == nullptr) continue;
    doubts.push_back("surface_layer leaves grains that rest " + rounded(layer->depth) +
                     " m deep in one another, and speculative_contacts have no need of it: one of both would do");
  }
}

/// Adds a doubt about friction that another effect replaces.
void add_replaced_friction(const Scene& scene, std::vector<std::string>& doubts) {
  using supernormal::effects::AnisotropicFriction, supernormal::effects::Friction;
  if (!has_effect<AnisotropicFriction>(scene) || !has_effect<Friction>(scene)) return;
  doubts.emplace_back(
      "anisotropic_friction replaces friction in all contacts of grains, and friction, friction.walls and part.friction have no "
      "effect: one of both would do");
}

double largest_half_axis(const Scene& scene) {
  double largest = 0;
  for (const GrainCount& entry : scene.kinds) {
    largest = std::max(largest, entry.largest_scale() * std::ranges::max(entry.kind.half_axes));
  }
  return largest;
}

/// Adds a doubt about a length of the resistance to rolling that is a number without unit in other programs.
void add_rolling(const Scene& scene, std::vector<std::string>& doubts) {
  const double size = largest_half_axis(scene);
  const auto add = [&](const char* key, double length) {
    if (length <= size) return;
    doubts.push_back(std::string("rolling_resistance.") + key + " is a length, " + shortest(length) + " m, " +
                     rounded(length / size) + " times the largest half-axis (" + rounded(size, 6) +
                     " m): grains may not roll at all; of a coefficient without unit, such as 0.1, it is the product with the "
                     "radius");
  };
  bool is_first = true;
  for (const supernormal::effects::Effect& effect : scene.effects) {
    const auto* const resistance = std::get_if<supernormal::effects::RollingResistance>(&effect);
    if (resistance == nullptr) continue;
    add(is_first ? "rolling" : "walls", resistance->rolling);  // the effect of grains on walls comes second
    if (is_first) add("spinning", resistance->spinning);
    is_first = false;
  }
}

/// A part that presses grains.
struct Pressing {
  double pressure;    // Pa
  double area;        // m^2
  Vector3 direction;  // unit
};

/// Empty for a part that stands, is moved, turns, or pulls.
std::optional<Pressing> pressing_of(const Wall& part, const Scene& scene) {
  if (part.drive && part.drive->servo) {
    const Servo& servo = *part.drive->servo;
    double area = servo.area > 0 ? servo.area : 1;
    for (const FacingWalls& pair : servo.between) area *= faces_at_start(pair, scene.walls).distance();
    return Pressing{servo.stress, area, part.drive->axis};
  }
  if (!part.flight && (!part.drive || part.drive->turns())) return std::nullopt;
  const auto* const gravity = scene.gravity();
  Vector3 force = gravity == nullptr ? Vector3::Zero() : gravity->acceleration;
  force *= part.flight ? part.flight->mass : part.drive->mass;
  if (part.drive) force = (part.drive->force + force.dot(part.drive->axis)) * part.drive->axis;
  const double size = force.norm();
  const double area = size > 0 ? shown_area(part, force / size, scene) : 0;
  return area > 0 ? std::optional(Pressing{size / area, area, force / size}) : std::nullopt;
}

/// Adds doubts about parts that press springs far together. A contact of the lightest grains bears pressure x diameter^2.
void add_pressed_springs(const Scene& scene, const Extremes& grains, std::vector<std::string>& doubts) {
  constexpr double kDeep =
      0.1;  // of the smallest half-axis, in the mean; the deepest overlap is 0.42, for half 0.30, for twice 0.67
  const double diameter = std::cbrt(6 / std::numbers::pi * grains.least / grains.light->kind.density);
  const double size = grains.light->smallest_scale() * grains.light->kind.smallest_half_axis();
  for (const supernormal::effects::Effect& effect : scene.effects) {
    const auto* const linear = std::get_if<supernormal::effects::Compliance>(&effect);
    const auto* const hertz = std::get_if<supernormal::effects::Hertz>(&effect);
    if (linear == nullptr && hertz == nullptr) continue;
    const double exponent = linear != nullptr ? 1 : 1.5;  // of the force as a power of the depth
    const double factor = linear != nullptr ? linear->stiffness
                                            : 2.0 / 3 * hertz->youngs_modulus / (1 - hertz->poisson_ratio * hertz->poisson_ratio) *
                                                  std::sqrt(size / 2);
    WallDoubts of_walls;
    for (const Wall& part : scene.parts()) {
      const std::optional<Pressing> pressing = pressing_of(part, scene);
      const double depth = pressing ? std::pow(pressing->pressure * diameter * diameter / factor, 1 / exponent) : 0;
      if (!(depth > kDeep * size)) continue;
      const double excess = std::pow(depth / (kDeep * size), exponent);
      const std::string stiffer = linear != nullptr
                                      ? "compliance.stiffness from " + rounded(linear->stiffness * excess) + " N/m"
                                      : "hertz.youngs_modulus from " + rounded(hertz->youngs_modulus * excess) + " Pa";
      of_walls.add("springs", part, excess,
                   " presses with " + rounded(pressing->pressure) + " Pa: the springs of a contact overlap by about " +
                       in_half_axes(depth, scene) + ", and by more in chains of forces; " + stiffer + " on, or up to " +
                       rounded(pressing->pressure / excess) + " Pa would do (parts.md)");
    }
    of_walls.tell(doubts);
    return;
  }
}

/// Adds doubts about parts that press harder than quickstep can carry. A step starts without forces, and an iteration carries them
/// from layer to layer. The force pressure x diameter^2 would move a free grain by force x step^2 / mass. Beds hold it if this is
/// below kHeld half-axes x iterations / layers^2. parts.md, "How hard a part may press", has the measurement.
void add_pressing(const Scene& scene, std::vector<std::string>& doubts) {
  constexpr double kHeld = 0.05;   // beds give way from 0.15 on; twice as much is silent about 0.08 half-axes, 4 layers deep
  constexpr double kPacked = 0.6;  // volume fraction of a bed
  const Extremes grains = extremes_of(scene);
  if (grains.light == nullptr || scene.compression) return;
  if (has_soft_contacts(scene)) return add_pressed_springs(scene, grains, doubts);
  double volume = 0;  // m^3, of all grains
  for (const GrainCount& entry : scene.kinds) {
    for (int i = 0; i < entry.count; ++i) {
      volume += std::pow(entry.scale(static_cast<std::size_t>(i)), 3) * mass_of(entry.kind) / entry.kind.density;
    }
  }
  const double diameter = std::cbrt(6 / std::numbers::pi * grains.least / grains.light->kind.density);
  const double size = grains.light->smallest_scale() * grains.light->kind.smallest_half_axis();
  WallDoubts of_walls;
  for (const Wall& part : scene.parts()) {
    const std::optional<Pressing> pressing = pressing_of(part, scene);
    if (!pressing) continue;
    const auto& [pressure, area, direction] = *pressing;
    const Rectangle plan = plan_of(scene.container);
    const double across = std::max(area, std::abs(direction.z()) * plan.width[0] * plan.width[1]);  // m^2, of the bed
    const double layers = std::max(1.0, volume / (kPacked * across * diameter));
    const double way = pressure * diameter * diameter * scene.time.step * scene.time.step / grains.least;
    const double held = kHeld * size * scene.solver.iterations / (layers * layers);
    if (!(way > held)) continue;
    const double excess = way / held;
    of_walls.add("pressing", part, excess,
                 " presses with " + rounded(pressure) + " Pa on about " + rounded(layers) + (layers == 1 ? " layer" : " layers") +
                     " of grains: a free grain would move by " + rounded(way) + " m in a step, " + in_half_axes(way, scene) +
                     ", and solver.iterations = " + std::to_string(scene.solver.iterations) + " hold " + rounded(held / size) +
                     ": they may overlap, and be pressed through walls; time.step up to " +
                     rounded(scene.time.step / std::sqrt(excess)) + " s" +
                     more_iterations(std::ceil(scene.solver.iterations * excess)) + ", or up to " + rounded(pressure / excess) +
                     " Pa would do (parts.md)");
  }
  of_walls.tell(doubts);
}

/// m, the displacement of a free wall in the first step of its flight; of its farthest point if it turns.
double first_way_of(const Wall& wall, const Flight& flight, double step) {
  return step * (flight.velocity.linear.norm() + flight.velocity.angular.norm() * bounding_radius(wall.shape));
}

/// Adds a doubt about each motion, drive or flight that starts at the end of the run or later.
void add_late(const Scene& scene, const Wall& wall, WallDoubts& doubts) {
  const auto add = [&](const std::string& key, double from) {
    if (from < scene.time.duration) return;
    doubts.add("late " + key, wall, from,
               " has " + key + ".from = " + shortest(from) + " s, and the run ends after " + shortest(scene.time.duration) +
                   " s: it never starts; a smaller " + key + ".from, or a longer time.duration would do");
  };
  for (std::size_t i = 0; i < wall.motions.size(); ++i) add("motion[" + std::to_string(i) + ']', wall.motions[i].from);
  if (wall.drive) add("drive", wall.drive->from);
  if (wall.flight) add("free", wall.flight->from);
}

/// Adds a doubt about a servo on springs. A spring is explicit: it is stable while stiffness x step^2 is below four masses. A servo
/// has the mass step x area / gain, and a contact for each smallest grain that fits on its area.
void add_gain(const Scene& scene, const Wall& wall, WallDoubts& doubts) {
  for (const supernormal::effects::Effect& effect : scene.effects) {
    const auto* const spring = std::get_if<supernormal::effects::Compliance>(&effect);
    if (spring == nullptr) continue;
    const double diameter = 2 * scene.smallest_half_axis();
    const double most = 4 * diameter * diameter / (spring->stiffness * scene.time.step);
    if (wall.drive->servo->gain <= most) continue;
    doubts.add("gain", wall, wall.drive->servo->gain,
               " is a servo with a gain of " + rounded(wall.drive->servo->gain) +
                   " m/(s Pa), with which it may be unstable on the springs of compliance: " + wall.key() + ".drive.gain up to " +
                   rounded(most) + " m/(s Pa), or a smaller time.step would do");
    return;
  }
}

void add_walls(const Scene& scene, std::vector<std::string>& doubts) {
  constexpr double kThin = 1e-6;  // of the smallest half-axis: thinner than the overlap of a contact at rest
  const double size = scene.smallest_half_axis();
  WallDoubts of_walls;
  // A displacement in a step, and what would make it smaller.
  const auto add_way = [&](const std::string& kind, const Wall& wall, const char* does, double way, const auto& remedy) {
    if (way > size) of_walls.add(kind, wall, way, moves_too_far(does, way, scene) + remedy(way));
  };
  const auto shorter = [&](double way) { return "time.step up to " + rounded(scene.time.step * size / way) + " s would do"; };
  for (const Wall& wall : scene.parts()) {
    add_late(scene, wall, of_walls);
    if (const double least = thinnest(wall.shape); least < kThin * size) {
      of_walls.add("thin", wall, -least,
                   " is " + rounded(least) + " m thin, " + in_half_axes(least, scene) + ": is it in another unit?");
    }
    add_way("moves", wall, " moves", normal_way_of(wall, scene), shorter);
    if (wall.flight) add_way("flies", wall, " flies", first_way_of(wall, *wall.flight, scene.time.step), shorter);
    if (!wall.drive) continue;
    if (wall.drive->servo) add_gain(scene, wall, of_walls);
    add_way(wall.drive->servo     ? "servo"
            : wall.drive->turns() ? "turns"
                                  : "slides",
            wall, " is driven", first_way_of(wall, scene.time.step), [&](double way) { return slower(wall, way / size); });
  }
  of_walls.tell(doubts);
}

void add_feeders(const Scene& scene, std::vector<std::string>& doubts) {
  for (const Feeder& feeder : scene.feeders) {
    const double speed = std::hypot(feeder.velocity[0], feeder.velocity[1], feeder.velocity[2]);
    const double way = speed * scene.time.step;
    if (way > scene.smallest_half_axis() && !scene.looks_ahead()) {
      doubts.push_back(moves_too_far("grains of feeder \"" + feeder.name + "\" move", way, scene) + "time.step up to " +
                       rounded(scene.smallest_half_axis() / speed) + " s would do");
    }
    const double on = std::min(feeder.until, scene.time.duration) - feeder.from;
    const double least = feeder.rate.of == Quantity::Of::Mass ? lightest_grain(feeder, scene) : 1;
    if (!(feeder.rate.number * on >= least)) {
      doubts.push_back("feeder \"" + feeder.name + "\" feeds nothing: no grain is due until it ends, or the run; a rate above " +
                       feeder.rate.in_words() + "/s, or a longer time would do");
    }
  }
}

/// Refuses grains of the lattice that start inside a part.
void refuse_start_in_parts(const World& world) {
  const Scene& scene = world.scene();
  std::vector<std::pair<dGeomID, dGeomID>> pairs;
  world.name_wall_pairs(&pairs, [](void* data, dGeomID g1, dGeomID g2) {
    static_cast<std::vector<std::pair<dGeomID, dGeomID>>*>(data)->emplace_back(g1, g2);
  });
  for (const auto& [geom, wall] : pairs) {
    const Wall* part = world.walls().wall_of(wall);
    if (part == nullptr || !part->is_part()) continue;
    snProximity proximity;
    if (snGeomProximity(geom, wall, &proximity) == 0) throw std::runtime_error(std::string("snGeomProximity: ") + snLastError());
    const Grain& grain = *grain_of(geom);
    constexpr double kRounding = 1e-6;  // of the smallest half-axis
    if (!(proximity.gap < -kRounding * grain.smallest_half_axis())) continue;
    const auto [x, y, z] = grain.position();
    throw InputError(scene.called + ": grain " + std::to_string(world.index_of(grain)) + " (" + grain.kind->name + ") starts at [" +
                     rounded(x, 6) + ", " + rounded(y, 6) + ", " + rounded(z, 6) + "] m, " + rounded(-proximity.gap) +
                     " m deep in " + part->called() + "; allowed: walls that leave the start of the grains free");
  }
}

}  // namespace

double first_way_of(const Wall& wall, double step) {
  const Drive& drive = *wall.drive;
  if (drive.servo) return step * std::min(drive.servo->largest_speed, drive.servo->gain * drive.servo->stress);
  const double way = step * step * std::abs(push_of(drive, 0, step)) / (drive.mass + step * drive.damping);
  const double radius = bounding_radius(wall.shape);
  if (!drive.turns() || !std::isfinite(radius)) return way;
  return way * (radius + drive.axis.cross(wall.start.position - *drive.point).norm());
}

std::string moves_too_far(const std::string& who, double way, const Scene& scene) {
  return who + " " + rounded(way) + " m in a step, " + in_half_axes(way, scene) + ": it may pass through what is in its way; ";
}

std::optional<Fall> fall_from_start(const Scene& scene) {
  const double height = height_of_fall(scene);
  if (!(height > 0 && std::isfinite(height))) return std::nullopt;
  const double speed = std::sqrt(2 * scene.gravity()->acceleration.norm() * height);
  return Fall{height, speed, speed * scene.time.step};
}

// README.md, "Contacts before overlap", has the measurement.
std::optional<double> step_for_look_ahead(const Scene& scene) {
  constexpr double kFlat = 4;         // least exponent of grains that lie on faces
  constexpr double kStep = 1.0 / 10;  // of the time in which a grain falls by half its smallest half-axis
  constexpr double kStepOfFlat = 1.0 / 25;
  const auto* const gravity = scene.gravity();
  if (!scene.looks_ahead() || has_soft_contacts(scene) || gravity == nullptr) return std::nullopt;
  const double acceleration = gravity->acceleration.norm();
  if (!(acceleration > 0)) return std::nullopt;
  double least = INFINITY;
  for (const GrainCount& entry : scene.kinds) {
    for (const Component& component : entry.kind.all_components()) {
      const double fall = std::sqrt(entry.smallest_scale() * component.body.smallest_half_axis() / acceleration);
      least = std::min(least, fall * (std::max(component.body.delta, component.body.epsilon) < kFlat ? kStep : kStepOfFlat));
    }
  }
  return least;
}

double normal_way_of(const Wall& wall, const Scene& scene) {
  const auto turns = [](const WallMotion& motion) { return std::holds_alternative<Rotation>(motion.kind); };
  if (wall.motions.empty()) return 0;
  const bool any_turns = std::ranges::any_of(wall.motions, turns);
  const Rectangle plan = plan_of(scene.container);
  double farthest = 0;
  for (const SurfacePoint& point : surface_of(wall, std::hypot(plan.width[0], plan.width[1]))) {
    double speed = 0;
    for (const WallMotion& motion : wall.motions) speed += normal_speed(motion, point, any_turns);
    farthest = std::max(farthest, scene.time.step * speed);
  }
  return farthest;
}

std::vector<std::string> doubts_about(const Scene& scene) {
  std::vector<std::string> doubts;
  add_rounded_times(scene.time, doubts);
  add_gravity(scene, doubts);
  add_fall(scene, doubts);
  add_speed(scene, doubts);
  add_sinking(scene, doubts);
  add_solver(scene, doubts);
  add_mass_ratio(scene, doubts);
  add_pressing(scene, doubts);
  add_layer(scene, doubts);
  add_replaced_friction(scene, doubts);
  add_rolling(scene, doubts);
  add_walls(scene, doubts);
  add_feeders(scene, doubts);
  std::ranges::move(doubts_about_continuation(scene), std::back_inserter(doubts));
  std::ranges::move(doubts_about_springs(scene), std::back_inserter(doubts));
  std::ranges::move(doubts_about_origins(scene), std::back_inserter(doubts));
  std::ranges::move(doubts_about_meetings(scene), std::back_inserter(doubts));
  std::ranges::move(doubts_about_measurements(scene), std::back_inserter(doubts));
  return doubts;
}

void refuse_overlapping_start(const Scene& scene) {
  refuse_meetings(scene);
  if (!scene.start && scene.bonds.empty() && scene.parts().empty()) return;
  Random random(scene.seed);
  const World world(scene, place(scene, random));
  scene.start ? refuse_bad_state(world) : refuse_start_in_parts(world);
  if (!scene.bonds.empty()) refuse_bad_bonds(world);
  refuse_bad_flights(world);
}

}  // namespace falling_particles
