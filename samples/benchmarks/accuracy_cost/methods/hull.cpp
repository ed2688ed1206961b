#include "hull.hpp"

#include <map>
#include <set>
#include <utility>

namespace accuracy_cost {

using common::Polyhedron;

// Two adjacent triangles may be nearly coplanar, and then the hull may have the other diagonal. So their opposite vertices count as
// neighbours, too.
Hull::Hull(const Polyhedron& mesh) : vertices_(mesh.vertices) {
  std::vector<std::set<unsigned>> neighbours(vertices_.size());
  std::map<std::pair<unsigned, unsigned>, unsigned> opposite;  // opposite vertices of the directed edges
  const auto connect = [&](unsigned a, unsigned b) {
    neighbours[a].insert(b);
    neighbours[b].insert(a);
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    for (const auto& [from, to, other] : {std::array{a, b, c}, std::array{b, c, a}, std::array{c, a, b}}) {
      connect(from, to);
      opposite[{from, to}] = other;
      const auto across = opposite.find({to, from});
      if (across != opposite.end()) connect(other, across->second);
    }
  }
  for (const std::set<unsigned>& of_vertex : neighbours) {
    first_.push_back(static_cast<unsigned>(neighbours_.size()));
    neighbours_.insert(neighbours_.end(), of_vertex.begin(), of_vertex.end());
  }
  first_.push_back(static_cast<unsigned>(neighbours_.size()));
}

unsigned Hull::support(const supernormal::Vector3& direction, unsigned start) const {
  unsigned best = start;
  double height = vertices_[best].dot(direction);
  while (true) {
    const unsigned from = best;
    for (unsigned k = first_[from]; k < first_[from + 1]; ++k) {
      const double other = vertices_[neighbours_[k]].dot(direction);
      if (other <= height) continue;
      height = other;
      best = neighbours_[k];
    }
    if (best == from) return best;
  }
}

}  // namespace accuracy_cost
