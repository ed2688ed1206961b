#include "sample.hpp"

#include <algorithm>
#include <stdexcept>

#include "random_pair.hpp"

namespace supernormal::soak {
namespace {

using samples::Body;
using samples::HardCase;

// Changes range from the rounding of a number to another number.
constexpr double kLeastChange = 1e-16, kLargestChange = 1;

double change(Random& random) { return random.log_uniform(kLeastChange, kLargestChange); }

double changed(double value, double by, Random& random) { return value * (1 + by * random.uniform(-0.9, 1)); }

// The change is relative to the distance from 1, so that an exponent remains valid.
double changed_exponent(double exponent, double by, Random& random) { return 1 + changed(exponent - 1, by, random); }

void change_body(Body& body, Random& random) {
  const double by = change(random);
  const bool is_round = body.kind == Body::Kind::Capsule || body.kind == Body::Kind::Cylinder;
  for (double& length : body.lengths) length = changed(length, by, random);
  if (is_round) body.lengths.y() = body.lengths.x();
  body.delta = changed_exponent(body.delta, by, random);
  body.epsilon = changed_exponent(body.epsilon, by, random);
  const double taper = changed(1, by, random);  // the same for both, because bodies with different tapers are rarely convex
  body.taper_x *= taper;
  body.taper_y *= taper;
  body.rounding = changed(body.rounding, by, random);
  for (Vector3& point : body.points) point += by * point.norm() * random.direction();
}

void change_shape(Body& body, std::shared_ptr<const Shape>& shape, Random& random) {
  Body other = body;
  change_body(other, random);
  try {
    shape = samples::make_shape(other);
    body = std::move(other);
  } catch (const std::invalid_argument&) {
    // The change leaves the shape's range, and the original will do.
  }
}

Settings draw_settings(Random& random) {
  Settings settings;
  constexpr double kOther[] = {1e-3, 1e-6, 1e-12, 1e-15};
  if (random.chance(0.3)) settings.tolerance = kOther[random.below(std::size(kOther))];
  return settings;
}

}  // namespace

SampleSource::SampleSource(std::uint64_t seed, Mix mix) : seed_(seed), mix_(mix), catalogue_(samples::hard_cases()) {
  for (const test::SuperellipsoidClass& one : test::kSuperellipsoidClasses) {
    if (mix == Mix::Everything || one.least_exponent < one.largest_exponent) classes_.push_back(one);
  }
}

void SampleSource::draw(std::uint64_t index, Sample& sample) const {
  Random random(seed_, index);
  sample.settings = draw_settings(random);
  if (mix_ == Mix::Everything && random.chance(0.5)) {
    draw_from_catalogue(random, sample);
  } else {
    draw_random_pair(random, classes_, mix_ == Mix::Sharp, sample);
  }
}

void SampleSource::draw_from_catalogue(Random& random, Sample& sample) const {
  HardCase& pair = sample.pair = catalogue_[random.below(catalogue_.size())];
  sample.placed_gap.reset();
  if (random.chance(0.2)) change_shape(pair.body1, pair.shape1, random);
  if (random.chance(0.2)) change_shape(pair.body2, pair.shape2, random);
  const double size = std::min(pair.shape1->half_extents().minCoeff(), pair.shape2->half_extents().minCoeff());
  pair.pose2.position += change(random) * size * random.direction();
  if (random.chance(0.5)) pair.pose2.rotation = random.turn(change(random)) * pair.pose2.rotation;
}

}  // namespace supernormal::soak
