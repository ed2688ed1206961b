#include "proximity/local/trust_region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace supernormal {
namespace {

// Relative to the radius: a step to the circle may miss it by this, because it is only a trial.
constexpr double kCircleTolerance = 1e-2;

// Relative to the negative eigenvalue: the shift cannot come nearer to its magnitude.
constexpr double kShiftRounding = 4 * std::numeric_limits<double>::epsilon();
constexpr int kMaxSecularSteps = 20;  // Newton on the secular equation takes two to four

// Determinant over squared trace. Below this, the eigenvectors are needed to distinguish a small curvature from rounding.
constexpr double kWellConditioned = 1e-6;

// m; the square of a larger trace might overflow.
constexpr double kMostTrace = 1e150;

// m; fractions of a smaller slope might underflow.
constexpr double kNoSlope = 1e-290;

double without_underflow(double slope) { return std::abs(slope) < kNoSlope ? 0 : slope; }

// rad; where s is level in a direction, its slope may continue for a quarter turn.
constexpr double kQuarterTurn = 1.6;

double find_largest_gain(const Vector2& g, const Eigen2& e, double rounding) {
  const auto along = [rounding](double slope, double curvature) {
    const bool is_level = std::abs(curvature) <= rounding && !(std::abs(slope) < curvature);
    if (is_level && rounding > 0) return kQuarterTurn * (std::abs(slope) + 0.5 * kQuarterTurn * rounding);
    return curvature > 0 ? 0.5 * slope * (slope / curvature) : std::numeric_limits<double>::infinity();
  };
  return along(e.low_vector.dot(g), e.low) + along(e.high_vector.dot(g), e.high);
}

Vector2 find_maximum(const Vector2& g, const Eigen2& e, double radius) {
  const double low = without_underflow(e.low_vector.dot(g));
  const double high = without_underflow(e.high_vector.dot(g));
  const double slope = length_of(low, high);
  if (slope == 0 && !(e.low < 0)) return Vector2::Zero();
  // Tested before the divisions, which might overflow. If s is level in a direction and has no slope in it, nothing is gained by
  // that direction.
  if (e.low >= 0 && std::abs(low) <= radius * e.low && std::abs(high) <= radius * e.high) {
    const Vector2 newton(e.low > 0 ? low / e.low : 0, high / e.high);
    if (newton.norm() <= radius) return newton.x() * e.low_vector + newton.y() * e.high_vector;
  }
  const double floor = std::max(0.0, -e.low);
  const double least_shift = kShiftRounding * floor;
  // The hard case, as on a saddle: there is hardly a slope along the negative curvature, but this direction leads up to either
  // side.
  if (e.low < 0 && std::abs(low) <= least_shift * radius) {
    const double across = slope <= least_shift * radius ? 0 : high / (e.high - e.low + least_shift);
    if (std::abs(across) < radius) {
      return std::copysign(std::sqrt(radius * radius - across * across), low) * e.low_vector + across * e.high_vector;
    }
  }
  // Solves |(A + shift I)^-1 g| = radius for a shift that makes A + shift I positive definite, by bracketed Newton on 1/|u|.
  double above = floor + slope / radius;
  double below = std::max(floor, slope / radius - e.high);
  double shift = std::max(below, floor + std::max(least_shift, 1e-12 * slope / radius));
  Vector2 u;
  for (int step = 0; step < kMaxSecularSteps; ++step) {
    const double low_sum = e.low + shift;
    const double high_sum = e.high + shift;
    u = Vector2(low / low_sum, high / high_sum);
    const double length = u.norm();
    if (std::abs(length - radius) <= kCircleTolerance * radius) break;
    (length > radius ? below : above) = shift;
    const Vector2 direction = u / length;
    // The decrease of the length with the shift, relative to the length.
    const double decrease = direction.x() * direction.x() / low_sum + direction.y() * direction.y() / high_sum;
    double next = shift + (length / radius - 1) / decrease;
    if (!(next > below && next < above)) next = 0.5 * (below + above);
    shift = next;
  }
  const double length = u.norm();
  if (length > radius) u *= radius / length;
  return u.x() * e.low_vector + u.y() * e.high_vector;
}

}  // namespace

double QuadraticModel::largest_gain(double rounding) const { return find_largest_gain(g, Eigen2(A), rounding); }

Vector2 QuadraticModel::maximize(double radius) const { return find_maximum(g, Eigen2(A), radius); }

QuadraticModel::Peak QuadraticModel::peak(double radius, double rounding) const {
  const double trace = A.trace();
  const double determinant = A.xx * A.yy - A.xy * A.xy;
  // The smaller eigenvalue is at least determinant / trace.
  if (trace > 0 && trace < kMostTrace && determinant > std::max(kWellConditioned * trace, rounding) * trace) {
    const Vector2 newton = Vector2(A.yy * g.x() - A.xy * g.y(), A.xx * g.y() - A.xy * g.x()) / determinant;
    if (newton.squaredNorm() <= radius * radius) return {newton, 0.5 * g.dot(newton)};
  }
  const Eigen2 e(A);
  return {find_maximum(g, e, radius), find_largest_gain(g, e, rounding)};
}

}  // namespace supernormal
