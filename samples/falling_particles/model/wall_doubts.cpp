#include "wall_doubts.hpp"

#include <algorithm>

namespace falling_particles {

void WallDoubts::add(const std::string& kind, const Wall& wall, double excess, const std::string& text) {
  const auto found = std::ranges::find(kinds_, kind, [](const auto& doubts) { return doubts.front().kind; });
  std::vector<Doubt>& doubts = found == kinds_.end() ? kinds_.emplace_back() : *found;
  doubts.push_back({kind, wall.name, excess, wall.called() + text});
}

void WallDoubts::tell(std::vector<std::string>& doubts) const {
  for (const std::vector<Doubt>& kind : kinds_) {
    const auto worst = std::ranges::max_element(kind, {}, &Doubt::excess);
    std::string others;
    for (const Doubt& doubt : kind) {
      if (&doubt != &*worst) others += (others.empty() ? "; the same holds for \"" : ", \"") + doubt.wall + '"';
    }
    doubts.push_back(worst->sentence + others);
  }
}

}  // namespace falling_particles
