#include "proximity/local/bfgs_hessian.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace supernormal {
void BfgsHessian::restart(const GapJet& jet) {
  const double size = std::abs(jet.jet1.h + jet.jet2.h);
  H_ = Matrix3::Identity() * size;
  rounding_ = std::numeric_limits<double>::epsilon() * size;
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
  H_ += change * (change / slope).transpose() - predicted * (predicted / predicted_slope).transpose();
}

}  // namespace supernormal
