#include "world/placement.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "common/random.hpp"
#include "model/lattice.hpp"
#include "scenes.hpp"
#include "support/relative.hpp"

using namespace falling_particles;

TEST_CASE("grains start apart from one another and from the walls") {
  const Scene scene = scene_of(replaced(kSceneText, "count = 5", "count = 300"));
  Random random(3);
  const std::vector<Placement> placements = place(scene, random);
  REQUIRE(placements.size() == 302);
  std::array<int, 2> counts{};
  for (const Placement& p : placements) {
    ++counts[p.kind];
    const double radius = scene.kinds[p.kind].kind.bounding_radius();
    for (std::size_t axis : {0U, 1U}) {
      CHECK(p.position[axis] >= radius);
      CHECK(p.position[axis] <= std::get<Box>(scene.container).width[axis] - radius);
    }
    CHECK(p.position[2] >= scene.drop.height + radius);
    const auto [w, x, y, z] = p.quaternion;
    CHECK(w * w + x * x + y * y + z * z == supernormal::test::relative(1).epsilon(1e-14));
    for (const Placement& q : placements) {
      if (&q == &p) break;
      const double distance =
          std::hypot(p.position[0] - q.position[0], p.position[1] - q.position[1], p.position[2] - q.position[2]);
      CHECK(distance >= (radius + scene.kinds[q.kind].kind.bounding_radius()) * (1 - 1e-12));
    }
  }
  CHECK(counts == std::array<int, 2>{300, 2});
}

TEST_CASE("small grains among large ones start in cells of their own size, and touch nothing") {
  const GrainKind boulder{"boulder", {0.1, 0.1, 0.1}, 2, 2, 0, 2500, "test"};
  const Scene scene = scene_of(Box{{0.41, 0.41}}, {{boulder, 1}, {lentil(), 2000}});
  Random random(1);
  const std::vector<Placement> placements = place(scene, random);
  REQUIRE(placements.size() == 2001);
  // A cell of the boulder holds 4096 lentils, in cells of a sixteenth of its edges.
  CHECK(filled_lattice(scene).top() == supernormal::test::relative(0.001 + 0.204).epsilon(1e-12));
  const auto radius = [&](const Placement& p) { return scene.kinds[p.kind].kind.bounding_radius(); };
  for (const Placement& p : placements) {
    const auto [x, y, z] = p.position;
    CHECK(std::min({x, y, z, 0.41 - x, 0.41 - y, 0.205 - z}) >= radius(p) - 1e-12);
    for (const Placement& q : placements) {
      if (&q == &p) break;
      const bool is_apart = std::hypot(x - q.position[0], y - q.position[1], z - q.position[2]) >= radius(p) + radius(q) - 1e-12;
      if (!is_apart) FAIL_CHECK("two grains overlap");
    }
  }
}

TEST_CASE("the seed determines where grains start") {
  const Scene scene = scene_of(kSceneText);
  const auto first_position = [&scene](std::uint64_t seed) {
    Random random(seed);
    return place(scene, random).front().position;
  };
  CHECK(first_position(1) == first_position(1));
  CHECK(first_position(1) != first_position(2));
}

TEST_CASE("random numbers agree with the engine of the C++ standard") {
  // [rand.predef]: the 10000th output of a default mt19937_64 (seed 5489) is 9981545732273789042.
  Random random(5489);
  for (int i = 1; i < 10000; ++i) random.uniform();
  CHECK(random.uniform() == static_cast<double>(9981545732273789042ULL >> 11) * 0x1p-53);
}

TEST_CASE("random numbers are uniform") {
  Random random(1);
  std::array<int, 3> counts{};
  double rotation_moment = 0;
  constexpr int kDraws = 30000;
  for (int i = 0; i < kDraws; ++i) {
    ++counts[random.below(3)];
    const double w = random.rotation()[0];
    rotation_moment += w * w / kDraws;
  }
  for (const int count : counts) CHECK(std::abs(count - kDraws / 3) < 500);   // six standard deviations
  CHECK(rotation_moment == supernormal::test::relative(0.25).epsilon(0.03));  // each of four components has the same share
}

TEST_CASE("the bounding sphere touches the grain") {
  const auto radius = [](std::array<double, 3> axes, double delta, double epsilon, double rounding) {
    return GrainKind{"grain", axes, delta, epsilon, rounding, 1, ""}.bounding_radius();
  };
  CHECK(radius({3, 4, 12}, 2, 2, 0) == 12);  // an ellipsoid: the longest half-axis
  CHECK(radius({3, 4, 12}, 1.5, 1.1, 0) == 12);
  CHECK(radius({3, 4, 12}, 1000, 1000, 0) ==
        supernormal::test::relative(13).epsilon(2e-3));  // nearly a box: the corner, 3 : 4 : 12 : 13
  CHECK(radius({5, 5, 12}, 2, 1000, 0) == supernormal::test::relative(13).epsilon(2e-3));  // nearly a cylinder: the rim
  CHECK(radius({4, 5, 13}, 1000, 1000, 1) == supernormal::test::relative(14).epsilon(2e-3));
  for (const double p : {3.0, 8.0, 60.0})
    CHECK(radius({2, 2, 2}, p, p, 0) == supernormal::test::relative(2 * std::pow(3, 0.5 - 1 / p)).epsilon(1e-14));
}
