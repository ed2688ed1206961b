// Any number of random pairs among many: their intervals, and their digits in every width of the lanes.
//
//     lane_sets PAIRS SEED        PAIRS of each of eight classes at each of six gaps: 48 sets
//
// Every second pair starts from the normal of a pose nearby. Batches take turns with four tolerances. Under floating-point traps,
// each pair is asked alone, in every kernel that the processor has, and by find_proximities(). Three facts are tested:
//
// * all answers of a pair are the same to the bit;
// * its interval contains the largest gap: the gap at which the bodies were placed, where that is proved, and an answer at 1e-14,
//   certified where the bodies overlap;
// * no batch allocates.
//
// Prints a row for each set. Exit code 0: all hold; 1: some do not.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <span>
#include <vector>

#include "proximity/among_many.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/counted_allocations.hpp"
#include "support/painted_stack.hpp"
#include "support/traps.hpp"
#include "whole_number.hpp"

namespace {

using namespace supernormal;
using namespace supernormal::test;

struct Class {
  const char* name;
  double least_exponent, largest_exponent;  // 2 and 2: an Ellipsoid
  Vector3 factors;                          // of half-axes from 0.5 to 1.5 m
  double least_size;                        // body 2 is smaller by a factor from here to 1
  bool is_on_faces;                         // the faces across z meet, aside and rotated about z
};

const Vector3 kEqual = Vector3::Ones();
const Class kClasses[] = {{"ellipsoids", 2, 2, kEqual, 1, false},
                          {"1.3 to 5", 1.3, 5, kEqual, 1, false},
                          {"6 to 20", 6, 20, kEqual, 1, false},
                          {"1.05 to 100", 1.05, 100, kEqual, 1, false},
                          {"needles", 1.3, 5, {0.1, 0.1, 1}, 1, false},
                          {"coins", 1.3, 20, {1, 1, 0.1}, 1, false},
                          {"sizes 1 : 100", 1.3, 20, kEqual, 0.01, false},
                          {"face on face", 3, 60, kEqual, 1, true}};

struct Gap {
  const char* name;
  double placed;  // of the smallest half-extent
  bool is_early;  // ends at the first proof of separation
};

constexpr Gap kGaps[] = {{"far apart, proved", 0.3, true}, {"1 % apart", 0.01, false},    {"touching", 0, false},
                         {"1 % overlap", -0.01, false},    {"10 % overlap", -0.1, false}, {"30 % overlap", -0.3, false}};

constexpr double kTolerances[] = {1e-9, 1e-3, 1e-6, 1e-12};
constexpr std::size_t kBatch = 251;  // a prime number, so that no width fills its lanes evenly

struct Pair {
  std::unique_ptr<Shape> shape1, shape2;
  Pose pose1, pose2;
  double placed = 0;  // m; s at the normal at which the bodies were placed
  Vector3 first_normal;
};

class Drawing {
 public:
  explicit Drawing(unsigned seed) : engine_(seed) {}

  Pair draw(const Class& kind, double gap) {
    Pair pair;
    pair.shape1 = body(kind, 1);
    pair.shape2 = body(kind, std::pow(kind.least_size, uniform(0, 1)));
    pair.pose1 = {Vector3{uniform(-10, 10), uniform(-10, 10), uniform(-10, 10)}, rotation()};
    const double unit = std::min(pair.shape1->half_extents().minCoeff(), pair.shape2->half_extents().minCoeff());
    pair.placed = gap * unit;
    kind.is_on_faces ? lay_on_face(pair) : place_anywhere(pair);
    Pose earlier = pair.pose2;  // as in the step before of a simulation
    earlier.position += 1e-3 * unit * direction();
    earlier.rotation = Eigen::AngleAxisd(1e-3, direction()).toRotationMatrix() * earlier.rotation;
    pair.first_normal = pair.pose1.rotation.transpose() * find_proximity(*pair.shape1, pair.pose1, *pair.shape2, earlier).normal;
    return pair;
  }

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  Vector3 direction() { return Vector3{gauss_(engine_), gauss_(engine_), gauss_(engine_)}.normalized(); }
  Matrix3 rotation() {
    return Eigen::Quaterniond(Eigen::Vector4d{gauss_(engine_), gauss_(engine_), gauss_(engine_), gauss_(engine_)})
        .normalized()
        .toRotationMatrix();
  }

  std::unique_ptr<Shape> body(const Class& kind, double size) {
    const Vector3 half = size * kind.factors.cwiseProduct(Vector3{uniform(0.5, 1.5), uniform(0.5, 1.5), uniform(0.5, 1.5)});
    if (kind.least_exponent == kind.largest_exponent) return std::make_unique<Ellipsoid>(half);
    const double delta = log_uniform(kind.least_exponent, kind.largest_exponent);
    return std::make_unique<Superellipsoid>(half, delta, log_uniform(kind.least_exponent, kind.largest_exponent));
  }

  void place_anywhere(Pair& pair) {
    pair.pose2.rotation = rotation();
    const Vector3 n = direction();
    pair.pose2.position = pair.pose1.position + pair.pose1.rotation * pair.shape1->point(pair.pose1.rotation.transpose() * n) -
                          pair.pose2.rotation * pair.shape2->point(-(pair.pose2.rotation.transpose() * n)) + pair.placed * n;
  }

  void lay_on_face(Pair& pair) {
    const Vector3 n = pair.pose1.rotation.col(2);
    pair.pose2.rotation = Eigen::AngleAxisd(uniform(-3, 3), n) * pair.pose1.rotation;
    const Vector3 aside = 0.5 * (uniform(-1, 1) * pair.pose1.rotation.col(0) + uniform(-1, 1) * pair.pose1.rotation.col(1));
    const double height = pair.shape1->half_extents().z() + pair.shape2->half_extents().z() + pair.placed;
    pair.pose2.position = pair.pose1.position + aside + height * n;
    // The faces are not level, so n is not stationary. Its s is still at most the largest.
  }

  std::mt19937_64 engine_;
  std::normal_distribution<double> gauss_;
};

struct Row {
  long pairs = 0, different = 0, outside = 0, unproved_references = 0, allocations = 0;
  double evaluations = 0;
  double worst = 0;  // the largest |answer - reference| of a proved answer, of its error
};

/// Pairs of one set that are asked together.
class Batch {
 public:
  Batch(const Class& kind, const Gap& gap, const Settings& settings, std::vector<Pair> pairs)
      : kind_(kind), gap_(gap), settings_(settings), pairs_(std::move(pairs)), alone_(pairs_.size()), among_(pairs_.size()) {
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const Pair& pair = pairs_[k];
      const Vector3* const first = k % 2 == 0 ? nullptr : &pair.first_normal;
      queries_.push_back({pair.shape1.get(), &pair.pose1, pair.shape2.get(), &pair.pose2, first});
    }
  }

  void ask(Row& row) {
    row.pairs += static_cast<long>(pairs_.size());
    {
      const Traps traps(kind_.name);
      // The first deep overlap allocates the scratch memory of the thread. So pairs alone come first.
      for (std::size_t k = 0; k < queries_.size(); ++k) alone_[k] = find_proximity(queries_[k], settings_);
    }
    for (const WayAmongMany& way : ways_) compare(row, way);
    for (std::size_t k = 0; k < queries_.size(); ++k) check_interval(row, pairs_[k], alone_[k]);
  }

 private:
  void compare(Row& row, const WayAmongMany& way) {
    std::fill(among_.begin(), among_.end(), Proximity{});
    const long before = allocations();
    {
      const Traps traps(kind_.name);
      way.ask(queries_, settings_, among_);
    }
    row.allocations += allocations() - before;
    for (std::size_t k = 0; k < queries_.size(); ++k) {
      row.different += are_identical(numbers_of(alone_[k]), numbers_of(among_[k])) ? 0 : 1;
    }
  }

  void check_interval(Row& row, const Pair& pair, const Proximity& answer) {
    row.evaluations += answer.evaluations;
    Settings exact;
    exact.tolerance = 1e-14;
    exact.certify_depth = true;
    exact.max_evaluations = 3000;
    const Proximity reference = find_proximity(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, exact);
    row.unproved_references += reference.is_global ? 0 : 1;
    // Positions have the rounding of the bodies' distance from the origin, some 17 m.
    const GapFunction gap(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2);
    const double rounding = 2 * gap.rounding() + 1e-14;
    const double highest = std::max(pair.placed, reference.gap), ceiling = reference.gap + reference.global_error;
    bool is_inside = answer.gap <= ceiling + rounding;
    if (answer.status != Status::Apart) {
      is_inside = is_inside && highest <= answer.gap + answer.global_error + rounding;
      // At a normal on which bodies are placed apart, s is largest.
      if (pair.placed >= 0 && !kind_.is_on_faces) is_inside = is_inside && answer.gap <= pair.placed + rounding;
      if (answer.is_global) row.worst = std::max(row.worst, (highest - answer.gap) / answer.global_error);
    } else {
      is_inside = is_inside && answer.gap > 0;
    }
    if (is_inside && answer.status != Status::InvalidInput) return;
    ++row.outside;
    std::printf("%s, %s: the gap is at least %.17g and at most %.17g, and the answer %.17g to %.17g\n", kind_.name, gap_.name,
                highest, ceiling, answer.gap, answer.gap + answer.global_error);
  }

  const Class& kind_;
  const Gap& gap_;
  Settings settings_;
  std::vector<Pair> pairs_;
  std::vector<ProximityQuery> queries_;
  std::vector<Proximity> alone_, among_;
  std::vector<WayAmongMany> ways_ = ways_among_many();
};

Row run(const Class& kind, const Gap& gap, std::size_t count, unsigned seed) {
  Drawing drawing(seed);
  Row row;
  for (std::size_t first = 0, turn = 0; first < count; first += kBatch, ++turn) {
    Settings settings;
    settings.tolerance = kTolerances[turn % std::size(kTolerances)];
    settings.stop_when_apart = gap.is_early;
    std::vector<Pair> pairs;
    for (std::size_t k = first; k < std::min(first + kBatch, count); ++k) pairs.push_back(drawing.draw(kind, gap.placed));
    Batch(kind, gap, settings, std::move(pairs)).ask(row);
  }
  std::printf("| %s, %s | %ld | %.2f | %ld | %ld | %.2f | %ld | %ld |\n", kind.name, gap.name, row.pairs,
              row.evaluations / static_cast<double>(row.pairs), row.different, row.outside, row.worst, row.unproved_references,
              row.allocations);
  std::fflush(stdout);
  return row;
}

}  // namespace

int main(int argc, char** argv) {
  const int pairs = argc == 3 ? whole_number(argv[1]) : -1;
  const int seed = argc == 3 ? whole_number(argv[2]) : -1;
  if (pairs < 1 || seed < 0) {
    std::fprintf(stderr, "lane_sets PAIRS SEED: PAIRS is a number from 1, SEED one from 0\n");
    return 2;
  }
  for (const WayAmongMany& way : ways_among_many()) std::printf("%s; ", way.name.c_str());
  std::printf(
      "\n\n| set | pairs | evaluations | differ | outside | largest error / bound | references not proved | allocations |\n");
  std::printf("|---|--:|--:|--:|--:|--:|--:|--:|\n");
  Row all;
  auto of_set = static_cast<unsigned>(seed);
  for (const Class& kind : kClasses) {
    for (const Gap& gap : kGaps) {
      const Row row = run(kind, gap, static_cast<std::size_t>(pairs), of_set++);
      all.pairs += row.pairs;
      all.different += row.different;
      all.outside += row.outside;
      all.allocations += row.allocations;
      all.unproved_references += row.unproved_references;
    }
  }
  std::printf("%ld pairs, of which %ld differ, %ld are outside of their interval, and %ld have a reference that is not proved; ",
              all.pairs, all.different, all.outside, all.unproved_references);
  std::printf("%ld allocations\n", all.allocations);
  return all.different == 0 && all.outside == 0 && all.allocations == 0 ? 0 : 1;
}
