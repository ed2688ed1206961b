// What derivatives and clearances cost beside the query, as a Markdown table.
//
//     derivatives_cost [--pairs 1024] [--rounds 7] [--seed 7] [--only TEXT]
//
// Pairs are drawn at a random normal, at which their witness points have the gap. The rounds of all ways of asking are interleaved,
// and the least processor time of each counts.
#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "supernormal/proximity/clearance.hpp"
#include "supernormal/proximity/derivatives.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "support/drawn_pairs.hpp"

namespace {

using namespace supernormal;

enum class Partner { Same, Box, Capsule };

struct Kind {
  const char* name;
  double least_exponent, largest_exponent;
  double gap;  // in units of the smallest half-extent
  Partner partner = Partner::Same;
};

constexpr Kind kKinds[] = {{"ellipsoids, apart", 2, 2, 1},
                           {"ellipsoids, overlap 1 %", 2, 2, -0.01},
                           {"1.3 to 5, apart", 1.3, 5, 1},
                           {"1.3 to 5, overlap 1 %", 1.3, 5, -0.01},
                           {"6 to 20, apart", 6, 20, 1},
                           {"6 to 20, overlap 1 %", 6, 20, -0.01},
                           {"1.3 to 5 and a box, apart", 1.3, 5, 1, Partner::Box},
                           {"1.3 to 5 and a capsule, apart", 1.3, 5, 1, Partner::Capsule}};

struct Pair {
  std::unique_ptr<Shape> shape1, shape2;
  Pose pose1, pose2;
  Proximity answer;
};

std::unique_ptr<Shape> draw_partner(const Kind& kind, drawn_pairs::Draw& draw) {
  switch (kind.partner) {
    case Partner::Box:
      return std::make_unique<Box>(draw.within(0.5, 1.5));
    case Partner::Capsule:
      return std::make_unique<Capsule>(draw.uniform(0.3, 1), draw.uniform(0.5, 1.5));
    case Partner::Same:
      break;
  }
  return draw.shape(draw.within(0.5, 1.5), kind.least_exponent, kind.largest_exponent);
}

std::vector<Pair> draw_pairs(const Kind& kind, std::size_t count, unsigned seed) {
  drawn_pairs::Draw draw(seed);
  std::vector<Pair> pairs(count);
  for (Pair& pair : pairs) {
    pair.shape1 = draw.shape(draw.within(0.5, 1.5), kind.least_exponent, kind.largest_exponent);
    pair.shape2 = draw_partner(kind, draw);
    draw.place(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, kind.gap);
    pair.answer = find_proximity(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2);
  }
  return pairs;
}

/// A way of asking, and what its answers add up to. Nothing of it can be left out by the compiler.
struct Way {
  const char* name;
  std::function<double(const Pair&)> ask;
};

double derivatives(const Pair& pair, const DerivativeSettings& settings) {
  const ProximityDerivatives d =
      find_proximity_derivatives(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, pair.answer, settings);
  return d.normal(0, 0) + d.point1(0, 0) + d.gap_hessian(0, 0);
}

const std::array<Way, 6> kWays = {
    {{"query", [](const Pair& pair) { return find_proximity(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2).gap; }},
     {"gradient",
      [](const Pair& pair) {
        return find_gap_gradient(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, pair.answer).gradient[4];
      }},
     {"first derivatives", [](const Pair& pair) { return derivatives(pair, {.hessian = false, .parameters = false}); }},
     {"all", [](const Pair& pair) { return derivatives(pair, {}); }},
     {"farther than half",
      [](const Pair& pair) {
        return is_farther_than(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, 0.5 * std::abs(pair.answer.gap)) ? 1.0 : 0.0;
      }},
     {"with the last normal", [](const Pair& pair) {
        Vector3 normal = pair.pose1.rotation.transpose() * pair.answer.normal;
        return is_farther_than(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, 0.5 * std::abs(pair.answer.gap), &normal) ? 1.0
                                                                                                                             : 0.0;
      }}}};

void print_row(const Kind& kind, std::size_t count, int rounds, unsigned seed, double& sum) {
  const std::vector<Pair> pairs = draw_pairs(kind, count, seed);
  const std::vector<double> least = drawn_pairs::least_seconds(kWays.size(), rounds, [&](std::size_t way) {
    for (const Pair& pair : pairs) sum += kWays[way].ask(pair);
  });
  std::printf("| %s |", kind.name);
  for (const double seconds : least) std::printf(" %.0f |", 1e9 * seconds / static_cast<double>(count));
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("What derivatives and clearances cost beside the query.");
  std::size_t count = 1024;
  int rounds = 7;
  unsigned seed = 7;
  std::string only;
  app.option_defaults()->always_capture_default();
  app.add_option("--pairs", count, "pairs of a row")->check(CLI::Range(1, 1000000));
  app.add_option("--rounds", rounds, "how often each way of asking is timed")->check(CLI::Range(1, 1000));
  app.add_option("--seed", seed, "another seed: other pairs");
  app.add_option("--only", only, "rows whose name has this text");
  CLI11_PARSE(app, argc, argv);
  double sum = 0;
  std::printf("| pairs |");
  for (const Way& way : kWays) std::printf(" %s, ns |", way.name);
  std::printf("\n|---|--:|--:|--:|--:|--:|--:|\n");
  for (const Kind& kind : kKinds) {
    if (std::string(kind.name).find(only) != std::string::npos) print_row(kind, count, rounds, seed, sum);
  }
  std::fprintf(stderr, "sum of the answers: %g\n", sum);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "derivatives_cost: %s\n", error.what());
  return 1;
}
