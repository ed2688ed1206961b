#include "container/container.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace falling_particles {

const char* kind_of(const Container& container) {
  constexpr std::array kKinds = {"box", "hopper", "terrain", "periodic", "none", "drum", "tray", "shear_cell", "conveyor"};
  return kKinds[container.index()];
}

Rectangle plan_of(const Container& container) {
  return std::visit([](const auto& kind) { return kind.plan(); }, container);
}

double lowest_start(const Container& container) {
  return std::visit([](const auto& kind) { return kind.lowest(); }, container);
}

double ceiling_of(const Container& container) {
  const auto ceiling = [](const auto& kind) {
    if constexpr (requires { kind.ceiling(); }) return kind.ceiling();
    return double{INFINITY};
  };
  return std::visit(ceiling, container);
}

bool has_room(const Container& container, const Point& lower, const Point& size) {
  if (const Drum* drum = std::get_if<Drum>(&container)) return drum->has_room(lower, size);
  const Hopper* hopper = std::get_if<Hopper>(&container);
  if (hopper == nullptr) return true;  // only walls can be in the way of a cell above it, and the plan leaves them out
  // A hopper does not narrow upwards: the cell's lower end decides, at its corner farthest from the axis.
  const double x = std::max(std::abs(lower[0]), std::abs(lower[0] + size[0]));
  const double y = std::max(std::abs(lower[1]), std::abs(lower[1] + size[1]));
  return std::hypot(x, y) <= hopper->radius_at(lower[2]);
}

bool contains(const Container& container, const Point& point) {
  return std::visit([&point](const auto& kind) { return kind.contains(point); }, container);
}

}  // namespace falling_particles
