#include "examination.hpp"

#include <cmath>
#include <string>

#include "supernormal/proximity/gap_function.hpp"

namespace supernormal::soak {
namespace {

using samples::exact_text;
using samples::HardCase;
using samples::Violations;

// The fractions of the samples that get the expensive checks of some hundred evaluations and some ten queries.
constexpr double kMaximumShare = 1.0 / 32, kInvarianceShare = 1.0 / 512;

void append(Violations& all, const Violations& some) { all.insert(all.end(), some.begin(), some.end()); }

/// The gap at which the bodies were placed is one of their normals', and the largest if it is positive.
void compare_with_placed_gap(const Sample& sample, double bound, Finding& finding) {
  const double placed = sample.placed_gap.value_or(0);
  const Proximity& answer = finding.answer;
  const double ceiling = samples::ceiling_of(sample.pair, sample.settings, answer) + samples::rounding_of(sample.pair);
  if (!sample.placed_gap) return;
  if (placed > bound && !answer.is_global) {
    finding.violations.push_back("not sure of bodies that were placed apart by " + exact_text(placed));
  }
  const bool is_above = placed > ceiling || (answer.is_global && placed - answer.gap > bound);
  const bool is_below = answer.is_global && placed >= 0 && answer.gap - placed > bound;
  if (is_above || is_below) {
    finding.violations.push_back("gap " + exact_text(answer.gap) + ", at most " + exact_text(ceiling) +
                                 ", but the bodies were placed with " + exact_text(placed));
  }
}

/// A few directions: the line of the centres, a random one, and some near the answer.
void look_around(const Sample& sample, const Vector3& normal, Random& random, Finding& finding) {
  const HardCase& pair = sample.pair;
  GapFunction gap(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2);
  const double ceiling = samples::ceiling_of(pair, sample.settings, finding.answer) + samples::rounding_of(pair);
  const auto near = [&] { return Vector3(normal + random.log_uniform(1e-12, 1) * random.direction()); };
  for (const Vector3& direction : {gap.offset(), random.direction(), near(), near()}) {
    if (!(direction.norm() > 0)) continue;
    GapJet jet;
    gap.evaluate(direction.normalized(), Order::Value, jet);
    if (!(jet.s <= ceiling)) {
      finding.violations.push_back("at most " + exact_text(ceiling) + ", but " + exact_text(jet.s) + " at n " +
                                   exact_text(direction.normalized()));
    }
  }
}

}  // namespace

Finding examine(const Sample& sample, Random random, Care care) {
  const HardCase& pair = sample.pair;
  Finding finding;
  finding.answer = samples::solve(pair, sample.settings, finding.violations);
  append(finding.violations, samples::check_answer(pair, sample.settings, finding.answer));
  if (!finding.violations.empty()) return finding;
  const Vector3 normal = (pair.pose1.rotation.transpose() * finding.answer.normal).normalized();
  compare_with_placed_gap(sample, samples::error_of(pair, sample.settings, finding.answer) + samples::rounding_of(pair), finding);
  look_around(sample, normal, random, finding);
  // From a normal near the answer's, as in a simulation.
  const Vector3 start = (normal + random.log_uniform(1e-16, 1) * random.direction()).normalized();
  append(finding.violations, samples::check_forms(pair, sample.settings, finding.answer, start, finding.other_forms));
  if (care != Care::Usual || random.chance(kMaximumShare)) {
    append(finding.violations, samples::check_maximum(pair, sample.settings, finding.answer, random.next()));
  }
  if (care == Care::All || random.chance(kInvarianceShare)) {
    append(finding.violations, samples::check_invariance(pair, sample.settings, finding.answer));
  }
  return finding;
}

}  // namespace supernormal::soak
