// The pairs of tests/data/known_pairs.txt, which a search has missed: every answer covers what is known of the pair. Where the
// bodies are apart, touch, or overlap by less than the ball that rolls inside them, the answer is proved.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "proximity/covers.hpp"
#include "support/hard_cases/body.hpp"

using namespace supernormal;
using samples::Body;

namespace {

struct KnownPair {
  std::string name;
  std::vector<Body> bodies;
  Pose pose2;
  Settings settings;
  std::optional<Vector3> first_normal;
};

/// The body of a line of the file; x: its parameters.
Body body_of(const std::string& name, const std::vector<double>& x) {
  if (name == "capsule") return samples::capsule(x[0], x[1]);
  if (name == "cylinder") return samples::cylinder(x[0], x[1]);
  std::vector<Vector3> points;
  for (std::size_t k = 0; k + 3 <= x.size(); k += 3) points.emplace_back(x[k], x[k + 1], x[k + 2]);
  if (name == "polytope") return samples::polytope(points);
  if (name == "box") return samples::box(points[0]);
  if (name == "superovoid") return samples::superovoid(points[0], x[3], x[4], x[5], x[6]);
  REQUIRE(name == "superellipsoid");
  return samples::superellipsoid(points[0], x[3], x[4]);
}

/// x: the numbers of the fact.
void check(const KnownPair& pair, const std::string& fact, const std::vector<double>& x) {
  CAPTURE(pair.name);
  const auto shape1 = samples::make_shape(pair.bodies[0]), shape2 = samples::make_shape(pair.bodies[1]);
  const Vector3* const first = pair.first_normal ? &*pair.first_normal : nullptr;
  const Proximity answer = find_proximity(*shape1, {}, *shape2, pair.pose2, pair.settings, first);
  if (fact == "higher") {
    CHECK(test::gap_at(*shape1, {}, *shape2, pair.pose2, {x[0], x[1], x[2]}) <= answer.gap + answer.global_error);
    if (!test::must_be_proved(GapFunction(*shape1, {}, *shape2, pair.pose2), pair.settings, answer.gap)) return;
  } else if (fact == "placed") {
    CHECK(x[0] <= answer.gap + answer.error + 1e-15);
  } else if (fact == "gap") {
    CHECK(std::abs(answer.gap - x[0]) <= x[1]);
  } else if (fact == "touching") {
    CHECK(std::abs(answer.gap) <= answer.error);
    CHECK(answer.error <= 1e-9);
  } else {
    REQUIRE(fact == "apart");
    CHECK(answer.gap > 0);
  }
  CHECK(answer.status == Status::Converged);
  CHECK(answer.is_global);
}

}  // namespace

TEST_CASE("hard cases: no search misses what is known of a pair") {
  std::ifstream file(SUPERNORMAL_TEST_DATA "/known_pairs.txt");
  KnownPair pair;
  int pairs = 0;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    std::vector<double> x;
    for (std::string word; key != "#" && words >> word;) x.push_back(std::strtod(word.c_str(), nullptr));
    if (key == "#") {
      if (pair.name.empty()) pair.name = line;
    } else if (key.empty()) {
      pair = {};
    } else if (key == "rounded") {
      pair.bodies.back().rounding = x[0];
    } else if (key == "callbacks") {
      pair.bodies.back().is_callback = true;
    } else if (key == "at") {
      pair.pose2.position = {x[0], x[1], x[2]};
    } else if (key == "rotation") {
      pair.pose2.rotation << x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7], x[8];
    } else if (key == "tolerance") {
      pair.settings.tolerance = x[0];
    } else if (key == "first") {
      pair.first_normal = {x[0], x[1], x[2]};
    } else if (pair.bodies.size() < 2) {
      pair.bodies.push_back(body_of(key, x));
    } else {
      check(pair, key, x);
      ++pairs;
    }
  }
  CHECK(pairs == 41);
}
