#include "measurement.hpp"

#include <array>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "examination.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/solve.hpp"
#include "support/reference_pairs.hpp"
#include "support/superellipsoid_classes.hpp"

namespace supernormal::ablation {
namespace {

using samples::Body;
using samples::HardCase;

// Kinds of random pairs.
constexpr int kSmooth = 0, kKinked = 1, kNoHessian = 2;

constexpr double kDeepest = 0.3;  // of the smallest half-extent: the overlap along a normal, a lower bound of the depth

constexpr std::uint64_t kSeed = 77;

constexpr int kProofEvaluations = 5000;  // a pair whose maximum is not proved within this limit counts as never missed
constexpr double kMissed = 1e-6;         // of the smallest half-extent

/// Calls function(k, counts of the calling thread) for k < count on two threads.
template <typename Function>
Counts on_two_threads(int count, const Function& function) {
  std::atomic<int> next{0};
  std::array<Counts, 2> counts;
  const auto work = [&](Counts& own) {
    for (int k = next++; k < count; k = next++) function(static_cast<std::size_t>(k), own);
  };
  std::thread other(work, std::ref(counts[1]));
  work(counts[0]);
  other.join();
  counts[0] += counts[1];
  return counts[0];
}

double unit_of(const HardCase& one) { return GapFunction(*one.shape1, one.pose1, *one.shape2, one.pose2).length_unit(); }

Proximity ask(const HardCase& one, const Settings& settings) {
  const Vector3* const start = one.first_normal ? &*one.first_normal : nullptr;
  return find_proximity(*one.shape1, one.pose1, *one.shape2, one.pose2, settings, start);
}

Body draw_body(soak::Random& random, const test::SuperellipsoidClass& kind) {
  const auto axis = [&] { return random.log_uniform(kind.least_axis, kind.largest_axis); };
  const Vector3 axes{axis(), axis(), axis()};
  if (kind.least_exponent == kind.largest_exponent) return samples::ellipsoid(axes);
  const auto exponent = [&] { return random.log_uniform(kind.least_exponent, kind.largest_exponent); };
  const double delta = exponent();
  return samples::superellipsoid(axes, delta, exponent());
}

Body draw_kinked(soak::Random& random) {
  const auto axis = [&] { return random.log_uniform(0.5, 1.5); };
  const Vector3 axes{axis(), axis(), axis()};
  switch (random.below(4)) {
    case 0:
      return samples::box(axes);
    case 1:
      return samples::capsule(axes.x(), axes.z());
    case 2:
      return samples::cylinder(axes.x(), axes.z());
    default:
      break;
  }
  std::vector<Vector3> points(4 + random.below(9));
  for (Vector3& point : points) point = axes.cwiseProduct(random.direction());
  return samples::polytope(std::move(points));
}

}  // namespace

Counts& Counts::operator+=(const Counts& other) {
  queries += other.queries;
  evaluations += other.evaluations;
  unconverged += other.unconverged;
  missed += other.missed;
  violations += other.violations;
  return *this;
}

Measurement::Measurement(int pairs, int samples)
    : samples_(samples),
      smooth_(draw(kSmooth, 2 * pairs)),
      kinked_(draw(kKinked, pairs)),
      no_hessian_(draw(kNoHessian, pairs)),
      mix_(4),
      sharp_(5, soak::Mix::Sharp) {
  for (const test::ReferencePair& pair : test::reference_pairs()) {
    Pair one;
    one.pair.shape1 = pair.shape1;
    one.pair.shape2 = pair.shape2;
    one.pair.pose1 = pair.pose1;
    one.pair.pose2 = pair.pose2;
    one.unit = pair.unit;
    one.maximum = pair.gap;
    one.is_known = true;
    reference_.push_back(one);
  }
  for (const HardCase& hard : samples::hard_cases()) {
    const samples::Reference reference = samples::find_reference(hard);
    catalogue_.push_back({hard, unit_of(hard), reference.lower, true});
  }
}

std::vector<Measurement::Pair> Measurement::draw(int kind, int count) const {
  std::vector<Pair> pairs(static_cast<std::size_t>(count));
  on_two_threads(count, [&](std::size_t k, Counts&) {
    soak::Random random(kSeed + static_cast<std::uint64_t>(kind), k);
    HardCase& one = pairs[k].pair;
    const auto& classes = test::kSuperellipsoidClasses;
    one.body1 = draw_body(random, classes[k % std::size(classes)]);
    one.body2 = kind == kKinked ? draw_kinked(random) : draw_body(random, classes[k % std::size(classes)]);
    if (kind == kNoHessian) {
      one.body1 = one.body1.by_callbacks();
      one.body2 = one.body2.by_callbacks();
    }
    one.shape1 = samples::make_shape(one.body1);
    one.shape2 = samples::make_shape(one.body2);
    one.pose2.rotation = random.rotation();
    pairs[k].unit = std::min(one.shape1->half_extents().minCoeff(), one.shape2->half_extents().minCoeff());
    const Vector3 n = random.direction();
    const Vector3 point2 = one.pose2.rotation * one.shape2->point(-(one.pose2.rotation.transpose() * n));
    one.pose2.position = one.shape1->point(n) - random.uniform(0, kDeepest) * pairs[k].unit * n - point2;
    const Proximity proved = ask(one, {.max_evaluations = kProofEvaluations, .certify_depth = true});
    pairs[k].maximum = proved.gap;
    pairs[k].is_known = proved.is_global;
  });
  return pairs;
}

Counts Measurement::measure(const std::vector<Pair>& pairs) const {
  return on_two_threads(static_cast<int>(pairs.size()), [&](std::size_t k, Counts& counts) {
    const Pair& one = pairs[k];
    const Proximity answer = ask(one.pair, {});
    ++counts.queries;
    counts.evaluations += answer.evaluations;
    const bool is_converged = answer.status == Status::Converged;
    if (!is_converged) ++counts.unconverged;
    if (is_converged && one.is_known && !(answer.gap >= one.maximum - kMissed * one.unit)) ++counts.missed;
    if (!(one.maximum <= answer.gap + answer.global_error + 1e-12 * one.unit + samples::rounding_of(one.pair))) ++counts.violations;
  });
}

Counts Measurement::measure_soak(const soak::SampleSource& source) const {
  return on_two_threads(samples_, [&](std::size_t k, Counts& counts) {
    thread_local soak::Sample sample;
    source.draw(k, sample);
    const soak::Finding finding = soak::examine(sample, source.random_of_checks(k));
    std::vector<Proximity> answers = finding.other_forms;
    answers.push_back(finding.answer);
    counts.queries += static_cast<long>(answers.size());
    for (const Proximity& answer : answers) counts.evaluations += answer.evaluations;
    const bool is_converged = std::ranges::all_of(
        answers, [](const Proximity& answer) { return answer.status == Status::Converged || answer.status == Status::Apart; });
    if (!is_converged && sample.settings.tolerance >= Settings{}.tolerance) ++counts.unconverged;
    if (!finding.violations.empty()) ++counts.violations;
  });
}

Figures Measurement::measure() const {
  return {measure(reference_),  measure(catalogue_), measure(smooth_),    measure(kinked_),
          measure(no_hessian_), measure_soak(mix_),  measure_soak(sharp_)};
}

}  // namespace supernormal::ablation
