#include "shapes/power_norm.hpp"

#include <algorithm>
#include <cmath>

#include "shapes/lanes/superellipsoid_jet.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {
namespace {

// The least ratio of plain numbers. The ratio of any two of the three numbers is then well above kLanesFlatRatio.
constexpr double kPlainRatio = 1e-50;

// A flat body at rest is asked along its axis. There the powers are known, with the same bits.
double power_of(double k, double e) { return k == 0 ? 0 : ratio_power(Real<1>(k), Real<1>(e)).v; }

/// sum^inverse_p of a number in [1, 4).
double root_of(double sum, double inverse_p) { return sum == 1 ? 1 : root(Real<1>(sum), Real<1>(inverse_p)).v; }

}  // namespace

PowerNorm::PowerNorm(double p, double p_minus_1, double inverse_p)
    : p_minus_1_(p_minus_1), inverse_p_(inverse_p), flat_power_(flat_power(p_minus_1)), is_euclidean_(p == 2) {}

PowerNorm PowerNorm::of_exponent(double exponent) { return {exponent, exponent - 1, 1 / exponent}; }

PowerNorm PowerNorm::dual_to_exponent(double exponent) {
  return {exponent / (exponent - 1), 1 / (exponent - 1), (exponent - 1) / exponent};
}

template <std::size_t kCount>
void PowerNorm::evaluate_requests(std::array<PowerNormRequest, kCount>& requests, Order order) {
  std::array<Ratio<Real<1>>, kCount> ratio;
  std::array<Real<1>, kCount> sum, root;
  for (std::size_t i = 0; i < kCount; ++i) ratio[i] = ratio_of(Real<1>(requests[i].x), Real<1>(requests[i].y));
  // Each step of all norms before the next step of one: the steps of a norm wait for each other.
  for (std::size_t i = 0; i < kCount; ++i) {
    const PowerNorm& norm = *requests[i].norm;
    ratio[i].power_1 = norm.is_euclidean_ ? ratio[i].k : Real<1>(power_of(ratio[i].k.v, norm.p_minus_1_));
    sum[i] = ratio[i].power_1 * ratio[i].k + 1.0;
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    const PowerNorm& norm = *requests[i].norm;
    root[i] = norm.is_euclidean_ ? std::sqrt(sum[i].v) : root_of(sum[i].v, norm.inverse_p_);
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    const auto& [norm, x, y, result] = requests[i];
    PowerNormJet& jet = requests[i].jet;
    const NormJet<Real<1>> found = norm_from(ratio[i], sum[i], root[i]);
    jet.value = found.value.v;
    if (order == Order::Value) continue;
    jet.dx = found.dx.v;
    jet.dy = found.dy.v;
    if (order == Order::Point) continue;
    const NormBends<Real<1>> bends = norm_bends(found, {norm->p_minus_1_, norm->inverse_p_}, Real<1>(norm->flat_power_));
    jet.dx_over_x = bends.dx_over_x.v;
    jet.xx = bends.xx.v;
    jet.xy = bends.xy.v;
    jet.yy = bends.yy.v;
  }
}

template void PowerNorm::evaluate_requests(std::array<PowerNormRequest, 1>& requests, Order order);
template void PowerNorm::evaluate_requests(std::array<PowerNormRequest, 2>& requests, Order order);

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
