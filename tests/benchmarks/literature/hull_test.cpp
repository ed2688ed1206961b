// Test of the support function of the benchmark's hulls.
#include "methods/hull.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

using namespace accuracy_cost;
using supernormal::Vector3;

TEST_CASE("hull: climbing from any vertex ends at the farthest vertex") {
  std::mt19937_64 engine(5);
  std::normal_distribution<double> gauss;
  for (const double exponent : {1.3, 2.0, 4.0, 12.0}) {
    const common::Polyhedron mesh = common::superellipsoid_mesh(Vector3(1, 0.7, 1.3), exponent, exponent, 0, {24, 20});
    const Hull hull(mesh);
    for (int i = 0; i < 2000; ++i) {
      const Vector3 direction(gauss(engine), gauss(engine), gauss(engine));
      const auto start = static_cast<unsigned>(static_cast<unsigned>(i) % mesh.vertices.size());
      const auto height = [&](const Vector3& vertex) { return vertex.dot(direction); };
      const double farthest = std::ranges::max(mesh.vertices, {}, height).dot(direction);
      CHECK(height(hull.vertex(hull.support(direction, start))) >= farthest - 1e-12);
    }
  }
}
