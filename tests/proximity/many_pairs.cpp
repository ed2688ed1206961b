// What a pair costs alone and among many, by width of the lanes, as a Markdown table.
//
//     many_pairs [--pairs 2048] [--rounds 7] [--seed 7] [--only TEXT]
//
// Pairs are drawn at a random normal, at which their witness points have the gap. The rounds of all ways of asking are interleaved,
// and the least processor time of each counts.
#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "proximity/lanes/lane_query.hpp"
#include "supernormal/proximity/batch.hpp"
#include "supernormal/proximity/solve.hpp"
#include "support/drawn_pairs.hpp"

namespace {

using namespace supernormal;

struct Kind {
  const char* name;
  double least_exponent, largest_exponent;
  double gap;  // in units of the smallest half-axis
  bool is_warm;
  bool is_early;             // ends at the first proof of separation
  bool is_on_faces = false;  // the largest faces on one another, at a random place and angle
  double thickness = 1;      // of two half-axes
};

constexpr Kind kKinds[] = {{"ellipsoids, apart, cold", 2, 2, 0.01, false, false},
                           {"ellipsoids, apart, warm", 2, 2, 0.01, true, false},
                           {"ellipsoids, proved apart, warm", 2, 2, 0.1, true, true},
                           {"1.3 to 5, apart, cold", 1.3, 5, 0.01, false, false},
                           {"1.3 to 5, proved apart, warm", 1.3, 5, 0.1, true, true},
                           {"1.3 to 5, overlap 1 %, cold", 1.3, 5, -0.01, false, false},
                           {"1.3 to 5, overlap 1 %, warm", 1.3, 5, -0.01, true, false},
                           {"6 to 20, apart, cold", 6, 20, 0.01, false, false},
                           {"6 to 20, overlap 1 %, cold", 6, 20, -0.01, false, false},
                           {"6 to 20, overlap 1 %, warm", 6, 20, -0.01, true, false},
                           {"6 to 20, overlap 10 %, cold", 6, 20, -0.1, false, false},
                           {"1.05 to 100, apart, cold", 1.05, 100, 0.01, false, false},
                           {"6 to 20, overlap 30 %, cold", 6, 20, -0.3, false, false},
                           {"6 to 20, overlap 30 %, warm", 6, 20, -0.3, true, false},
                           {"1.1 to 1.3, overlap 30 %, cold", 1.1, 1.3, -0.3, false, false},
                           {"1.1 to 1.3, overlap 30 %, warm", 1.1, 1.3, -0.3, true, false},
                           {"needles 2 to 5, overlap 30 %, cold", 2, 5, -0.3, false, false, false, 0.1},
                           {"needles 2 to 5, overlap 30 %, warm", 2, 5, -0.3, true, false, false, 0.1},
                           {"8, face on face, apart, cold", 8, 8.01, 0.01, false, false, true},
                           {"8, face on face, overlap 1 %, warm", 8, 8.01, -0.01, true, false, true},
                           {"20, face on face, apart, cold", 20, 20.01, 0.01, false, false, true},
                           {"20, face on face, overlap 1 %, warm", 20, 20.01, -0.01, true, false, true}};

class Pairs {
 public:
  Pairs(const Kind& kind, std::size_t count, unsigned seed) : kind_(kind), draw_(seed) {
    pairs_.resize(count);
    for (Pair& pair : pairs_) draw(pair);
    for (const Pair& pair : pairs_) {
      queries_.push_back({pair.shape1.get(), &pair.pose1, pair.shape2.get(), &pair.pose2, kind.is_warm ? &pair.normal : nullptr});
    }
  }

  const std::vector<ProximityQuery>& queries() const { return queries_; }

 private:
  struct Pair {
    std::unique_ptr<Shape> shape1, shape2;
    Pose pose1, pose2;
    Vector3 normal;
  };

  std::unique_ptr<Shape> shape() {
    Vector3 half = draw_.within(0.5, 1.5);
    half.head<2>() *= kind_.thickness;
    return draw_.shape(half, kind_.least_exponent, kind_.largest_exponent);
  }

  void draw(Pair& pair) {
    pair.shape1 = shape();
    pair.shape2 = shape();
    draw_.place(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, kind_.gap);
    const Vector3 half1 = pair.shape1->half_extents(), half2 = pair.shape2->half_extents();
    const double gap = kind_.gap * std::min(half1.z(), half2.z());
    if (kind_.is_on_faces) draw_.lay_on_face(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, gap);
    pair.normal = draw_.earlier_normal(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, 1);
  }

  Kind kind_;
  drawn_pairs::Draw draw_;
  std::vector<Pair> pairs_;
  std::vector<ProximityQuery> queries_;
};

void print_row(const Kind& kind, std::size_t count, int rounds, unsigned seed) {
  const Pairs pairs(kind, count, seed);
  const Settings settings{.stop_when_apart = kind.is_early};
  std::vector<Proximity> answers(count);
  std::vector<std::function<void()>> ways = {[&] {
    for (std::size_t k = 0; k < count; ++k) answers[k] = find_proximity(pairs.queries()[k], settings);
  }};
  const LaneKernels& kernels = lane_kernels();
  for (int k = 1; k < kernels.count; ++k) {
    ways.emplace_back([&, kernel = kernels.kernels[k]] {
      LaneBatch batch(settings, *kernel, answers);
      for (std::size_t i = 0; i < count; ++i) batch.add(pairs.queries()[i], i);
      batch.solve_rest();
    });
  }
  const std::vector<double> least = drawn_pairs::least_seconds(ways.size(), rounds, [&](std::size_t way) { ways[way](); });
  double evaluations = 0;
  for (const Proximity& answer : answers) evaluations += answer.evaluations;
  std::printf("| %s | %.2f | %.0f |", kind.name, evaluations / static_cast<double>(count),
              1e9 * least[0] / static_cast<double>(count));
  for (std::size_t k = 1; k < ways.size(); ++k) std::printf(" %.1f |", least[0] / least[k]);
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("What a pair costs alone and among many.");
  std::size_t count = 2048;
  int rounds = 7;
  unsigned seed = 7;
  app.option_defaults()->always_capture_default();
  app.add_option("--pairs", count, "pairs of a row")->check(CLI::Range(1, 1000000));
  app.add_option("--rounds", rounds, "how often each way of asking is timed")->check(CLI::Range(1, 1000));
  app.add_option("--seed", seed, "another seed: other pairs");
  std::string only;
  app.add_option("--only", only, "rows whose name has this text");
  CLI11_PARSE(app, argc, argv);
  std::printf("| pairs | evaluations | alone, ns |");
  for (int k = 1; k < lane_kernels().count; ++k) std::printf(" %s |", lane_kernels().kernels[k]->name);
  std::printf("\n|---|--:|--:|");
  for (int k = 1; k < lane_kernels().count; ++k) std::printf("--:|");
  std::printf("\n");
  for (const Kind& kind : kKinds) {
    if (std::string(kind.name).find(only) != std::string::npos) print_row(kind, count, rounds, seed);
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "many_pairs: %s\n", error.what());
  return 1;
}
