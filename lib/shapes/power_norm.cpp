#include "shapes/power_norm.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "supernormal/shapes/shape.hpp"

namespace supernormal {
namespace {

// Below this ratio k^p may be denormal, and k^p / k would lose digits. Then a power of its own computes k^(p-1).
constexpr double kSmallRatio = 1e-140;

// For p < 2 the second derivative is unbounded as k -> 0 (a flat face). Below this ratio it stays constant. That value exceeds any
// relevant radius of curvature, and a product of two such numbers is still in range.
constexpr double kFlatRatio = 1e-60;

// The least ratio of plain numbers. The ratio of any two of the three numbers is then well above kFlatRatio.
constexpr double kPlainRatio = 1e-50;

}  // namespace

PowerNorm::PowerNorm(double p, double p_minus_1, double inverse_p)
    : p_(p), p_minus_1_(p_minus_1), inverse_p_(inverse_p), is_euclidean_(p == 2) {}

PowerNorm PowerNorm::of_exponent(double exponent) { return {exponent, exponent - 1, 1 / exponent}; }

PowerNorm PowerNorm::dual_to_exponent(double exponent) {
  return {exponent / (exponent - 1), 1 / (exponent - 1), (exponent - 1) / exponent};
}

template <std::size_t kCount>
void PowerNorm::evaluate_requests(std::array<PowerNormRequest, kCount>& requests, Order order) {
  std::array<Ratio, kCount> f;
  for (std::size_t i = 0; i < kCount; ++i) {
    const auto& [norm, x, y, jet] = requests[i];
    f[i].x_is_larger = x > y;
    f[i].larger = x > y ? x : y;
    f[i].k = f[i].larger > 0 ? (x > y ? y : x) / f[i].larger : 1;
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    const PowerNorm& norm = *requests[i].norm;
    f[i].power = norm.is_euclidean_ ? f[i].k * f[i].k : std::pow(f[i].k, norm.p_);
    f[i].sum = 1 + f[i].power;
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    f[i].root = requests[i].norm->is_euclidean_ ? std::sqrt(f[i].sum) : std::log(f[i].sum);
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    const PowerNorm& norm = *requests[i].norm;
    if (!norm.is_euclidean_) f[i].root = std::exp(norm.inverse_p_ * f[i].root);
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    PowerNormRequest& request = requests[i];
    request.jet.value = f[i].larger * f[i].root;
    if (order == Order::Point) request.norm->differentiate(f[i], request.jet);
    if (order == Order::Hessian) request.norm->differentiate_twice(f[i], request.jet);
  }
}

template void PowerNorm::evaluate_requests(std::array<PowerNormRequest, 1>& requests, Order order);
template void PowerNorm::evaluate_requests(std::array<PowerNormRequest, 2>& requests, Order order);
template void PowerNorm::evaluate_requests(std::array<PowerNormRequest, 4>& requests, Order order);

bool PowerNorm::is_plain(double x, double y, double z) { return std::min({x, y, z}) > kPlainRatio * std::max({x, y, z}); }

template <std::size_t kCount>
void PowerNorm::evaluate_requests(std::array<PowerNorm3Request, kCount>& requests, Order order) {
  std::array<std::array<double, 3>, kCount> k, powers;
  std::array<double, kCount> largest, sum, root;
  for (std::size_t i = 0; i < kCount; ++i) {
    const auto& [norm, x, value, slope, bend] = requests[i];
    largest[i] = std::max({x[0], x[1], x[2]});
    for (std::size_t a = 0; a < 3; ++a) {
      k[i][a] = x[a] < largest[i] ? x[a] / largest[i] : 1;
      powers[i][a] = k[i][a] == 1 || norm->is_euclidean_ ? k[i][a] * k[i][a] : std::pow(k[i][a], norm->p_);
    }
    sum[i] = powers[i][0] + powers[i][1] + powers[i][2];
  }
  for (std::size_t i = 0; i < kCount; ++i) root[i] = requests[i].norm->is_euclidean_ ? std::sqrt(sum[i]) : std::log(sum[i]);
  for (std::size_t i = 0; i < kCount; ++i) {
    const PowerNorm& norm = *requests[i].norm;
    if (!norm.is_euclidean_) root[i] = std::exp(norm.inverse_p_ * root[i]);
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    auto& [norm, x, value, slope, bend] = requests[i];
    value = largest[i] * root[i];
    if (order == Order::Value) continue;
    const double steepest = root[i] / sum[i];
    for (std::size_t a = 0; a < 3; ++a) {
      const double power_1 = powers[i][a] / k[i][a];
      slope[a] = steepest * power_1;
      if (order == Order::Point) continue;
      // The sum of the other two powers is added up, because subtracting from the whole sum would cancel.
      const double others = powers[i][(a + 1) % 3] + powers[i][(a + 2) % 3];
      bend[a] = norm->p_minus_1_ * steepest * steepest * others * (power_1 / k[i][a]);
    }
  }
}

template void PowerNorm::evaluate_requests(std::array<PowerNorm3Request, 1>& requests, Order order);
template void PowerNorm::evaluate_requests(std::array<PowerNorm3Request, 2>& requests, Order order);
template void PowerNorm::evaluate_requests(std::array<PowerNorm3Request, 4>& requests, Order order);

void PowerNorm::differentiate(const Ratio& f, PowerNormJet& jet) const {
  jet.dx = f.root / f.sum;
  jet.dy = jet.dx * (f.k > kSmallRatio ? f.power / f.k : std::pow(f.k, p_minus_1_));
  if (!f.x_is_larger) std::swap(jet.dx, jet.dy);
}

void PowerNorm::differentiate_twice(const Ratio& f, PowerNormJet& jet) const {
  // The derivatives are in the order (larger, smaller). power_1 is k^(p-1), power_2 is k^(p-2).
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
  std::array<PowerNormRequest, 1> request = {{{this, x, y, {}}}};
  evaluate_requests(request, Order::Value);
  return request[0].jet.value;
}

void PowerNorm::gradient(double x, double y, PowerNormJet& jet) const {
  std::array<PowerNormRequest, 1> request = {{{this, x, y, {}}}};
  evaluate_requests(request, Order::Point);
  jet = request[0].jet;
}

double PowerNorm::slope(double k) const { return is_euclidean_ || k == 1 ? k : std::pow(k, p_minus_1_); }

void PowerNorm::curvature(double x, double y, PowerNormJet& jet) const {
  std::array<PowerNormRequest, 1> request = {{{this, x, y, {}}}};
  evaluate_requests(request, Order::Hessian);
  jet = request[0].jet;
}

}  // namespace supernormal
