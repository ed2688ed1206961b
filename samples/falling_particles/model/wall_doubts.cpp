#include "wall_doubts.hpp"

#include <algorithm>

namespace falling_particles {

void WallDoubts::add(const std::string& kind, const Wall& wall, double excess, const std::string& text) {
  const std::string sentence = wall.called() + text;
  const auto found = std::ranges::find(kinds_, kind, &Kind::name);
  if (found == kinds_.end()) {
    kinds_.push_back({kind, excess, sentence, {wall.name}, 0});
    return;
  }
  found->names.push_back(wall.name);
  if (excess <= found->excess) return;
  found->excess = excess;
  found->sentence = sentence;
  found->worst = found->names.size() - 1;
}

void WallDoubts::tell(std::vector<std::string>& doubts) const {
  for (const Kind& kind : kinds_) {
    std::string others;
    for (std::size_t i = 0; i < kind.names.size(); ++i) {
      if (i != kind.worst) others += (others.empty() ? "; the same holds for \"" : ", \"") + kind.names[i] + '"';
    }
    doubts.push_back(kind.sentence + others);
  }
}

}  // namespace falling_particles
