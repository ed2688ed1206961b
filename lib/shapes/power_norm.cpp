#include "shapes/power_norm.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shapes/lanes/superellipsoid_jet.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {
namespace {

// For p < 2 the second derivative is unbounded as k -> 0 (a flat face). Below this ratio it stays constant. That value exceeds any
// relevant radius of curvature, and a product of two such numbers is still in range.
constexpr double kFlatRatio = kLanesFlatRatio;

// The least ratio of plain numbers. The ratio of any two of the three numbers is then well above kFlatRatio.
constexpr double kPlainRatio = 1e-50;

/// k^e of a ratio in [0, 1], for e > 0.
double power_of(double k, double e) { return k > 0 ? power(Real<1>(std::max(k, kLanesLeastRatio)), Real<1>(e)).v : 0; }

/// sum^inverse_p of a number in [1, 4).
double root_of(double sum, double inverse_p) { return root(Real<1>(sum), Real<1>(inverse_p)).v; }

}  // namespace

PowerNorm::PowerNorm(double p, double p_minus_1, double inverse_p)
    : p_minus_1_(p_minus_1), inverse_p_(inverse_p), is_euclidean_(p == 2) {}

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
  // Each step of all norms before the next step of one: the steps of a norm wait for each other.
  for (std::size_t i = 0; i < kCount; ++i) {
    const PowerNorm& norm = *requests[i].norm;
    f[i].power_1 = norm.is_euclidean_ ? f[i].k : power_of(f[i].k, norm.p_minus_1_);
    f[i].sum = 1 + f[i].power_1 * f[i].k;
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    const PowerNorm& norm = *requests[i].norm;
    f[i].root = norm.is_euclidean_ ? std::sqrt(f[i].sum) : root_of(f[i].sum, norm.inverse_p_);
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
  std::array<std::array<double, 3>, kCount> k, powers_1, powers;
  std::array<double, kCount> largest, sum, root;
  for (std::size_t i = 0; i < kCount; ++i) {
    const auto& [norm, x, value, slope, bend] = requests[i];
    largest[i] = std::max({x[0], x[1], x[2]});
    for (std::size_t a = 0; a < 3; ++a) {
      k[i][a] = x[a] < largest[i] ? x[a] / largest[i] : 1;
      powers_1[i][a] = k[i][a] == 1 || norm->is_euclidean_ ? k[i][a] : power_of(k[i][a], norm->p_minus_1_);
      powers[i][a] = powers_1[i][a] * k[i][a];
    }
    sum[i] = powers[i][0] + powers[i][1] + powers[i][2];
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    const PowerNorm& norm = *requests[i].norm;
    root[i] = norm.is_euclidean_ ? std::sqrt(sum[i]) : root_of(sum[i], norm.inverse_p_);
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    auto& [norm, x, value, slope, bend] = requests[i];
    value = largest[i] * root[i];
    if (order == Order::Value) continue;
    const double steepest = root[i] / sum[i];
    for (std::size_t a = 0; a < 3; ++a) {
      slope[a] = steepest * powers_1[i][a];
      if (order == Order::Point) continue;
      // The sum of the other two powers is added up, because subtracting from the whole sum would cancel.
      const double others = powers[i][(a + 1) % 3] + powers[i][(a + 2) % 3];
      bend[a] = norm->p_minus_1_ * steepest * steepest * others * (powers_1[i][a] / k[i][a]);
    }
  }
}

template void PowerNorm::evaluate_requests(std::array<PowerNorm3Request, 1>& requests, Order order);
template void PowerNorm::evaluate_requests(std::array<PowerNorm3Request, 2>& requests, Order order);
template void PowerNorm::evaluate_requests(std::array<PowerNorm3Request, 4>& requests, Order order);

void PowerNorm::differentiate(const Ratio& f, PowerNormJet& jet) const {
  jet.dx = f.root / f.sum;
  jet.dy = jet.dx * f.power_1;
  if (!f.x_is_larger) std::swap(jet.dx, jet.dy);
}

void PowerNorm::differentiate_twice(const Ratio& f, PowerNormJet& jet) const {
  // The derivatives are in the order (larger, smaller). power_2 is k^(p-2).
  const double d_larger = f.root / f.sum;
  const double power_2 = f.k > kFlatRatio ? f.power_1 / f.k : power(Real<1>(kFlatRatio), Real<1>(p_minus_1_ - 1)).v;
  jet.dx = d_larger;
  jet.dy = d_larger * f.power_1;
  jet.dx_over_x = d_larger * f.root * (f.x_is_larger ? 1 : power_2);
  const double scale = p_minus_1_ * d_larger * d_larger;
  jet.xx = scale * f.power_1 * f.k;
  jet.xy = -scale * f.power_1;
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

double PowerNorm::slope(double k) const { return is_euclidean_ || k == 1 ? k : power_of(k, p_minus_1_); }

void PowerNorm::curvature(double x, double y, PowerNormJet& jet) const {
  std::array<PowerNormRequest, 1> request = {{{this, x, y, {}}}};
  evaluate_requests(request, Order::Hessian);
  jet = request[0].jet;
}

}  // namespace supernormal
