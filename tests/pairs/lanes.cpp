// Pairs of eight classes at six gaps among many: their intervals, and their digits in every width of the lanes.
//
// Every second pair starts from the normal of a pose nearby. Batches take turns with four tolerances. Under floating-point traps,
// each pair is asked alone, in every kernel that the processor has, and by find_proximities(). Three facts are tested:
//
// * all answers of a pair are the same to the bit;
// * its interval contains the largest gap: the gap at which the bodies were placed, where that is proved, and an answer at 1e-14,
//   certified where the bodies overlap;
// * no batch allocates.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "pairs/kinds.hpp"
#include "proximity/among_many.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/solve.hpp"
#include "support/counted_allocations.hpp"
#include "support/drawn_pairs.hpp"
#include "support/painted_stack.hpp"
#include "support/traps.hpp"

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

std::unique_ptr<Shape> draw_body(drawn_pairs::Draw& draw, const Class& kind, double size) {
  const Vector3 half = size * kind.factors.cwiseProduct(draw.within(0.5, 1.5));
  if (kind.least_exponent == kind.largest_exponent) return std::make_unique<Ellipsoid>(half);
  const double delta = draw.log_uniform(kind.least_exponent, kind.largest_exponent);
  return std::make_unique<Superellipsoid>(half, delta, draw.log_uniform(kind.least_exponent, kind.largest_exponent));
}

Pair draw_pair(drawn_pairs::Draw& draw, const Class& kind, double gap) {
  Pair pair;
  pair.shape1 = draw_body(draw, kind, 1);
  pair.shape2 = draw_body(draw, kind, std::pow(kind.least_size, draw.uniform(0, 1)));
  const double unit = std::min(pair.shape1->half_extents().minCoeff(), pair.shape2->half_extents().minCoeff());
  pair.placed = gap * unit;
  draw.place(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, gap);
  if (kind.is_on_faces) draw.lay_on_face(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, pair.placed);
  pair.first_normal = draw.earlier_normal(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, unit);
  return pair;
}

struct Row {
  long pairs = 0, different = 0, outside = 0, unproved_references = 0, allocations = 0;
  double evaluations = 0;
  double worst = 0;  // the largest |answer - reference| of a proved answer, of its error
};

/// Pairs of one set that are asked together.
class Batch {
 public:
  Batch(Report& report, const Class& kind, const Gap& gap, const Settings& settings, std::vector<Pair> pairs)
      : report_(report),
        kind_(kind),
        gap_(gap),
        settings_(settings),
        pairs_(std::move(pairs)),
        alone_(pairs_.size()),
        among_(pairs_.size()) {
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
    std::ostringstream what;
    what.precision(17);
    what << kind_.name << ", " << gap_.name << ": the gap is at least " << highest << " and at most " << ceiling
         << ", and the answer " << answer.gap << " to " << answer.gap + answer.global_error;
    report_.fault(what.str());
  }

  Report& report_;
  const Class& kind_;
  const Gap& gap_;
  Settings settings_;
  std::vector<Pair> pairs_;
  std::vector<ProximityQuery> queries_;
  std::vector<Proximity> alone_, among_;
  std::vector<WayAmongMany> ways_ = ways_among_many();
};

void run(const Class& kind, const Gap& gap, std::size_t count, std::uint64_t seed, Report& report) {
  drawn_pairs::Draw draw(seed);
  Row row;
  for (std::size_t first = 0, turn = 0; first < count; first += kBatch, ++turn) {
    Settings settings;
    settings.tolerance = kTolerances[turn % std::size(kTolerances)];
    settings.stop_when_apart = gap.is_early;
    std::vector<Pair> pairs;
    for (std::size_t k = first; k < std::min(first + kBatch, count); ++k) pairs.push_back(draw_pair(draw, kind, gap.placed));
    Batch(report, kind, gap, settings, std::move(pairs)).ask(row);
  }
  const std::string name = std::string(kind.name) + ", " + gap.name;
  report.row(name, {static_cast<double>(row.pairs), row.evaluations / static_cast<double>(row.pairs),
                    static_cast<double>(row.different), static_cast<double>(row.outside), row.worst,
                    static_cast<double>(row.unproved_references), static_cast<double>(row.allocations)});
  if (row.different > 0) report.fault(name + ": pairs have other digits among many than alone");
  if (row.allocations > 0) report.fault(name + ": batches allocate");
}

}  // namespace

void supernormal::test::run_lanes(const Draws& draws, Report& report) {
  for (const WayAmongMany& way : ways_among_many()) std::printf("%s; ", way.name.c_str());
  std::printf("\n\n");
  report.head(
      {"set", "pairs", "evaluations", "differ", "outside", "largest error / bound", "references not proved", "allocations"});
  std::uint64_t seed = draws.seed;
  for (const Class& kind : kClasses) {
    for (const Gap& gap : kGaps) run(kind, gap, draws.count, seed++, report);
  }
}
