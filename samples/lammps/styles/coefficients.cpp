#include "styles/coefficients.hpp"

#include <optional>
#include <set>
#include <stdexcept>
#include <string>

#include "kernel/refuse.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

namespace granular {
namespace {

double exponent(double value) {
  using supernormal::Superellipsoid;
  if (!(value >= Superellipsoid::kMinExponent && value <= Superellipsoid::kMaxExponent)) refuse("exponents", value, "[1.01, 1000]");
  return value;
}

}  // namespace

Coefficients read_coefficients(Words words) {
  Coefficients found;
  ContactMaterial& material = found.material;
  std::optional<double> tangential;
  bool has_parameters = false;
  std::set<std::string> given;
  while (!words.is_empty()) {
    const std::string keyword = words.next("");
    if (!given.insert(keyword).second) throw std::invalid_argument(keyword + " is given twice");
    if (given.contains("hooke") && given.contains("hertz")) throw std::invalid_argument("two laws; allowed: one of hooke, hertz");
    if (keyword == "hooke") {
      material.law = NormalLaw::Hooke;
      material.stiffness = words.number(keyword);
      found.has_material = true;
    } else if (keyword == "hertz") {
      material.law = NormalLaw::Hertz;
      const double modulus = words.number(keyword), poisson_ratio = words.number(keyword);
      material.stiffness = effective_modulus(modulus, poisson_ratio);
      material.tangential_ratio = mindlin_ratio(poisson_ratio);
      found.has_material = true;
    } else if (keyword == "exponents") {
      found.delta = exponent(words.number(keyword));
      found.epsilon = exponent(words.number(keyword));
      found.has_exponents = true;
    } else {
      double* const parameter = keyword == "restitution"  ? &material.restitution
                                : keyword == "friction"   ? &material.friction
                                : keyword == "tangential" ? &tangential.emplace()
                                : keyword == "rolling"    ? &material.rolling_length
                                : keyword == "spinning"   ? &material.spinning_length
                                : keyword == "adhesion"   ? &material.adhesion
                                                          : nullptr;
      if (parameter == nullptr) {
        throw std::invalid_argument(
            keyword + " is none of hooke, hertz, restitution, friction, tangential, rolling, spinning, adhesion, exponents");
      }
      *parameter = words.number(keyword);
      has_parameters = true;
    }
  }
  if (has_parameters && !found.has_material) throw std::invalid_argument("the law is missing: hooke or hertz");
  if (tangential) material.tangential_ratio = *tangential;
  if (found.has_material) material = prepared(material);
  return found;
}

}  // namespace granular
