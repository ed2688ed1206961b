#include "kernel/damping_ratio.hpp"

#include <cmath>
#include <numbers>

namespace granular {
namespace {

/// Solves f(x) = value for an increasing f.
template <typename Function>
double solve(const Function& f, double value, double low, double high) {
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (f(middle) < value ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double hooke_damping_ratio(double restitution) {
  // With b = cos a, the force vanishes at time 2 a / sin a in units of 1/omega. The restitution is exp(-2 a cot a). Beyond critical
  // damping, b = cosh a, the functions become hyperbolic.
  const double logarithm = -0.5 * std::log(restitution);
  if (logarithm <= 0) return 0;
  if (logarithm < 1) return std::cos(solve([](double a) { return -a / std::tan(a); }, -logarithm, 0, std::numbers::pi / 2));
  return std::cosh(solve([](double a) { return a / std::tanh(a); }, logarithm, 0, logarithm));
}

}  // namespace granular
