#include "parts/container_parts.hpp"

#include <variant>

namespace falling_particles {

std::vector<Part> parts_in(const Container& /*container*/) { return {}; }

}  // namespace falling_particles
