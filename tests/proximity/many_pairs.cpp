// What a pair costs alone, with derivatives and as a clearance, and among many, by width of the lanes, as a Markdown table.
//
//     many_pairs [--pairs 2048] [--rounds 7] [--seed 7] [--only TEXT]
//
// Pairs are drawn at a random normal, at which their witness points have the gap. The rounds of all ways of asking are interleaved,
// and the least processor time of each counts.
#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "proximity/lanes/lane_query.hpp"
#include "supernormal/proximity/batch.hpp"
#include "supernormal/proximity/clearance.hpp"
#include "supernormal/proximity/derivatives.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/draw.hpp"

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

constexpr Kind kKinds[] = {{"ellipsoids, far apart, cold", 2, 2, 1, false, false},
                           {"ellipsoids, apart, cold", 2, 2, 0.01, false, false},
                           {"ellipsoids, apart, warm", 2, 2, 0.01, true, false},
                           {"ellipsoids, proved apart, warm", 2, 2, 0.1, true, true},
                           {"1.3 to 5, far apart, cold", 1.3, 5, 1, false, false},
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

struct Pair {
  std::unique_ptr<Shape> shape1, shape2;
  Pose pose1, pose2;
  Proximity answer;
  Vector3 earlier_normal;  // in the frame of body 1, of the pose a step before: 1 mm and 1 mrad away
};

class Pairs : test::Draw {
 public:
  Pairs(const Kind& kind, std::size_t count, unsigned seed) : Draw(seed), kind_(kind), pairs_(count) {
    for (Pair& pair : pairs_) {
      draw(pair);
      const Vector3* const normal = kind.is_warm ? &pair.earlier_normal : nullptr;
      queries_.push_back({pair.shape1.get(), &pair.pose1, pair.shape2.get(), &pair.pose2, normal});
    }
  }

  const std::vector<Pair>& pairs() const { return pairs_; }
  const std::vector<ProximityQuery>& queries() const { return queries_; }

 private:
  std::unique_ptr<Shape> shape() {
    Vector3 half = within(0.5, 1.5);
    half.head<2>() *= kind_.thickness;
    if (kind_.least_exponent == kind_.largest_exponent) return std::make_unique<Ellipsoid>(half);
    const double delta = uniform(kind_.least_exponent, kind_.largest_exponent);
    return std::make_unique<Superellipsoid>(half, delta, uniform(kind_.least_exponent, kind_.largest_exponent));
  }

  void draw(Pair& pair) {
    pair.shape1 = shape();
    pair.shape2 = shape();
    pair.pose1 = {within(-10, 10), rotation()};
    pair.pose2.rotation = rotation();
    if (kind_.is_on_faces) {
      lay_on_face(pair);
    } else {
      place(pair);
    }
    Pose earlier = pair.pose2;
    earlier.position += 1e-3 * direction();
    earlier.rotation = Eigen::AngleAxisd(1e-3, direction()).toRotationMatrix() * earlier.rotation;
    pair.answer = find_proximity(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2);
    pair.earlier_normal = pair.pose1.rotation.transpose() * find_proximity(*pair.shape1, pair.pose1, *pair.shape2, earlier).normal;
  }

  void place(Pair& pair) {
    const Vector3 n = direction();
    const double unit = std::min(pair.shape1->half_extents().minCoeff(), pair.shape2->half_extents().minCoeff());
    pair.pose2.position = pair.pose1.position + pair.pose1.rotation * pair.shape1->point(pair.pose1.rotation.transpose() * n) -
                          pair.pose2.rotation * pair.shape2->point(-(pair.pose2.rotation.transpose() * n)) + kind_.gap * unit * n;
  }

  // The faces are not level, so s at their normal is below the largest.
  void lay_on_face(Pair& pair) {
    const double half1 = pair.shape1->half_extents().z(), half2 = pair.shape2->half_extents().z();
    const double height = half1 + half2 + kind_.gap * std::min(half1, half2);
    pair.pose2.rotation = Eigen::AngleAxisd(uniform(-3.14, 3.14), pair.pose1.rotation.col(2)) * pair.pose1.rotation;
    const double y = uniform(-0.5, 0.5), x = uniform(-0.5, 0.5);
    pair.pose2.position = pair.pose1.position + pair.pose1.rotation * Vector3(x, y, height);
  }

  Kind kind_;
  std::vector<Pair> pairs_;
  std::vector<ProximityQuery> queries_;
};

/// A way of asking all pairs, and what its answers add up to: nothing of it can be left out by the compiler.
struct Way {
  const char* name;
  std::function<double()> ask;
};

/// The first asks for the gap alone, and those in lanes are last.
std::vector<Way> ways_of(const Pairs& pairs, const Settings& settings, std::vector<Proximity>& answers) {
  const auto add = [&](const char* name, auto ask) {
    return Way{name, [&, ask] {
                 double sum = 0;
                 for (const Pair& pair : pairs.pairs()) sum += ask(pair);
                 return sum;
               }};
  };
  const auto derivatives = [](const Pair& pair, const DerivativeSettings& of) {
    const auto d = find_proximity_derivatives(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, pair.answer, of);
    return d.normal(0, 0) + d.point1(0, 0) + d.gap_hessian(0, 0);
  };
  const auto is_farther = [](const Pair& pair, Vector3* normal) {
    const double distance = 0.5 * std::abs(pair.answer.gap);
    return is_farther_than(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, distance, normal) ? 1.0 : 0.0;
  };
  std::vector<Way> ways = {
      {"alone",
       [&] {
         for (std::size_t k = 0; k < answers.size(); ++k) answers[k] = find_proximity(pairs.queries()[k], settings);
         return 0.0;
       }},
      add("gradient",
          [](const Pair& pair) {
            return find_gap_gradient(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, pair.answer).gradient[4];
          }),
      add("first derivatives", [=](const Pair& pair) { return derivatives(pair, {.hessian = false, .parameters = false}); }),
      add("all derivatives", [=](const Pair& pair) { return derivatives(pair, {}); }),
      add("farther than half", [=](const Pair& pair) { return is_farther(pair, nullptr); }),
      add("with the last normal", [=](const Pair& pair) {
        Vector3 normal = pair.pose1.rotation.transpose() * pair.answer.normal;
        return is_farther(pair, &normal);
      })};
  const LaneKernels& kernels = lane_kernels();
  for (int k = 1; k < kernels.count; ++k) {
    ways.push_back({kernels.kernels[k]->name, [&, kernel = kernels.kernels[k]] {
                      LaneBatch batch(settings, *kernel, answers);
                      for (std::size_t i = 0; i < answers.size(); ++i) batch.add(pairs.queries()[i], i);
                      batch.solve_rest();
                      return 0.0;
                    }});
  }
  return ways;
}

/// s of this thread's processor time
double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void print_row(const Kind& kind, std::size_t count, int rounds, unsigned seed, double& sum) {
  const Pairs pairs(kind, count, seed);
  const Settings settings{.stop_when_apart = kind.is_early};
  std::vector<Proximity> answers(count);
  const std::vector<Way> ways = ways_of(pairs, settings, answers);
  std::vector<double> least(ways.size(), std::numeric_limits<double>::infinity());  // s
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t way = 0; way < ways.size(); ++way) {
      const double start = processor_seconds();
      sum += ways[way].ask();
      least[way] = std::min(least[way], processor_seconds() - start);
    }
  }
  double evaluations = 0;
  for (const Proximity& answer : answers) evaluations += answer.evaluations;
  std::printf("| %s | %.2f |", kind.name, evaluations / static_cast<double>(count));
  const auto lanes = ways.size() - static_cast<std::size_t>(lane_kernels().count - 1);
  for (std::size_t k = 0; k < lanes; ++k) std::printf(" %.0f |", 1e9 * least[k] / static_cast<double>(count));
  for (std::size_t k = lanes; k < ways.size(); ++k) std::printf(" %.1f |", least[0] / least[k]);
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("What a pair costs alone (ns), with derivatives and as a clearance, and how many times less among many.");
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
  const Pairs none(kKinds[0], 0, seed);
  std::vector<Proximity> no_answers;
  std::string below = "|---|--:|";
  std::printf("| pairs | evaluations |");
  for (const Way& way : ways_of(none, {}, no_answers)) {
    std::printf(" %s |", way.name);
    below += "--:|";
  }
  std::printf("\n%s\n", below.c_str());
  double sum = 0;
  for (const Kind& kind : kKinds) {
    if (std::string(kind.name).find(only) != std::string::npos) print_row(kind, count, rounds, seed, sum);
  }
  std::fprintf(stderr, "sum of the answers: %g\n", sum);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "many_pairs: %s\n", error.what());
  return 1;
}
