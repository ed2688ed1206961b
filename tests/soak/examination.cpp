#include "examination.hpp"

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <string>

#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/solve.hpp"

namespace supernormal::soak {
namespace {

using samples::exact_text;
using samples::HardCase;
using samples::Violations;

constexpr int kExceptions = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;

// The fractions of the samples that get the expensive checks of some hundred evaluations and some ten queries.
constexpr double kMaximumShare = 1.0 / 32, kInvarianceShare = 1.0 / 512;

// The smallest number of queries of samples::check_invariance.
constexpr std::uint64_t kInvarianceQueries = 7;

/// Examines one sample and collects the violations.
class Examiner {
 public:
  Examiner(const Sample& sample, Random random) : sample_(sample), random_(random), rounding_(samples::rounding_of(sample.pair)) {}

  Finding examine(Care care) {
    const HardCase& pair = sample_.pair;
    const Vector3* const start = pair.first_normal ? &*pair.first_normal : nullptr;
    first_ = solve("cold", pair.shape1, pair.pose1, pair.shape2, pair.pose2, sample_.settings, start);
    append("cold", samples::check_answer(pair, sample_.settings, first_));
    if (!finding_.violations.empty()) return finding_;
    bound_ = samples::error_of(pair, sample_.settings, first_) + rounding_;
    GapFunction gap(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2);
    size_ = std::min(pair.shape1->half_extents().maxCoeff(), pair.shape2->half_extents().maxCoeff());
    normal_ = (pair.pose1.rotation.transpose() * first_.normal).normalized();
    ceiling_ = samples::ceiling_of(pair, sample_.settings, first_) + rounding_;
    compare_with_placed_gap();
    look_around(gap);
    ask_swapped();
    ask_warm();
    ask_whether_apart();
    if (care != Care::Usual || random_.chance(kMaximumShare)) {
      append("", samples::check_maximum(pair, sample_.settings, first_, random_.next()));
    }
    if (care == Care::All || random_.chance(kInvarianceShare)) {
      finding_.queries += kInvarianceQueries;
      append("", samples::check_invariance(pair, sample_.settings, first_));
    }
    return finding_;
  }

 private:
  using Body = std::shared_ptr<const Shape>;

  void violate(const char* how, const std::string& what) {
    finding_.violations.push_back(*how == '\0' ? what : std::string(how) + ": " + what);
  }

  void append(const char* how, const Violations& some) {
    for (const std::string& what : some) violate(how, what);
  }

  Proximity solve(const char* how, const Body& shape1, const Pose& pose1, const Body& shape2, const Pose& pose2,
                  const Settings& settings, const Vector3* start) {
    std::feclearexcept(kExceptions);
    const Proximity answer = find_proximity(*shape1, pose1, *shape2, pose2, settings, start);
    // The flags report what a trap would report, and the run continues.
    if (const int raised = std::fetestexcept(kExceptions); raised != 0) {
      violate(how, std::string("floating-point exception") + ((raised & FE_INVALID) != 0 ? ", invalid operation" : "") +
                       ((raised & FE_DIVBYZERO) != 0 ? ", division by zero" : "") +
                       ((raised & FE_OVERFLOW) != 0 ? ", overflow" : ""));
    }
    ++finding_.queries;
    finding_.evaluations += static_cast<std::uint64_t>(answer.evaluations);
    finding_.most_evaluations = std::max(finding_.most_evaluations, answer.evaluations);
    finding_.is_global = finding_.is_global && answer.is_global;
    finding_.is_converged = finding_.is_converged && (answer.status == Status::Converged || answer.status == Status::Apart);
    return answer;
  }

  /// `difference`: the error of an answer, m; `allowed`: its limit.
  bool is_within(double difference, double allowed) {
    finding_.error = std::max(finding_.error, difference / size_);
    finding_.error_of_bound = std::max(finding_.error_of_bound, difference / allowed);
    return difference <= allowed;  // false for NaN
  }

  void compare_with_placed_gap() {
    if (!sample_.placed_gap) return;
    const double placed = *sample_.placed_gap;
    if (placed > bound_ && !first_.is_global) violate("cold", "not sure of bodies that were placed apart by " + exact_text(placed));
    if (!(placed <= ceiling_)) violate_ceiling("the normal that the bodies were placed on", placed);
    if (!first_.is_global) return;
    if (!is_within(placed - first_.gap, bound_)) {
      violate("cold",
              "gap " + exact_text(first_.gap) + ", but the normal that the bodies were placed on has " + exact_text(placed));
    }
    if (placed >= 0 && !is_within(first_.gap - placed, bound_)) {
      violate("cold", "gap " + exact_text(first_.gap) + ", but the bodies were placed apart by " + exact_text(placed));
    }
  }

  /// A few directions: the line of the centres, random ones, and some near the answer.
  void look_around(GapFunction& gap) {
    look_at(gap, gap.offset());
    look_at(gap, random_.direction());
    for (int k = 0; k < 2; ++k) look_at(gap, normal_ + random_.log_uniform(1e-12, 1) * random_.direction());
  }

  void look_at(GapFunction& gap, const Vector3& direction) {
    const double length = direction.norm();
    if (!(length > 0)) return;
    GapJet jet;
    gap.evaluate(direction / length, Order::Value, jet);
    if (first_.is_global) is_within(std::max(jet.s - first_.gap, 0.0), bound_);
    if (!(jet.s <= ceiling_)) violate_ceiling("n " + exact_text(Vector3(direction / length)), jet.s);
  }

  /// No direction may have a larger value of the gap function than the answer allows.
  void violate_ceiling(const std::string& where, double s) {
    violate("cold", "gap " + exact_text(first_.gap) + ", at most " + exact_text(ceiling_) + " as it says, but " + exact_text(s) +
                        " at " + where);
  }

  /// Another answer to the same question. The largest value of the gap function lies in the intervals of both. If both are global,
  /// they must agree.
  void compare(const char* how, const Proximity& second) {
    if (!std::isfinite(second.gap) || !(second.error >= 0)) return violate(how, "no answer");
    if (!(std::abs(second.normal.norm() - 1) <= 1e-15)) return violate(how, "normal of length " + exact_text(second.normal.norm()));
    if (!(second.gap <= ceiling_)) violate_ceiling(how, second.gap);
    const double other_ceiling = samples::ceiling_of(sample_.pair, sample_.settings, second) + rounding_;
    if (!(first_.gap <= other_ceiling))
      violate(how, "at most " + exact_text(other_ceiling) + ", but " + exact_text(first_.gap) + " is known");
    if (!first_.is_global || !second.is_global) return;
    const double allowed = bound_ + samples::error_of(sample_.pair, sample_.settings, second) + rounding_;
    if (is_within(std::abs(second.gap - first_.gap), allowed)) return;
    violate(how, "gap " + exact_text(second.gap) + " instead of " + exact_text(first_.gap));
  }

  void ask_swapped() {
    const HardCase& pair = sample_.pair;
    if (pair.first_normal) return;
    compare("swapped", solve("swapped", pair.shape2, pair.pose2, pair.shape1, pair.pose1, sample_.settings, nullptr));
  }

  /// From a normal near the answer's, as in a simulation.
  void ask_warm() {
    const HardCase& pair = sample_.pair;
    const Vector3 start = (normal_ + random_.log_uniform(1e-16, 1) * random_.direction()).normalized();
    compare("warm", solve("warm", pair.shape1, pair.pose1, pair.shape2, pair.pose2, sample_.settings, &start));
  }

  void ask_whether_apart() {
    const HardCase& pair = sample_.pair;
    Settings early = sample_.settings;
    early.stop_when_apart = true;
    const Proximity second = solve("stopping when apart", pair.shape1, pair.pose1, pair.shape2, pair.pose2, early, nullptr);
    if (second.status != Status::Apart) return compare("stopping when apart", second);
    const bool is_bound = second.gap > 0 && std::isfinite(second.gap) && (!first_.is_global || second.gap <= first_.gap + bound_);
    if (!is_bound) {
      violate("stopping when apart", "apart by " + exact_text(second.gap) + ", but the gap is " + exact_text(first_.gap));
    }
  }

  const Sample& sample_;
  Random random_;
  double rounding_;
  double bound_ = 0;    // m; on the error of the first answer
  double ceiling_ = 0;  // m; upper bound of the gap by the first answer
  double size_ = 1;     // m; of the smaller body
  Proximity first_;
  Vector3 normal_ = Vector3::UnitX();  // the first answer's, in body 1's frame
  Finding finding_;
};

}  // namespace

Finding examine(const Sample& sample, Random random, Care care) { return Examiner(sample, random).examine(care); }

}  // namespace supernormal::soak
