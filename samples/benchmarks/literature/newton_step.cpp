#include "newton_step.hpp"

#include <cmath>

namespace literature {

// With v = n + sign(nx) ex, which is never short, column k is ek - v nk / (1 + |nx|).
Tangents tangents_of(const Vector3& normal) {
  const double sign = std::copysign(1.0, normal.x());
  const double scale = 1 / (1 + std::abs(normal.x()));
  const Vector3 v = normal + sign * Vector3::UnitX();
  Tangents result;
  for (int k = 0; k < 2; ++k) {
    const double nk = normal[k + 1];
    result.tangent[static_cast<std::size_t>(k)] = Vector3::Unit(k + 1) - scale * nk * v;
    Matrix3& rate = result.rate[static_cast<std::size_t>(k)];
    rate = -scale * nk * Matrix3::Identity();
    rate.col(k + 1) -= scale * v;
    rate.col(0) += sign * scale * scale * nk * v;
  }
  return result;
}

}  // namespace literature
