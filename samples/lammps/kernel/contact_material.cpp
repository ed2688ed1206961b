#include "kernel/contact_material.hpp"

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "kernel/damping_ratio.hpp"
#include "supernormal/contact/hertz.hpp"

namespace granular {
namespace {

constexpr double kLargest = std::numeric_limits<double>::max();

[[noreturn]] void refuse(const char* name, double value, const char* range) {
  std::ostringstream message;
  message << name << " = " << value << " is outside " << range;
  throw std::invalid_argument(message.str());
}

/// This form of the test refuses NaN.
void require(const char* name, double value, double least, double most, const char* range) {
  if (!(value >= least && value <= most)) refuse(name, value, range);
}

}  // namespace

ContactMaterial prepared(ContactMaterial material) {
  const bool is_hertz = material.law == NormalLaw::Hertz;
  require(is_hertz ? "modulus" : "stiffness", material.stiffness, std::numeric_limits<double>::min(), kLargest, "(0, inf)");
  require("restitution", material.restitution, 0.05, 1, "[0.05, 1]");
  require("friction", material.friction, 0, kLargest, "[0, inf)");
  require("tangential", material.tangential_ratio, std::numeric_limits<double>::min(), 1, "(0, 1]");
  require("rolling", material.rolling_length, 0, kLargest, "[0, inf)");
  material.damping_ratio =
      is_hertz ? supernormal::hertz_damping_ratio(material.restitution) : hooke_damping_ratio(material.restitution);
  return material;
}

double effective_modulus(double youngs_modulus, double poisson_ratio) {
  require("youngs_modulus", youngs_modulus, std::numeric_limits<double>::min(), kLargest, "(0, inf)");
  require("poisson_ratio", poisson_ratio, 0, 0.5, "[0, 0.5]");
  return youngs_modulus / (2 * (1 - poisson_ratio * poisson_ratio));
}

double mindlin_ratio(double poisson_ratio) { return 2 * (1 - poisson_ratio) / (2 - poisson_ratio); }

}  // namespace granular
