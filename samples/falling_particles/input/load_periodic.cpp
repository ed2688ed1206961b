#include <array>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "load_sections.hpp"
#include "model/container_walls.hpp"
#include "model/periodic_walls.hpp"

namespace falling_particles {
namespace {

constexpr std::array kAxes = {"x", "y"};

std::string in_brackets(const Period& period) { return "[" + shortest(period.lower) + ", " + shortest(period.upper()) + "]"; }

/// The axes along which containers can be periodic.
constexpr const char* kAllowed =
    "allowed: periodic.x and periodic.y in a box, a tray or a container of kind \"none\"; periodic.y in a drum, a shear_cell or a "
    "conveyor";

/// The interval between the container's walls along an axis. Empty if the container cannot be periodic along it. A container
/// without walls may have any period.
std::optional<Period> between_walls(const Container& container, std::size_t axis) {
  const Rectangle plan = plan_of(container);
  const bool is_open_everywhere = std::holds_alternative<Box>(container) || std::holds_alternative<Tray>(container);
  const bool is_open_along_y = std::holds_alternative<Drum>(container) || std::holds_alternative<ShearCell>(container) ||
                               std::holds_alternative<ConveyorBelt>(container);
  if (!is_open_everywhere && !(is_open_along_y && axis == 1)) return std::nullopt;
  return Period{plan.corner[axis], plan.width[axis]};
}

void check_start(const TomlTable& table, const char* key, const Period& period, const Open& open, std::size_t axis) {
  const double from = open.start.corner[axis];
  const double to = from + open.start.size[axis];
  if (from >= period.lower && to <= period.upper()) return;
  table.fail(key, "periodic." + std::string(key) + " is " + in_brackets(period) +
                      "; allowed: around container.start, which is from " + shortest(from) + " to " + shortest(to) + " m");
}

Period read_period(const TomlTable& table, std::size_t axis, const Scene& scene) {
  const char* const key = kAxes[axis];
  const std::vector<double> ends = table.numbers(key, 2, Interval::closed(-kLargestLength, kLargestLength, "m"));
  Period period{ends[0], ends[1] - ends[0]};
  const double least = 4 * scene.largest_bounding_radius();
  if (!(period.length >= least)) {
    table.fail(key, "periodic." + std::string(key) + " is " + in_brackets(period) + "; allowed: the upper end at least " +
                        rounded_up(least) + " m above the lower one, so that no grain meets itself");
  }
  if (const Open* open = std::get_if<Open>(&scene.container)) {
    check_start(table, key, period, *open, axis);
    return period;
  }
  const std::optional<Period> whole = between_walls(scene.container, axis);
  if (!whole) table.fail(key, "periodic." + std::string(key) + " in a " + kind_of(scene.container) + "; " + kAllowed);
  constexpr double kRounding = 1e-9;  // of the length
  const double tolerance = kRounding * whole->length;
  if (std::abs(period.lower - whole->lower) > tolerance || std::abs(period.upper() - whole->upper()) > tolerance) {
    table.fail(key, "periodic." + std::string(key) + " is " + in_brackets(period) + "; allowed: " + in_brackets(*whole) +
                        " m, from wall to wall of the container");
  }
  return *whole;
}

}  // namespace

void load_periodic(const TomlTable& root, Scene& scene) {
  const auto table = root.find_table("periodic", {"x", "y"});
  if (!table) return;
  if (std::holds_alternative<Periodic>(scene.container)) {
    root.fail("periodic", "[periodic] beside a periodic container, which repeats in all directions; allowed: one of them");
  }
  if (!table->has("x") && !table->has("y")) table->fail("", "[periodic] names no axis; allowed: x = [lower, upper], y, or both");
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    if (table->has(kAxes[axis])) scene.periodic[axis] = read_period(*table, axis, scene);
  }
  const double reach = 2 * scene.largest_bounding_radius();
  open_container(scene.periodic, reach, walls_in(scene.container).size(), scene.walls);
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    if (!scene.periodic[axis]) continue;
    for (const Wall& wall : scene.walls) {
      const std::optional<std::string> end = find_end(wall, axis, *scene.periodic[axis], reach);
      if (!end) continue;
      table->fail(kAxes[axis],
                  wall.called() + " is not the same all along " + kAxes[axis] + ", on which the scene repeats: " + *end +
                      "; allowed: planes, boxes, cylinders and prisms through the whole cell that move in the same way "
                      "everywhere along it");
    }
  }
}

}  // namespace falling_particles
