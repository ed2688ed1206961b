// is_farther_than() for random pairs of all kinds. Their gap is known from the normal at which they were placed.
#include <sstream>
#include <string>
#include <vector>

#include "pairs/kinds.hpp"
#include "supernormal/proximity/clearance.hpp"
#include "support/random_bodies.hpp"

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

struct Distances {
  double least_gap, largest_gap;  // smallest half-extents
  double distance;                // gaps
  Count cold = {}, warm = {};
};

}  // namespace

void supernormal::test::run_clearances(const Draws& draws, Report& report) {
  std::vector<Distances> rows = {{0.5, 8, 0.5},       {0.5, 8, 0.2},  {0.02, 0.5, 0.5}, {0.02, 8, 0.99},
                                 {0.02, 8, 1 + 1e-6}, {0.02, 8, 1.5}, {0.02, 8, 4}};
  const std::vector<RandomKind> kinds = random_kinds();
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    RandomBodies bodies(kinds[i], static_cast<unsigned>(draws.seed + i));
    const std::size_t count = draws.count / kinds.size() + (i < draws.count % kinds.size());
    for (std::size_t k = 0; k < count; ++k) {
      Distances& row = rows[k % rows.size()];
      const RandomPair pair = bodies.draw(bodies.uniform(row.least_gap, row.largest_gap));
      const double distance = row.distance * pair.placed;
      Vector3 normal = Vector3::Zero();
      for (Count* const answers : {&row.cold, &row.warm}) {
        int evaluations = 0;
        const bool is_farther = is_farther_than(*pair.shape1, {}, *pair.shape2, pair.pose2, distance, &normal, &evaluations);
        if (is_farther != (row.distance < 1)) report.fault(kinds[i].name + ", pair " + std::to_string(k));
        answers->add(evaluations);
      }
    }
  }
  report.head({"gap, smallest half-extents", "distance, gaps", "pairs", "evaluations, cold", "with the last normal"});
  for (const Distances& row : rows) {
    std::ostringstream gaps;
    gaps << row.least_gap << " to " << row.largest_gap;
    report.row(gaps.str(), {row.distance, static_cast<double>(row.cold.pairs), row.cold.mean(), row.warm.mean()});
  }
}
