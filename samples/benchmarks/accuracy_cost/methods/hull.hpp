// The support function of a convex hull.
#pragma once

#include "common/polyhedron.hpp"

namespace accuracy_cost {

/// The convex hull of a closed mesh whose vertices are all extreme. Its support function climbs from vertex to vertex.
class Hull {
 public:
  explicit Hull(const common::Polyhedron& mesh);

  const supernormal::Vector3& vertex(unsigned index) const { return vertices_[index]; }

  /// The farthest vertex along a direction of any length. The search starts at `start`.
  unsigned support(const supernormal::Vector3& direction, unsigned start) const;

 private:
  std::vector<supernormal::Vector3> vertices_;
  std::vector<unsigned> first_, neighbours_;  // the neighbours of vertex v are first_[v] to first_[v + 1]
};

}  // namespace accuracy_cost
