#include "supernormal/shapes/power_norm.hpp"

#include <cmath>
#include <utility>

namespace supernormal {
namespace {

// Below this ratio k^p may be denormal, and k^p / k would lose digits: k^(p-1) is then computed by a power of its own.
constexpr double kSmallRatio = 1e-140;

// For p < 2 the second derivative grows without bound as k -> 0 (a flat face). It is held at its value for this ratio, which
// is beyond any curvature that matters and leaves room for products of two such numbers.
constexpr double kFlatRatio = 1e-60;

}  // namespace

PowerNorm::PowerNorm(double p, double p_minus_1, double inverse_p)
    : p_(p), p_minus_1_(p_minus_1), inverse_p_(inverse_p), is_euclidean_(p == 2) {}

PowerNorm PowerNorm::of_exponent(double exponent) { return {exponent, exponent - 1, 1 / exponent}; }

PowerNorm PowerNorm::dual_to_exponent(double exponent) {
  return {exponent / (exponent - 1), 1 / (exponent - 1), (exponent - 1) / exponent};
}

PowerNorm::Ratio PowerNorm::ratio(double larger, double smaller) const {
  const double k = larger > 0 ? smaller / larger : 1;
  if (is_euclidean_) {
    const double square = k * k;
    return {k, square, 1 + square, std::sqrt(1 + square)};
  }
  const double power = std::pow(k, p_);
  return {k, power, 1 + power, std::exp(inverse_p_ * std::log(1 + power))};
}

double PowerNorm::value(double x, double y) const {
  const double larger = x > y ? x : y;
  return larger * ratio(larger, x > y ? y : x).root;
}

void PowerNorm::gradient(double x, double y, PowerNormJet& jet) const {
  const bool x_is_larger = x > y;
  const double larger = x_is_larger ? x : y;
  const Ratio f = ratio(larger, x_is_larger ? y : x);
  jet.value = larger * f.root;
  jet.dx = f.root / f.sum;
  jet.dy = jet.dx * (f.k > kSmallRatio ? f.power / f.k : std::pow(f.k, p_minus_1_));
  if (!x_is_larger) std::swap(jet.dx, jet.dy);
}

void PowerNorm::curvature(double x, double y, PowerNormJet& jet) const {
  const bool x_is_larger = x > y;
  const double larger = x_is_larger ? x : y;
  const Ratio f = ratio(larger, x_is_larger ? y : x);
  jet.value = larger * f.root;
  // In the order (larger, smaller) first: k^(p-1) and k^(p-2).
  const double d_larger = f.root / f.sum;
  const double power_1 = f.k > kSmallRatio ? f.power / f.k : std::pow(f.k, p_minus_1_);
  const double power_2 = f.k > kFlatRatio ? power_1 / f.k : std::pow(kFlatRatio, p_minus_1_ - 1);
  jet.dx = d_larger;
  jet.dy = d_larger * power_1;
  jet.dx_over_x = d_larger * f.root * (x_is_larger ? 1 : power_2);
  const double scale = p_minus_1_ * d_larger * d_larger;
  jet.xx = scale * power_1 * f.k;
  jet.xy = -scale * power_1;
  jet.yy = scale * power_2;
  if (!x_is_larger) {
    std::swap(jet.dx, jet.dy);
    std::swap(jet.xx, jet.yy);
  }
}

}  // namespace supernormal
