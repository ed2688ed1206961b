#include "container.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace falling_particles {

const char* kind_of(const Container& container) {
  constexpr std::array kKinds = {"box", "hopper", "terrain", "periodic", "none", "drum", "tray", "shear_cell", "conveyor", "cell"};
  return kKinds[container.index()];
}

Rectangle plan_of(const Container& container) {
  return std::visit([](const auto& kind) { return kind.plan(); }, container);
}

bool is_open(const Container& container) {
  return std::holds_alternative<Open>(container) || std::holds_alternative<Cell>(container);
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
  const auto room = [&](const auto& kind) {
    if constexpr (requires { kind.has_room(lower, size); }) return kind.has_room(lower, size);
    return true;  // the plan leaves out the walls, so nothing else can obstruct a cell above it
  };
  return std::visit(room, container);
}

Region room_of(const Container& container) {
  return std::visit([](const auto& kind) -> Region { return kind.room(); }, container);
}

bool contains(const Container& container, const Point& point) {
  return std::visit([&point](const auto& kind) { return kind.contains(point); }, container);
}

}  // namespace falling_particles
