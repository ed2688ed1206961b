// Doubts about walls, of which one sentence stands for all of a kind.
#pragma once

#include <string>
#include <vector>

#include "wall.hpp"

namespace falling_particles {

/// Collects doubts about walls. Six servos of a cell would get six near-equal sentences: of each kind, the worst gets its sentence,
/// which then names the others.
class WallDoubts {
 public:
  /// `kind`: of doubts that one remedy ends; `excess`: how bad this one is; `text`: what follows the name of the wall.
  void add(const std::string& kind, const Wall& wall, double excess, const std::string& text);

  /// Adds a sentence for each kind, in the order of their first walls.
  void tell(std::vector<std::string>& doubts) const;

 private:
  struct Doubt {
    std::string kind, wall;
    double excess;
    std::string sentence;
  };
  std::vector<std::vector<Doubt>> kinds_;
};

}  // namespace falling_particles
