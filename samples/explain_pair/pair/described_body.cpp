#include "pair/described_body.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "base/input_error.hpp"
#include "base/interval.hpp"
#include "base/nearest_word.hpp"
#include "support/hard_cases/body.hpp"

namespace explain_pair {
namespace {

using falling_particles::InputError;
using supernormal::samples::Body;

constexpr double kUnitLength = 1e-3;  // largest deviation of the length of a quaternion from 1
constexpr double kLargest = 1e30;     // m
constexpr double kFarthest = 1e100;   // m

struct Kind {
  const char* name;
  std::size_t parameters;
  const char* usage;
  Body (*make)(const std::vector<double>& p);
};

const std::array<Kind, 7>& kinds() {
  using namespace supernormal::samples;
  static const std::array<Kind, 7> kinds = {
      {{"sphere", 1, "RADIUS",
        [](const std::vector<double>& p) {
          return ellipsoid({p[0], p[0], p[0]});
        }},
       {"ellipsoid", 3, "A B C (half-axes, m)",
        [](const std::vector<double>& p) {
          return ellipsoid({p[0], p[1], p[2]});
        }},
       {"superellipsoid", 5, "A B C DELTA EPSILON (exponents in xy and along z, 1.01 to 1000)",
        [](const std::vector<double>& p) {
          return superellipsoid({p[0], p[1], p[2]}, p[3], p[4]);
        }},
       {"superovoid", 7, "A B C DELTA EPSILON TAPER_X TAPER_Y",
        [](const std::vector<double>& p) {
          return superovoid({p[0], p[1], p[2]}, p[3], p[4], p[5], p[6]);
        }},
       {"box", 3, "A B C (half-lengths, m)",
        [](const std::vector<double>& p) {
          return box({p[0], p[1], p[2]});
        }},
       {"capsule", 2, "RADIUS HALF_LENGTH (of the axis, along z, m)",
        [](const std::vector<double>& p) { return capsule(p[0], p[1]); }},
       {"cylinder", 2, "RADIUS HALF_LENGTH (along z, m)", [](const std::vector<double>& p) { return cylinder(p[0], p[1]); }}}};
  return kinds;
}

std::vector<std::string> names() {
  std::vector<std::string> names;
  for (const Kind& kind : kinds()) names.emplace_back(kind.name);
  return names;
}

double number_of(const std::string& option, const std::string& word) {
  std::istringstream stream(word);
  double value = 0;
  stream >> value;
  if (!stream || !stream.eof() || !std::isfinite(value))
    throw InputError(option + ": \"" + word + "\" is not a number; allowed: finite decimal numbers such as 0.02 or 2e-2");
  return value;
}

}  // namespace

std::string body_kinds() {
  std::string text;
  for (const Kind& kind : kinds()) text += std::string("  ") + kind.name + ' ' + kind.usage + '\n';
  return text;
}

PlacedBody described_body(const std::string& number, const std::string& text, double rounding) {
  const std::string option = "--body" + number;
  std::istringstream stream(text);
  const std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
  const std::string word = words.empty() ? "" : words[0];
  const auto kind = std::ranges::find_if(kinds(), [&](const Kind& one) { return one.name == word; });
  if (kind == kinds().end()) {
    throw InputError(option + ": \"" + word + "\" is no kind of body; allowed: " + falling_particles::join(names()) +
                     falling_particles::did_you_mean(word, names()));
  }
  std::vector<double> parameters;
  for (std::size_t k = 1; k < words.size(); ++k) parameters.push_back(number_of(option, words[k]));
  if (parameters.size() != kind->parameters) {
    throw InputError(option + ": \"" + word + "\" has " + std::to_string(parameters.size()) +
                     " numbers; allowed: " + std::to_string(kind->parameters) + ", " + kind->usage);
  }
  const falling_particles::Interval radii = falling_particles::Interval::closed(0, kLargest, "m");
  if (!radii.contains(rounding))
    throw InputError("--rounding" + number + " is " + falling_particles::shortest(rounding) + "; allowed: " + radii.describe());
  try {
    Body body = kind->make(parameters);
    if (rounding > 0) body = body.rounded(rounding);
    return {describe(body), make_shape(body), {}};
  } catch (const std::invalid_argument& error) {
    throw InputError(option + ": " + error.what());
  }
}

Vector3 position_of(const std::string& option, std::span<const double, 3> position) {
  const falling_particles::Interval places = falling_particles::Interval::closed(-kFarthest, kFarthest, "m");
  for (const double x : position) {
    if (!places.contains(x))
      throw InputError(option + " has a " + falling_particles::shortest(x) + "; allowed: " + places.describe());
  }
  return {position[0], position[1], position[2]};
}

Matrix3 rotation_of(const std::string& option, std::span<const double, 4> quaternion) {
  const Eigen::Quaterniond q(quaternion[0], quaternion[1], quaternion[2], quaternion[3]);
  if (!(std::abs(q.norm() - 1) <= kUnitLength)) {
    throw InputError(option + " has the length " + falling_particles::shortest(q.norm()) +
                     "; allowed: w x y z of unit length, to " + falling_particles::shortest(kUnitLength));
  }
  return q.normalized().toRotationMatrix();
}

}  // namespace explain_pair
