#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "method.hpp"
#include "newton_step.hpp"
#include "supernormal/proximity/gap_function.hpp"

namespace literature {
namespace {

using supernormal::GapFunction;
using supernormal::GapJet;
using supernormal::Order;
using supernormal::Pose;

constexpr int kMostIterations = 100;  // Ruan et al.

/// The gap function of the bodies. Its vector d points from the boundary of the Minkowski difference to the centre of body 2. So
/// both methods use the support functions of the library.
GapFunction gap_function(const Bodies& bodies) {
  Pose pose2;
  pose2.rotation = bodies.rotation;
  pose2.position = bodies.offset;
  return {*bodies.shape1, Pose(), *bodies.shape2, pose2};
}

CommonNormal answer(const GapFunction& gap, const GapJet& jet, bool has_converged) {
  return {has_converged && jet.is_finite() ? Outcome::Found : Outcome::Failed,
          jet.s,
          jet.n,
          jet.jet1.r,
          jet.jet1.r + jet.d,
          gap.evaluations()};
}

/// A unit normal and its derivative by two angles.
using NormalOfAngles = Normalized<2> (*)(const Bodies& bodies, const Vector2& angles);

Normalized<2> by_gradient(const Bodies& bodies, const Vector2& angles) {
  const SurfacePoint surface = bodies.body1.surface(angles);
  return {surface.normal, surface.normal_rate};
}

Normalized<2> by_polar_angles(const Bodies& /*bodies*/, const Vector2& angles) {
  const double cos1 = std::cos(angles[0]), sin1 = std::sin(angles[0]), cos2 = std::cos(angles[1]), sin2 = std::sin(angles[1]);
  Matrix32 rate;
  rate << -sin1 * cos2, -cos1 * sin2, -sin1 * sin2, cos1 * cos2, cos1, 0;
  return {{cos1 * cos2, cos1 * sin2, sin1}, rate};
}

Vector2 polar_angles(const Vector3& v) { return {std::atan2(v.z(), std::hypot(v.x(), v.y())), std::atan2(v.y(), v.x())}; }

/// A sum of squares as a function of the angles: half its gradient and half its Hessian, to the order of the method.
struct Squares {
  double sum;  ///< m^2
  Vector2 gradient;
  Eigen::Matrix2d hessian;
  Matrix32 rate;  ///< of the squared vector; damping multiplies the squared lengths of its columns

  Vector2 scale() const { return rate.colwise().squaredNorm().transpose(); }
};

using SquaresOf = Squares (*)(const GapFunction& gap, const GapJet& jet, const Normalized<2>& normal);

Squares squares_of(const Vector3& residual, const Matrix32& rate) {
  return {residual.squaredNorm(), rate.transpose() * residual, rate.transpose() * rate, rate};
}

/// The squared distance in the Gauss-Newton approximation.
Squares distance(const GapFunction& gap, const GapJet& jet, const Normalized<2>& normal) {
  return squares_of(jet.d, -gap.curvature(jet) * normal.rate);
}

/// The squared distance with the Newton approximation near the solution: includes the second derivative of d along n, from n.dd =
/// 0.
Squares distance_by_newton(const GapFunction& gap, const GapJet& jet, const Normalized<2>& normal) {
  const Matrix32 d_rate = -gap.curvature(jet) * normal.rate;
  Squares squares = squares_of(jet.d, d_rate);
  squares.hessian -= jet.s * normal.rate.transpose() * d_rate;
  return squares;
}

/// The squared cross product of normal and distance vector.
Squares parallel(const GapFunction& gap, const GapJet& jet, const Normalized<2>& normal) {
  const Matrix32 d_rate = -gap.curvature(jet) * normal.rate;
  Matrix32 rate;
  for (int k = 0; k < 2; ++k) {
    rate.col(k) = Vector3(normal.rate.col(k)).cross(jet.d) + jet.n.cross(Vector3(d_rate.col(k)));
  }
  return squares_of(jet.n.cross(jet.d), rate);
}

/// The damping of Levenberg and Marquardt, adapted by the ratio of the true and the predicted decrease (Nielsen 1999).
class Damping {
 public:
  double value() const { return value_; }
  void refuse() {
    value_ *= growth_;
    growth_ *= 2;
  }
  void accept(double ratio) {
    const double cubed = std::pow(2 * ratio - 1, 3);
    value_ *= std::max(1.0 / 3, 1 - cubed);
    growth_ = 2;
  }

 private:
  double value_ = 1e-3, growth_ = 2;
};

/// The necessary condition of Ruan et al.: normal and distance vector are parallel. Tests that the gap is right to about 1e-6 of
/// the size. The angles of the gradient have additional stationary points, in the planes in which a body is flat.
bool is_necessary_met(const GapJet& jet, double size) {
  constexpr double kAccuracy = 1e-6;
  return jet.n.cross(jet.d).squaredNorm() <= 2 * kAccuracy * size * size;
}

CommonNormal least_squares(const Bodies& bodies, const Options& options, Vector2 angles, NormalOfAngles normal_of,
                           SquaresOf squares_of_jet) {
  GapFunction gap = gap_function(bodies);
  GapJet jet, next_jet;
  const auto squares_at = [&](const Vector2& at, GapJet& there) {
    const Normalized<2> normal = normal_of(bodies, at);
    gap.evaluate(normal.vector, Order::Hessian, there);
    if (options.path != nullptr) options.path->push_back(there.n);
    return squares_of_jet(gap, there, normal);
  };
  Squares squares = squares_at(angles, jet);
  Damping damping;
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const Eigen::Matrix2d matrix = squares.hessian + Eigen::Matrix2d(damping.value() * squares.scale().asDiagonal());
    const Eigen::LLT<Eigen::Matrix2d> factor(matrix);
    if (factor.info() != Eigen::Success) {
      if (!matrix.allFinite()) break;
      damping.refuse();
      continue;
    }
    const Vector2 step = factor.solve(squares.gradient);
    // On a flat face a small step of the angles moves the points far.
    if (step.norm() <= options.tolerance && (squares.rate * step).norm() <= options.tolerance * bodies.size()) {
      return answer(gap, jet, is_necessary_met(jet, bodies.size()));
    }
    const Squares next = squares_at(angles - step, next_jet);
    const double predicted = step.dot(2 * squares.gradient - squares.hessian * step);
    const double decrease = squares.sum - next.sum;
    if (!(decrease > 0 && predicted > 0)) {
      damping.refuse();
      continue;
    }
    damping.accept(decrease / predicted);
    angles -= step;
    jet = next_jet;
    squares = next;
  }
  return answer(gap, jet, false);
}

Vector2 gradient_start(const Bodies& bodies, const Options& options) {
  return options.first_normal != nullptr ? bodies.body1.angles_of(*options.first_normal) : polar_angles(bodies.offset);
}

}  // namespace

CommonNormal contact_space_fixed_point(const Bodies& bodies, const Options& options) {
  GapFunction gap = gap_function(bodies);
  Vector3 n = by_gradient(bodies, gradient_start(bodies, options)).vector;
  GapJet before, jet;
  gap.evaluate(n, Order::Point, before);
  if (options.path != nullptr) options.path->push_back(n);
  n = (n + before.d.normalized()).normalized();
  if (n.isZero(0)) return answer(gap, before, false);  // the distance vector is opposite to the normal
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    gap.evaluate(n, Order::Point, jet);
    if (options.path != nullptr) options.path->push_back(n);
    // The boundary point is the offset minus d. Its centre of curvature is this point minus the radius times n.
    const double squared_sine = jet.n.cross(before.n).squaredNorm();
    const Vector3 across = jet.n - jet.n.dot(before.n) * before.n;
    if (squared_sine == 0) break;  // the same normal again: no centre of curvature
    const double radius = across.dot(before.d - jet.d) / squared_sine;
    const Vector3 next = (jet.d + radius * jet.n).normalized();
    if (!next.allFinite() || next.isZero(0)) break;
    if ((next - jet.n).norm() <= options.tolerance) return answer(gap, jet, true);
    before = jet;
    n = next;
  }
  return answer(gap, jet, false);
}

CommonNormal contact_space_distance(const Bodies& bodies, const Options& options) {
  return least_squares(bodies, options, gradient_start(bodies, options), by_gradient, distance);
}

CommonNormal contact_space_common_normal(const Bodies& bodies, const Options& options) {
  return least_squares(bodies, options, gradient_start(bodies, options), by_gradient, parallel);
}

CommonNormal normal_angles(const Bodies& bodies, const Options& options) {
  const Vector2 start = polar_angles(options.first_normal != nullptr ? *options.first_normal : bodies.offset);
  return least_squares(bodies, options, start, by_polar_angles, distance_by_newton);
}

}  // namespace literature
