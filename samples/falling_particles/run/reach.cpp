// Doubts about measurements of places that no grain reaches.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <variant>

#include "common/interval.hpp"
#include "doubts.hpp"
#include "model/container.hpp"
#include "model/lattice.hpp"
#include "observe/measurement.hpp"

namespace falling_particles {
namespace {

// Times as high as before rebounds a light grain from a heavy one that falls with it. 1 : 1000 in mass reached 7.6, a bed with a
// restitution of 0.95 reached 4.3, which 4 doubts; 18 is silent about a height in mm for one in cm.
constexpr double kHigher = 9;

/// An interval of an axis, m.
struct Span {
  double lower, upper;

  void add(double from, double to) {
    lower = std::min(lower, from);
    upper = std::max(upper, to);
  }
};

bool is_any_lifted(const Scene& scene) {
  return std::ranges::any_of(scene.walls, &Wall::moves) || std::ranges::any_of(scene.effects, [](const auto& effect) {
           return std::holds_alternative<supernormal::effects::Buoyancy>(effect);
         });
}

/// m, the height from which grains fall: a grain with a speed (m/s) falls as from higher up.
double highest_fall(const Scene& scene, double gravity) {
  double highest = lowest_start(scene.container);
  if (scene.start) {
    for (const StartGrain& grain : scene.start->grains) {
      const auto& [kind, scale, position, quaternion, velocity, spin, line, number] = grain;
      const double radius = scale * scene.kinds[kind].kind.bounding_radius();
      const double speed = std::hypot(velocity[0], velocity[1], velocity[2]) + radius * std::hypot(spin[0], spin[1], spin[2]);
      highest = std::max(highest, position[2] + speed * speed / (2 * gravity));
    }
  } else if (scene.grains_at_start() > 0) {
    highest = filled_lattice(scene).top();
  }
  for (const Feeder& feeder : scene.feeders) {
    const double speed = std::hypot(feeder.velocity[0], feeder.velocity[1], feeder.velocity[2]);
    highest = std::max(highest, feeder.region.corner[2] + feeder.region.size[2] + speed * speed / (2 * gravity));
  }
  return highest;
}

constexpr Span kEverywhere{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};

/// m, along an axis, of the centres of grains that have not leaked. Grains that fall straight down, and that nothing lifts, reach
/// no place high above their start.
Span reach_of(const Scene& scene, std::size_t axis) {
  if (scene.periodic[axis]) return kEverywhere;
  const Region room = room_of(scene.container);
  Span reach{room.corner[axis], room.corner[axis] + room.size[axis]};
  const auto* const gravity = scene.gravity();
  const Vector3 acceleration = gravity == nullptr ? Vector3::Zero() : gravity->acceleration;
  const bool falls = acceleration.z() < 0 && acceleration.head<2>().isZero(0);
  if (axis == 2 && falls && !is_any_lifted(scene)) {
    const double top = highest_fall(scene, -acceleration.z());
    reach.upper = std::min(reach.upper, std::max(top, reach.lower + kHigher * (top - reach.lower)));
  }
  for (const Sink& sink : scene.sinks) {
    const auto* const region = std::get_if<Region>(&sink.region);
    if (region == nullptr) return kEverywhere;
    reach.add(region->corner[axis], region->corner[axis] + region->size[axis]);
  }
  return reach;
}

std::string in_words(const Span& span) {
  if (std::isinf(span.upper)) return "from " + rounded(span.lower) + " m on";
  return "from " + rounded(span.lower) + " to " + rounded(span.upper) + " m";
}

/// What is wrong with a measurement along an axis; "" if nothing is.
std::string doubt_along(const MeasurementRequest& request, const Scene& scene, std::size_t axis) {
  const Span reach = reach_of(scene, axis);
  const std::string centres = ", and all grains are " + in_words(reach) + " there; is it in another unit?";
  const std::string along = std::string(" m along ") + "xyz"[axis];
  if (request.plane && request.plane->axis == axis) {
    const bool is_cell = std::holds_alternative<Periodic>(scene.container);
    const double at = request.plane->at;
    if (!is_cell && (at < reach.lower || at > reach.upper)) {
      return "a plane that no grain reaches: measurement.at is " + shortest(at) + along + centres;
    }
    if (find_measurement_kind(request.kind)->limits_plane) return "";
  }
  if (!request.box) return "";
  const double slack = scene.largest_bounding_radius();  // contacts are beside the centres
  const Span box{request.box->corner[axis], request.box->corner[axis] + request.box->size[axis]};
  if (box.upper > reach.lower - slack && box.lower < reach.upper + slack) return "";
  return "a box that no grain reaches: measurement.lower and upper are " + rounded(box.lower, 6) + " and " + rounded(box.upper, 6) +
         along + centres;
}

}  // namespace

std::vector<std::string> doubts_about_measurements(const Scene& scene) {
  std::vector<std::string> doubts;
  for (const MeasurementRequest& request : scene.measurements) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string doubt = doubt_along(request, scene, axis);
      if (doubt.empty()) continue;
      doubts.push_back("measurement \"" + request.name + "\" has " + doubt);
      break;
    }
  }
  return doubts;
}

}  // namespace falling_particles
