#include "styles/words.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

#include "kernel/contact_material.hpp"
#include "pointers.h"
#include "supernormal/shapes/superellipsoid.hpp"
#include "utils.h"

namespace granular {

namespace {

double exponent(double value) {
  using supernormal::Superellipsoid;
  if (!(value >= Superellipsoid::kMinExponent && value <= Superellipsoid::kMaxExponent)) refuse("exponents", value, "[1.01, 1000]");
  return value;
}

}  // namespace

Vector3 direction_of(const std::string& keyword, const Vector3& vector) {
  if (vector.isZero(0)) throw std::invalid_argument(keyword + " = 0 0 0 has no direction");
  return vector.stableNormalized();
}

std::string Words::next(const std::string& keyword) {
  if (is_empty()) throw std::invalid_argument(keyword + " takes another word");
  const std::string word = words_.front();
  words_ = words_.subspan(1);
  return word;
}

bool Words::accept(const std::string& word) {
  if (is_empty() || words_.front() != word) return false;
  words_ = words_.subspan(1);
  return true;
}

double Words::number(const std::string& keyword) {
  const std::string word = next(keyword);
  if (!LAMMPS_NS::utils::is_double(word)) throw std::invalid_argument(keyword + " takes a number instead of " + word);
  // Of LAMMPS' own functions, some give infinity for numbers that are too large, and some end the program.
  const double value = std::strtod(word.c_str(), nullptr);
  if (!std::isfinite(value)) refuse(keyword, value, "(-inf, inf)");
  return value;
}

int Words::integer(const std::string& keyword) {
  const std::string word = next(keyword);
  if (!LAMMPS_NS::utils::is_integer(word)) throw std::invalid_argument(keyword + " takes an integer instead of " + word);
  return LAMMPS_NS::utils::inumeric(FLERR, word.c_str(), false, lammps_);
}

Vector3 Words::vector(const std::string& keyword) {
  const double x = number(keyword), y = number(keyword), z = number(keyword);
  return {x, y, z};
}

Vector3 Words::direction(const std::string& keyword) { return direction_of(keyword, vector(keyword)); }

Words Words::take_until(std::initializer_list<std::string_view> separators) {
  const auto found = std::find_first_of(words_.begin(), words_.end(), separators.begin(), separators.end(),
                                        [](const char* word, std::string_view separator) { return word == separator; });
  const auto count = static_cast<std::size_t>(found - words_.begin());
  const Words taken(words_.first(count), lammps_);
  words_ = words_.subspan(count);
  return taken;
}

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
