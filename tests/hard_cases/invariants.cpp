#include "invariants.hpp"

#include <Eigen/Geometry>
#include <cfenv>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

#include "proximity/collider_reference.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/solve.hpp"
#include "support/draw.hpp"

namespace supernormal::samples {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr int kExceptions = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;

GapFunction gap_of(const HardCase& one) { return {*one.shape1, one.pose1, *one.shape2, one.pose2}; }

/// Whether `point` (world frame) lies on the boundary of the shape where the outward normal is `normal`.
class OnSurface {
 public:
  OnSurface(const Shape& shape, const Pose& pose, double rounding) : shape_(shape), pose_(pose), rounding_(rounding) {}

  void check(const char* name, const Vector3& point, const Vector3& normal, Violations& out) const {
    const Vector3 x = pose_.rotation.transpose() * (point - pose_.position);
    const Vector3 n = (pose_.rotation.transpose() * normal).normalized();
    const double below = shape_.support(n) - n.dot(x);
    if (!(below <= rounding_)) out.push_back(name + std::string(" is ") + exact_text(below) + " m below its tangent plane");
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 side = Vector3::Unit(axis) * std::copysign(1, x[axis]);
      check_inside(name, x, side, out);
      check_inside(name, x, (n + side).normalized(), out);
    }
  }

 private:
  void check_inside(const char* name, const Vector3& x, const Vector3& direction, Violations& out) const {
    const double above = direction.dot(x) - shape_.support(direction);
    if (!(above <= rounding_)) {
      out.push_back(name + std::string(" is ") + exact_text(above) + " m outside the body along " + exact_text(direction));
    }
  }

  const Shape& shape_;
  const Pose& pose_;
  double rounding_;
};

bool is_finite(const Proximity& answer) {
  return std::isfinite(answer.gap) && std::isfinite(answer.error) && answer.normal.allFinite() && answer.point1.allFinite() &&
         answer.point2.allFinite() && answer.contact.allFinite();
}

void check_status(const GapFunction& gap, const Settings& settings, const Proximity& answer, Violations& out) {
  const bool is_early = answer.status == Status::Apart && settings.stop_when_apart;
  const bool is_known = answer.status == Status::Converged || answer.status == Status::Stalled ||
                        answer.status == Status::EvaluationLimit || is_early;
  if (!is_known) out.push_back("status " + std::to_string(static_cast<int>(answer.status)));
  const double promised = std::max(settings.tolerance * gap.length_unit(), 5 * gap.rounding());
  if (answer.status == Status::Converged && !(answer.error <= promised * (1 + 4 * kEpsilon))) {
    out.push_back("converged with an error of " + exact_text(answer.error) + " m; the tolerance is " + exact_text(promised) + " m");
  }
  if (answer.status == Status::EvaluationLimit && answer.evaluations < settings.max_evaluations) {
    out.push_back("evaluation limit after " + std::to_string(answer.evaluations) + " evaluations");
  }
  if (!(answer.error >= 0)) out.push_back("negative error " + exact_text(answer.error));
  if (!(answer.global_error >= 0)) out.push_back("negative global error " + exact_text(answer.global_error));
  // Proved for every answer if the bodies are apart, touch, or overlap by less than the rolling radius.
  const double tolerance = std::max(settings.tolerance * gap.length_unit() - gap.rounding(), 2 * gap.rounding());
  if (!(2 * answer.gap >= -tolerance || answer.gap + gap.rolling_radius() > 0)) return;
  if (!answer.is_global) out.push_back("gap " + exact_text(answer.gap) + ", but not sure to be global");
}

// The neighbourhood: rings around the normal, from rounding up to an angle of about 1.
constexpr int kDirections = 8, kRings = 25;
constexpr double kFirstAngle = 1e-15, kNextRing = 4;

constexpr int kRandomDirections = 50;

/// The box with the half-extents and the octahedron inscribed in it.
struct Features {
  std::vector<Vector3> face_normals;
  std::vector<Vector3> edges;  // directions

  explicit Features(const Vector3& half) {
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 along = half[axis] * Vector3::Unit(axis);
      const Vector3 next = half[(axis + 1) % 3] * Vector3::Unit((axis + 1) % 3);
      face_normals.emplace_back(Vector3::Unit(axis));
      edges.insert(edges.end(), {Vector3::Unit(axis), along + next, along - next});
    }
    for (const double x : {-1., 1.}) {
      for (const double y : {-1., 1.})
        face_normals.emplace_back(x * half.y() * half.z(), y * half.x() * half.z(), half.x() * half.y());
    }
  }
};

/// Searches for normals that are higher than the answer allows.
class Probe {
 public:
  Probe(const HardCase& one, const Settings& settings, const Proximity& answer)
      : gap_(*one.shape1, one.pose1, *one.shape2, one.pose2),
        n_((one.pose1.rotation.transpose() * answer.normal).normalized()),
        ceiling_(ceiling_of(one, settings, answer) + 2 * gap_.rounding()) {}

  void look_at_neighbourhood(Violations& out) {
    const Vector3 tangent1 = n_.unitOrthogonal(), tangent2 = n_.cross(tangent1);
    for (int k = 0; k < kDirections; ++k) {
      const double turn = 2 * 3.14159265358979 * (k + 0.25) / kDirections;
      const Vector3 tangent = std::cos(turn) * tangent1 + std::sin(turn) * tangent2;
      double angle = kFirstAngle;
      for (int ring = 0; ring < kRings; ++ring, angle *= kNextRing) look_at_unit((n_ + angle * tangent).normalized(), out);
    }
  }

  void look_at(const Vector3& direction, Violations& out) {
    const double length = direction.norm();
    if (!(length > 0)) return;
    for (const double sign : {-1., 1.}) look_at_unit(direction * (sign / length), out);
  }

  /// Faces, edges and pairs of edges of the boxes and octahedra that the bodies may resemble.
  void look_at_features(const HardCase& one, Violations& out) {
    const Features features1(one.shape1->half_extents()), features2(one.shape2->half_extents());
    for (const Vector3& normal : features1.face_normals) look_at(normal, out);
    for (const Vector3& normal : features2.face_normals) look_at(gap_.rotation() * normal, out);
    for (const Vector3& edge1 : features1.edges) {
      for (const Vector3& edge2 : features2.edges) look_at(edge1.cross(gap_.rotation() * edge2), out);
    }
    for (int axis = 0; axis < 3; ++axis) look_at(Vector3::Unit(axis), out);
    look_at(gap_.offset().normalized(), out);
  }

 private:
  void look_at_unit(const Vector3& n, Violations& out) {
    GapJet jet;
    gap_.evaluate(n, Order::Value, jet);
    if (jet.s <= ceiling_) return;
    out.push_back("not the global maximum: " + exact_text(jet.s - ceiling_) + " m more than it may be at n " + exact_text(n));
  }

  GapFunction gap_;
  Vector3 n_;
  double ceiling_;  // m; upper bound of every value
};

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
  Proximity compare(const std::string& how, const HardCase& other, double unit = 1) {
    Violations found;
    const Proximity second = solve(other, settings_, found);
    compare_gaps(other, second, unit, found);
    report(how, found);
    return second;
  }

  Proximity compare_started(const Vector3& start) {
    HardCase other = one_;
    other.first_normal = start;
    return compare("started at " + exact_text(start), other);
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
  Proximity compare_early_stop() {
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
    return second;
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

Proximity solve(const HardCase& one, const Settings& settings, Violations& violations) {
  std::feclearexcept(kExceptions);
  const Vector3* start = one.first_normal ? &*one.first_normal : nullptr;
  const Proximity answer = find_proximity(*one.shape1, one.pose1, *one.shape2, one.pose2, settings, start);
  if (std::fetestexcept(FE_INVALID)) violations.emplace_back("floating-point exception: invalid operation");
  if (std::fetestexcept(FE_DIVBYZERO)) violations.emplace_back("floating-point exception: division by zero");
  if (std::fetestexcept(FE_OVERFLOW)) violations.emplace_back("floating-point exception: overflow");
  return answer;
}

double rounding_of(const HardCase& one) {
  // Points are computed in body 1's frame and then moved, with a few operations on coordinates of that size. Point 2 is point 1
  // plus the gradient of s, each with the rounding of a sum of the terms of s. The value that it is compared with has that rounding
  // once more.
  const double coordinates = one.pose1.position.norm() + one.pose2.position.norm();
  return 4 * gap_of(one).rounding() + 4 * kEpsilon * coordinates;
}

double error_of(const HardCase& one, const Settings& settings, const Proximity& answer) {
  return std::max(answer.error, settings.tolerance * gap_of(one).length_unit());
}

double ceiling_of(const HardCase& one, const Settings& settings, const Proximity& answer) {
  return answer.gap + (answer.is_global ? error_of(one, settings, answer) : answer.global_error);
}

Violations check_answer(const HardCase& one, const Settings& settings, const Proximity& answer) {
  Violations out;
  if (answer.status == Status::InvalidInput || !is_finite(answer)) return {"no answer, or one that is not finite"};
  GapFunction gap = gap_of(one);
  check_status(gap, settings, answer, out);
  const double length = answer.normal.norm();
  if (!(std::abs(length - 1) <= 4 * kEpsilon)) out.push_back("normal of length " + exact_text(length));
  const double rounding = rounding_of(one);
  GapJet jet;
  gap.evaluate((one.pose1.rotation.transpose() * answer.normal).normalized(), Order::Value, jet);
  if (!(std::abs(jet.s - answer.gap) <= rounding))
    out.push_back("gap " + exact_text(answer.gap) + ", but its normal has " + exact_text(jet.s));
  OnSurface(*one.shape1, one.pose1, rounding).check("point 1", answer.point1, answer.normal, out);
  OnSurface(*one.shape2, one.pose2, rounding).check("point 2", answer.point2, -answer.normal, out);
  const double height1 = answer.normal.dot(answer.point1 - one.pose1.position);
  const double height2 = answer.normal.dot(answer.point2 - one.pose1.position);
  const double contact = answer.normal.dot(answer.contact - one.pose1.position);
  if (!(std::abs(height2 - height1 - answer.gap) <= rounding)) {
    out.push_back("gap " + exact_text(answer.gap) + ", but the points are " + exact_text(height2 - height1) +
                  " m apart along the normal");
  }
  // In an overlap it is in both bodies up to the tolerance of the query, and so between the tangent planes.
  const double near = answer.gap < 0 ? std::max(1e-6, settings.tolerance) * gap.length_unit() : 0;
  if (!(contact >= std::min(height1, height2) - near - rounding && contact <= std::max(height1, height2) + near + rounding)) {
    out.push_back("the contact point is not between the witness points along the normal");
  }
  // The distance of the contact point from the witness points is at most their distance plus the length of the smaller body.
  const double reach = (answer.point2 - answer.point1).norm() +
                       2 * std::min(one.shape1->half_extents().norm(), one.shape2->half_extents().norm()) + rounding;
  const double off = std::max((answer.contact - answer.point1).norm(), (answer.contact - answer.point2).norm());
  if (!(off <= reach)) out.push_back("the contact point is " + exact_text(off) + " m from the witness points");
  return out;
}

Violations check(const HardCase& one, const Settings& settings) {
  Violations out;
  const Proximity answer = solve(one, settings, out);
  for (const auto& some :
       {check_answer(one, settings, answer), check_maximum(one, settings, answer), check_invariance(one, settings, answer)}) {
    out.insert(out.end(), some.begin(), some.end());
  }
  return out;
}

Violations check_maximum(const HardCase& one, const Settings& settings, const Proximity& answer, std::uint64_t seed) {
  Violations out;
  if (answer.status == Status::Apart) return out;  // stopped early: a bound, not a maximum
  Probe probe(one, settings, answer);
  probe.look_at_neighbourhood(out);
  probe.look_at_features(one, out);
  test::Draw draw(seed);
  for (int k = 0; k < kRandomDirections; ++k) probe.look_at(Vector3{draw.gauss(), draw.gauss(), draw.gauss()}, out);
  return out;
}

Violations check_forms(const HardCase& one, const Settings& settings, const Proximity& answer, const Vector3& start,
                       std::vector<Proximity>& answers) {
  Violations violations;
  SecondOpinions opinions(one, settings, answer, violations);
  answers = {opinions.compare("bodies swapped", swapped(one)), opinions.compare_started(start), opinions.compare_early_stop()};
  return violations;
}

Violations check_invariance(const HardCase& one, const Settings& settings, const Proximity& answer) {
  const Vector3 n = one.pose1.rotation.transpose() * answer.normal;
  std::vector<Proximity> answers;
  Violations violations = check_forms(one, settings, answer, n, answers);
  SecondOpinions opinions(one, settings, answer, violations);
  opinions.ask_again();
  opinions.compare("in another frame", moved(one, kMotion));
  for (const double unit : {0x1p-10, 0x1p10}) opinions.compare_in_units(unit);
  for (const double unit : {1e-3, 3.}) {
    if (const auto other = rescaled(one, unit)) opinions.compare("in units of " + text(unit) + " m", *other, unit);
  }
  for (const Vector3& start : {Vector3(-n), n.unitOrthogonal()}) opinions.compare_started(start);
  return violations;
}

Reference enclose_gap(const HardCase& one, int max_evaluations) {
  const GapFunction gap(*one.shape1, one.pose1, *one.shape2, one.pose2);
  const double width = std::max(1e-12 * gap.length_unit(), gap.rounding());
  const test::GapBounds bounds = test::bound_gap(*one.shape1, one.pose1, *one.shape2, one.pose2, width, max_evaluations);
  return {bounds.lower, bounds.upper};
}

Reference find_reference(const HardCase& one) { return one.gap ? Reference{*one.gap, *one.gap} : enclose_gap(one); }

}  // namespace supernormal::samples
