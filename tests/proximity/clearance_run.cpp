// is_farther_than() for any number of random pairs of all kinds. Their gap is known from the normal at which they were placed.
#include <cstdio>
#include <vector>

#include "supernormal/proximity/clearance.hpp"
#include "support/random_bodies.hpp"
#include "whole_number.hpp"

namespace {

using namespace supernormal;
using namespace supernormal::test;

struct Count {
  int pairs = 0;
  double evaluations = 0;

  void add(int count) {
    ++pairs;
    evaluations += count;
  }
  double mean() const { return pairs > 0 ? evaluations / pairs : 0; }
};

struct Row {
  double least_gap, largest_gap;  // smallest half-extents
  double distance;                // gaps
  Count cold = {}, warm = {};
};

}  // namespace

int main(int argc, char** argv) {
  const int pairs = argc == 3 ? whole_number(argv[1]) : -1;
  const int seed = argc == 3 ? whole_number(argv[2]) : -1;
  if (pairs < 1 || seed < 0) {
    std::fprintf(stderr, "clearance PAIRS SEED: PAIRS is a number from 1, SEED one from 0\n");
    return 2;
  }
  std::vector<Row> rows = {{0.5, 8, 0.5},       {0.5, 8, 0.2},  {0.02, 0.5, 0.5}, {0.02, 8, 0.99},
                           {0.02, 8, 1 + 1e-6}, {0.02, 8, 1.5}, {0.02, 8, 4}};
  const std::vector<RandomKind> kinds = random_kinds();
  int wrong = 0;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    RandomBodies bodies(kinds[i], static_cast<unsigned>(seed) + static_cast<unsigned>(i));
    const int count = pairs / static_cast<int>(kinds.size()) + (static_cast<int>(i) < pairs % static_cast<int>(kinds.size()));
    for (int k = 0; k < count; ++k) {
      Row& row = rows[static_cast<std::size_t>(k) % rows.size()];
      const RandomPair pair = bodies.draw(bodies.uniform(row.least_gap, row.largest_gap));
      const double distance = row.distance * pair.placed;
      Vector3 normal = Vector3::Zero();
      for (Count* const answers : {&row.cold, &row.warm}) {
        int evaluations = 0;
        const bool is_farther = is_farther_than(*pair.shape1, {}, *pair.shape2, pair.pose2, distance, &normal, &evaluations);
        wrong += is_farther != (row.distance < 1);
        answers->add(evaluations);
      }
    }
  }
  std::printf("%d pairs, %d wrong answers\n", pairs, wrong);
  std::printf("gap, smallest half-extents | distance, gaps | pairs | evaluations, cold | with the last normal\n");
  for (const Row& row : rows) {
    std::printf("%g to %g | %.7g | %d | %.3f | %.3f\n", row.least_gap, row.largest_gap, row.distance, row.cold.pairs,
                row.cold.mean(), row.warm.mean());
  }
  return wrong == 0 ? 0 : 1;
}
