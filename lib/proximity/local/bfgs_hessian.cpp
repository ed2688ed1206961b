#include "proximity/local/bfgs_hessian.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace supernormal {
namespace {

// If the cosine of the angle between the axes of two rotations is below this, the rotations are across each other.
constexpr double kAcross = 0.95;

}  // namespace

void BfgsHessian::restart(const GapJet& jet) {
  const double size = std::abs(jet.jet1.h + jet.jet2.h);
  H_ = Matrix3::Identity() * size;
  rounding_ = std::numeric_limits<double>::epsilon() * size;
  axis_.setZero();
  reach_along_ = reach_across_ = std::numeric_limits<double>::infinity();
}

void BfgsHessian::update(const GapJet& from, const GapJet& to) {
  const Vector3 dn = to.n - from.n;
  const Vector3 change = from.d - to.d;  // H dn to first order
  const Vector3 predicted = H_ * dn;
  const double slope = change.dot(dn);
  const double predicted_slope = predicted.dot(dn);
  // Rounding may make a vanishing slope negative. It may also make the update larger than the accuracy of the estimate. Skip the
  // update then.
  const double least = std::max(std::numeric_limits<double>::epsilon() * predicted_slope, rounding_ * dn.norm());
  if (!(slope > least) || !(predicted_slope > 0)) return;
  const Vector3 axis = from.n.cross(dn).normalized();
  if (std::abs(axis_.dot(axis)) < kAcross) reach_across_ = reach_along_;
  axis_ = axis;
  reach_along_ = dn.norm();
  H_ += change * (change / slope).transpose() - predicted * (predicted / predicted_slope).transpose();
}

}  // namespace supernormal
