// The same query in other frames, orders and units.
#include <Eigen/Geometry>
#include <cfenv>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "invariants.hpp"

namespace supernormal::samples {
namespace {

const Pose kMotion{{600, -700, 387.2983346207417}, Eigen::Quaterniond(0.8, 0.1, -0.3, 0.5).normalized().toRotationMatrix()};

/// The case in another unit; empty if it would leave the range of a shape.
std::optional<HardCase> rescaled(const HardCase& one, double unit) {
  try {
    return scaled(one, unit);
  } catch (const std::invalid_argument&) {
    return {};
  }
}

/// Compares other answers with the first.
class SecondOpinions {
 public:
  SecondOpinions(const HardCase& one, const Settings& settings, const Proximity& first, Violations& violations)
      : one_(one), settings_(settings), first_(first), violations_(violations) {}

  /// Repeats the query; no digit may differ.
  void ask_again() {
    Violations found;
    std::feclearexcept(FE_UNDERFLOW);
    const Proximity second = solve(one_, settings_, found);
    has_underflow_ = std::fetestexcept(FE_UNDERFLOW) != 0;
    compare_digits(second, 1, found);
    report("asked again", found);
  }

  /// Compares with the answer for `other`, whose lengths are in units of `unit` m. It must be right on its own; if both claim to
  /// be the global maximum, they must agree.
  void compare(const std::string& how, const HardCase& other, double unit = 1) {
    Violations found;
    const Proximity second = solve(other, settings_, found);
    compare_gaps(other, second, unit, found);
    report(how, found);
  }

  /// Compares with the answer in units of a power of two, in which no digit may differ. If a number of one of the two is so small
  /// that it loses digits, the searches may differ, but not the gap.
  void compare_in_units(double unit) {
    Violations found;
    std::feclearexcept(FE_UNDERFLOW);
    const std::optional<HardCase> other = rescaled(one_, unit);
    if (!other) return;
    const Proximity second = solve(*other, settings_, found);
    const bool has_underflow = has_underflow_ || std::fetestexcept(FE_UNDERFLOW) != 0;
    const bool is_near = std::abs(second.gap / unit - first_.gap) <= first_.error + rounding_of(one_);
    if (has_underflow && is_near && second.is_global == first_.is_global) {
      compare_gaps(*other, second, unit, found);
    } else {
      compare_digits(second, unit, found);
    }
    report("in units of " + text(unit) + " m", found);
  }

  /// Compares with a query that stops at the first proof of separation: only for separated bodies, and with a bound.
  void compare_early_stop() {
    Settings early = settings_;
    early.stop_when_apart = true;
    Violations found;
    const Proximity second = solve(one_, early, found);
    const Violations wrong = check_answer(one_, early, second);
    found.insert(found.end(), wrong.begin(), wrong.end());
    const double allowed = error_of(one_, settings_, first_) + rounding_of(one_);
    if (second.status == Status::Apart && !(second.gap > 0)) found.push_back("apart with a gap of " + exact_text(second.gap));
    if (first_.is_global && !(second.gap <= first_.gap + allowed)) {
      found.push_back("apart by " + exact_text(second.gap) + " m, but the gap is " + exact_text(first_.gap) + " m");
    }
    if (first_.gap > allowed && !(second.gap > 0)) found.emplace_back("does not see that the bodies are apart");
    report("stopping when apart", found);
  }

 private:
  void compare_gaps(const HardCase& other, const Proximity& second, double unit, Violations& found) {
    const Violations wrong = check_answer(other, settings_, second);
    found.insert(found.end(), wrong.begin(), wrong.end());
    const double allowed =
        error_of(one_, settings_, first_) + rounding_of(one_) + (error_of(other, settings_, second) + rounding_of(other)) / unit;
    const double difference = second.gap / unit - first_.gap;
    if (first_.is_global && second.is_global && !(std::abs(difference) <= allowed)) {
      found.push_back("the gap differs by " + exact_text(difference) + " m, allowed is " + exact_text(allowed) + " m");
    }
  }

  void compare_digits(Proximity second, double unit, Violations& found) {
    for (double* length : {&second.gap, &second.error}) *length /= unit;
    for (Vector3* point : {&second.point1, &second.point2, &second.contact}) *point /= unit;
    const bool is_same = second.gap == first_.gap && second.error == first_.error && second.normal == first_.normal &&
                         second.evaluations == first_.evaluations && second.status == first_.status &&
                         second.is_global == first_.is_global && second.point1 == first_.point1 && second.point2 == first_.point2 &&
                         second.contact == first_.contact;
    if (is_same) return;
    found.push_back("other digits: gap " + exact_text(second.gap) + " after " + std::to_string(second.evaluations) +
                    " evaluations instead of " + exact_text(first_.gap) + " after " + std::to_string(first_.evaluations));
  }

  void report(const std::string& how, const Violations& found) {
    for (const std::string& sentence : found) violations_.push_back(std::string(how).append(": ").append(sentence));
  }

  const HardCase& one_;
  const Settings& settings_;
  const Proximity& first_;
  Violations& violations_;
  bool has_underflow_ = false;  // whether the first answer underflowed
};

}  // namespace

Violations check_invariance(const HardCase& one, const Settings& settings, const Proximity& answer) {
  Violations violations;
  SecondOpinions opinions(one, settings, answer, violations);
  opinions.ask_again();
  opinions.compare("bodies swapped", swapped(one));
  opinions.compare("in another frame", moved(one, kMotion));
  for (const double unit : {0x1p-10, 0x1p10}) opinions.compare_in_units(unit);
  for (const double unit : {1e-3, 3.}) {
    if (const auto other = rescaled(one, unit)) opinions.compare("in units of " + text(unit) + " m", *other, unit);
  }
  const Vector3 n = one.pose1.rotation.transpose() * answer.normal;
  for (const Vector3& start : {n, Vector3(-n), n.unitOrthogonal()}) {
    HardCase other = one;
    other.first_normal = start;
    opinions.compare("started at " + exact_text(start), other);
  }
  opinions.compare_early_stop();
  return violations;
}

}  // namespace supernormal::samples
