#include "supernormal/shapes/power_norm.hpp"

#include <cmath>
#include <utility>

#include "supernormal/shapes/shape.hpp"

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

template <std::size_t kCount>
void PowerNorm::answer(std::array<PowerNormQuestion, kCount>& questions, Order order) {
  std::array<Ratio, kCount> f;
  for (std::size_t i = 0; i < kCount; ++i) {
    const auto& [norm, x, y, jet] = questions[i];
    f[i].x_is_larger = x > y;
    f[i].larger = x > y ? x : y;
    f[i].k = f[i].larger > 0 ? (x > y ? y : x) / f[i].larger : 1;
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    const PowerNorm& norm = *questions[i].norm;
    f[i].power = norm.is_euclidean_ ? f[i].k * f[i].k : std::pow(f[i].k, norm.p_);
    f[i].sum = 1 + f[i].power;
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    f[i].root = questions[i].norm->is_euclidean_ ? std::sqrt(f[i].sum) : std::log(f[i].sum);
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    const PowerNorm& norm = *questions[i].norm;
    if (!norm.is_euclidean_) f[i].root = std::exp(norm.inverse_p_ * f[i].root);
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    PowerNormQuestion& question = questions[i];
    question.jet.value = f[i].larger * f[i].root;
    if (order == Order::Point) question.norm->differentiate(f[i], question.jet);
    if (order == Order::Curvature) question.norm->differentiate_twice(f[i], question.jet);
  }
}

template void PowerNorm::answer(std::array<PowerNormQuestion, 1>& questions, Order order);
template void PowerNorm::answer(std::array<PowerNormQuestion, 2>& questions, Order order);

void PowerNorm::differentiate(const Ratio& f, PowerNormJet& jet) const {
  jet.dx = f.root / f.sum;
  jet.dy = jet.dx * (f.k > kSmallRatio ? f.power / f.k : std::pow(f.k, p_minus_1_));
  if (!f.x_is_larger) std::swap(jet.dx, jet.dy);
}

void PowerNorm::differentiate_twice(const Ratio& f, PowerNormJet& jet) const {
  // In the order (larger, smaller) first: k^(p-1) and k^(p-2).
  const double d_larger = f.root / f.sum;
  const double power_1 = f.k > kSmallRatio ? f.power / f.k : std::pow(f.k, p_minus_1_);
  const double power_2 = f.k > kFlatRatio ? power_1 / f.k : std::pow(kFlatRatio, p_minus_1_ - 1);
  jet.dx = d_larger;
  jet.dy = d_larger * power_1;
  jet.dx_over_x = d_larger * f.root * (f.x_is_larger ? 1 : power_2);
  const double scale = p_minus_1_ * d_larger * d_larger;
  jet.xx = scale * power_1 * f.k;
  jet.xy = -scale * power_1;
  jet.yy = scale * power_2;
  if (!f.x_is_larger) {
    std::swap(jet.dx, jet.dy);
    std::swap(jet.xx, jet.yy);
  }
}

double PowerNorm::value(double x, double y) const {
  std::array<PowerNormQuestion, 1> question = {{{this, x, y, {}}}};
  answer(question, Order::Value);
  return question[0].jet.value;
}

void PowerNorm::gradient(double x, double y, PowerNormJet& jet) const {
  std::array<PowerNormQuestion, 1> question = {{{this, x, y, {}}}};
  answer(question, Order::Point);
  jet = question[0].jet;
}

void PowerNorm::curvature(double x, double y, PowerNormJet& jet) const {
  std::array<PowerNormQuestion, 1> question = {{{this, x, y, {}}}};
  answer(question, Order::Curvature);
  jet = question[0].jet;
}

}  // namespace supernormal
