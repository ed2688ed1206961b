// The same question asked in other words.
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "invariants.hpp"

namespace supernormal::samples {
namespace {

const Pose kMotion{{600, -700, 387.2983346207417}, Eigen::Quaterniond(0.8, 0.1, -0.3, 0.5).normalized().toRotationMatrix()};

/// None if it would leave the range of a shape.
std::optional<HardCase> rescaled(const HardCase& one, double unit) {
  try {
    return scaled(one, unit);
  } catch (const std::invalid_argument&) {
    return {};
  }
}

/// Whether every coordinate keeps its digits on the way to a normal, and of the normals to a boundary point: none is so small that
/// a quotient, or a tilt times a component of a normal that is rounding itself, may be denormal.
bool keeps_digits(const HardCase& one) {
  constexpr double kLeast = 1e3 * std::numeric_limits<double>::min();
  constexpr double kLeastTilt = kLeast / std::numeric_limits<double>::epsilon();
  const auto is_less = [](const auto& numbers, double least) { return (numbers != 0 && numbers.abs() < least).any(); };
  for (const Pose* pose : {&one.pose1, &one.pose2}) {
    if (is_less(pose->position.array(), kLeast) || is_less(pose->rotation.array(), kLeastTilt)) return false;
  }
  return true;
}

/// Compares other answers with the first.
class SecondOpinions {
 public:
  SecondOpinions(const HardCase& one, const Settings& settings, const Proximity& first, Violations& violations)
      : one_(one), settings_(settings), first_(first), violations_(violations) {}

  /// Lengths of `other` are in units of `unit` m. Its answer must be right on its own; if both claim to be the global maximum, they
  /// must agree.
  void compare(const std::string& how, const HardCase& other, double unit = 1) {
    Violations found;
    const Proximity second = solve(other, settings_, found);
    const Violations wrong = check_answer(other, settings_, second);
    found.insert(found.end(), wrong.begin(), wrong.end());
    const double allowed =
        error_of(one_, settings_, first_) + rounding_of(one_) + (error_of(other, settings_, second) + rounding_of(other)) / unit;
    const double difference = second.gap / unit - first_.gap;
    if (first_.is_global && second.is_global && !(std::abs(difference) <= allowed)) {
      found.push_back("the gap differs by " + exact_text(difference) + " m, allowed is " + exact_text(allowed) + " m");
    }
    report(how, found);
  }

  /// No digit may differ, except of coordinates so small that the unit of length makes them denormal.
  void compare_digits(const std::string& how, const HardCase& other, double unit) {
    Violations found;
    Proximity second = solve(other, settings_, found);
    for (double* length : {&second.gap, &second.error}) *length /= unit;
    for (Vector3* point : {&second.point1, &second.point2, &second.contact}) *point /= unit;
    const auto same = [](const Vector3& p, const Vector3& q) { return (p - q).cwiseAbs().maxCoeff() <= 1e-280; };
    const bool is_same = second.gap == first_.gap && second.error == first_.error && same(second.normal, first_.normal) &&
                         second.evaluations == first_.evaluations && second.status == first_.status &&
                         second.is_global == first_.is_global && same(second.point1, first_.point1) &&
                         same(second.point2, first_.point2) && same(second.contact, first_.contact);
    if (!is_same) {
      found.push_back("other digits: gap " + exact_text(second.gap) + " after " + std::to_string(second.evaluations) +
                      " evaluations instead of " + exact_text(first_.gap) + " after " + std::to_string(first_.evaluations));
    }
    report(how, found);
  }

  /// Stopping at the first proof of separation: only of separated bodies, and with a bound.
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
  void report(const std::string& how, const Violations& found) {
    for (const std::string& sentence : found) violations_.push_back(std::string(how).append(": ").append(sentence));
  }

  const HardCase& one_;
  const Settings& settings_;
  const Proximity& first_;
  Violations& violations_;
};

}  // namespace

Violations check_invariance(const HardCase& one, const Settings& settings, const Proximity& answer) {
  Violations violations;
  SecondOpinions opinions(one, settings, answer, violations);
  opinions.compare_digits("asked again", one, 1);
  opinions.compare("bodies swapped", swapped(one));
  opinions.compare("in another frame", moved(one, kMotion));
  for (const double unit : {0x1p-10, 0x1p10}) {
    const auto other = rescaled(one, unit);
    if (other && keeps_digits(one) && keeps_digits(*other)) {
      opinions.compare_digits("in units of " + text(unit) + " m", *other, unit);
    }
  }
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
