#include "kernel/contact_material.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "supernormal/contact/hertz.hpp"

namespace granular {

namespace {

constexpr double kLargest = std::numeric_limits<double>::max();

/// This form of the test refuses NaN.
void require(const char* name, double value, double least, double most, const char* range) {
  if (!(value >= least && value <= most)) refuse(name, value, range);
}

/// Solves f(x) = value for an increasing f.
double solve(const auto& f, double value, double low, double high) {
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (f(middle) < value ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

ContactMaterial prepared(ContactMaterial material) {
  const bool is_hertz = material.law == NormalLaw::Hertz;
  require(is_hertz ? "modulus" : "stiffness", material.stiffness, std::numeric_limits<double>::min(), kLargest, "(0, inf)");
  require("restitution", material.restitution, 0.05, 1, "[0.05, 1]");
  require("friction", material.friction, 0, kLargest, "[0, inf)");
  require("tangential", material.tangential_ratio, std::numeric_limits<double>::min(), 1, "(0, 1]");
  require("rolling", material.rolling_length, 0, kLargest, "[0, inf)");
  require("spinning", material.spinning_length, 0, kLargest, "[0, inf)");
  require("adhesion", material.adhesion, 0, kLargest, "[0, inf)");
  material.damping_ratio =
      is_hertz ? supernormal::hertz_damping_ratio(material.restitution) : hooke_damping_ratio(material.restitution);
  return material;
}

ContactMaterial mixed(const ContactMaterial& a, const ContactMaterial& b) {
  if (a.law != b.law) throw std::invalid_argument("hooke and hertz do not mix");
  // Each spring is half of the contact of a material with itself.
  const auto in_series = [](double one, double other) { return 2 / (1 / one + 1 / other); };
  const auto geometric = [](double one, double other) { return std::sqrt(one) * std::sqrt(other); };
  ContactMaterial found;
  found.law = a.law;
  found.stiffness = in_series(a.stiffness, b.stiffness);
  found.tangential_ratio = in_series(a.tangential_ratio * a.stiffness, b.tangential_ratio * b.stiffness) / found.stiffness;
  found.restitution = geometric(a.restitution, b.restitution);
  found.friction = geometric(a.friction, b.friction);
  found.rolling_length = geometric(a.rolling_length, b.rolling_length);
  found.spinning_length = geometric(a.spinning_length, b.spinning_length);
  found.adhesion = geometric(a.adhesion, b.adhesion);
  return prepared(found);
}

double effective_modulus(double youngs_modulus, double poisson_ratio) {
  require("youngs_modulus", youngs_modulus, std::numeric_limits<double>::min(), kLargest, "(0, inf)");
  require("poisson_ratio", poisson_ratio, 0, 0.5, "[0, 0.5]");
  return youngs_modulus / (2 * (1 - poisson_ratio * poisson_ratio));
}

double mindlin_ratio(double poisson_ratio) { return 2 * (1 - poisson_ratio) / (2 - poisson_ratio); }

double hooke_damping_ratio(double restitution) {
  // With b = cos a, the force vanishes at time 2 a / sin a in units of 1/omega. The restitution is exp(-2 a cot a). Beyond critical
  // damping, b = cosh a, the functions become hyperbolic.
  const double logarithm = -0.5 * std::log(restitution);
  if (logarithm <= 0) return 0;
  if (logarithm < 1) return std::cos(solve([](double a) { return -a / std::tan(a); }, -logarithm, 0, std::numbers::pi / 2));
  return std::cosh(solve([](double a) { return a / std::tanh(a); }, logarithm, 0, logarithm));
}

void refuse(const std::string& name, double value, const std::string& range) {
  std::ostringstream message;
  message << name << " = " << value << " is outside " << range;
  throw std::invalid_argument(message.str());
}

}  // namespace granular
