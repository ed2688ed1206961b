// The same question in other forms.
#include <Eigen/Geometry>
#include <cfenv>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "invariants.hpp"

namespace supernormal::samples {
namespace {

const Pose kMotion{{600, -700, 387.2983346207417}, Eigen::Quaterniond(0.8, 0.1, -0.3, 0.5).normalized().toRotationMatrix()};

/// Empty if it would leave the range of a shape.
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

  /// No digit may differ.
  void ask_again() {
    Violations found;
    std::feclearexcept(FE_UNDERFLOW);
    const Proximity second = solve(one_, settings_, found);
    has_underflow_ = std::fetestexcept(FE_UNDERFLOW) != 0;
    compare_digits(second, 1, found);
    report("asked again", found);
  }

  /// Lengths of `other` are in units of `unit` m. Its answer must be right on its own. The largest value of the gap function lies
  /// in the intervals of both. If both claim to be global, they must agree.
  void compare(const std::string& how, const HardCase& other, double unit = 1) {
    Violations found;
    const Proximity second = solve(other, settings_, found);
    compare_gaps(other, second, unit, found);
    report(how, found);
  }

  /// In units of a power of two no digit may differ. If a number of either is so small that it loses digits, they may take
  /// different paths, but not to different gaps.
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

  /// Stopping at the first proof of separation happens only for separated bodies, and gives a bound.
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
    const double rounding = rounding_of(one_) + rounding_of(other) / unit;
    const bool is_common = second.gap / unit <= ceiling_of(one_, settings_, first_) + rounding &&
                           first_.gap <= ceiling_of(other, settings_, second) / unit + rounding;
    if (!is_common) {
      found.push_back("the intervals have nothing in common: gap " + exact_text(first_.gap) + " to " +
                      exact_text(ceiling_of(one_, settings_, first_)) + ", and " + exact_text(second.gap / unit) + " to " +
                      exact_text(ceiling_of(other, settings_, second) / unit));
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
  bool has_underflow_ = false;  // of the first answer
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
