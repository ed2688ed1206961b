#include "sample.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "supernormal/proximity/gap_function.hpp"

namespace supernormal::soak {
namespace {

using samples::Body;
using samples::HardCase;
using test::SuperellipsoidClass;

Vector3 draw_axes(Random& random, const SuperellipsoidClass& kind) {
  const auto axis = [&] { return random.log_uniform(kind.least_axis, kind.largest_axis); };
  return Vector3{axis(), axis(), axis()};
}

/// The classes of the drawn bodies.
struct Kind {
  SuperellipsoidClass sizes;
  std::span<const SuperellipsoidClass> exponents;  // the classes from which each exponent is drawn
};

double draw_exponent(Random& random, const Kind& kind) {
  // With one class there is no draw, so the samples of the whole mix stay the same.
  const SuperellipsoidClass& one =
      kind.exponents.size() == 1 ? kind.exponents[0] : kind.exponents[random.below(kind.exponents.size())];
  return random.log_uniform(one.least_exponent, one.largest_exponent);
}

Body draw_superellipsoid(Random& random, const Kind& kind) {
  const Vector3 axes = draw_axes(random, kind.sizes);
  if (kind.sizes.least_exponent == kind.sizes.largest_exponent) return samples::ellipsoid(axes);
  const double delta = draw_exponent(random, kind);
  return samples::superellipsoid(axes, delta, draw_exponent(random, kind));
}

Body draw_polytope(Random& random, const Vector3& axes) {
  std::vector<Vector3> points(4 + random.below(9));
  for (Vector3& point : points) point = axes.cwiseProduct(random.direction());
  return samples::polytope(std::move(points));
}

/// Draws any body but a plain superellipsoid.
Body draw_other(Random& random, const Kind& kind) {
  const Vector3 axes = draw_axes(random, kind.sizes);
  switch (random.below(8)) {
    case 0:
      return samples::box(axes);
    case 1:
      return samples::capsule(axes.x(), axes.z());
    case 2:
      return samples::cylinder(axes.x(), axes.z());
    case 3:
      return samples::ellipsoid(Vector3::Constant(axes.x()));
    case 4: {
      const Body body = draw_superellipsoid(random, kind);
      return body.rounded(axes.minCoeff() * random.log_uniform(1e-6, 1));
    }
    case 5: {
      const Body body = draw_superellipsoid(random, kind);
      const double taper = random.uniform(-1, 1) * std::exp2(1 / body.epsilon) * (body.epsilon - 1) / body.epsilon;
      return samples::superovoid(body.lengths, body.delta, body.epsilon, taper, taper);
    }
    case 6:
      return draw_superellipsoid(random, kind).by_callbacks();
    default:
      return draw_polytope(random, axes);
  }
}

/// Draws a normal. A coordinate may be 0 or nearly 0.
Vector3 draw_normal(Random& random) {
  Vector3 n = random.direction();
  if (random.chance(0.7)) return n;
  for (int k = 0; k < 2; ++k) {
    double& component = n[static_cast<int>(random.below(3))];
    component = random.chance(0.5) ? 0 : component * random.log_uniform(1e-300, 1);
  }
  const double length = n.norm();
  return length > 1e-9 ? Vector3(n / length) : Vector3::UnitX();
}

Matrix3 draw_rotation(Random& random) {
  if (random.chance(0.8)) return random.rotation();
  if (random.chance(0.3)) return Matrix3::Identity();
  return random.turn(random.log_uniform(1e-16, 1));
}

/// Draws a gap in units of the smallest half-extent: from 2 through touching to -1.
double draw_relative_gap(Random& random) {
  const double choice = random.uniform();
  if (choice < 0.1) return 0;
  if (choice < 0.4) return random.log_uniform(1e-16, 2);
  if (choice < 0.8) return -random.log_uniform(1e-16, 0.3);
  return -random.uniform(0.3, 1);
}

/// Places body 2 where n is a common normal and s(n) is `gap`.
void place_on_normal(HardCase& pair, const Vector3& n, double gap) {
  const Vector3 point2 = pair.pose2.rotation * pair.shape2->point(-(pair.pose2.rotation.transpose() * n));
  pair.pose2.position = pair.shape1->point(n) + gap * n - point2;
}

double value_at(const HardCase& pair, const Vector3& n) {
  GapFunction gap(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2);
  GapJet jet;
  gap.evaluate(n, Order::Value, jet);
  return jet.s;
}

void move_frame(HardCase& pair, Random& random) {
  const Matrix3 turn = random.rotation();
  const Vector3 position = random.log_uniform(1e-3, 1e6) * random.direction();
  pair.pose1 = {position, turn};
  pair.pose2 = {position + turn * pair.pose2.position, turn * pair.pose2.rotation};
}

/// Draws two bodies of one of the classes, or one body and a shape with faces, edges or a rounding. They have a common normal, or
/// one is inside the other. With `mixes_exponents` only the half-axes are of one class, and each exponent is of any class.
void draw_random_pair(Random& random, std::span<const SuperellipsoidClass> classes, bool mixes_exponents, Sample& sample) {
  const SuperellipsoidClass& one = classes[random.below(classes.size())];
  const Kind kind{one, mixes_exponents ? classes : std::span(&one, 1)};
  HardCase& pair = sample.pair;
  pair.name = mixes_exponents ? "random: of any exponents" : std::string("random: ") + one.name;
  pair.first_normal.reset();
  pair.gap.reset();
  pair.body1 = draw_superellipsoid(random, kind);
  pair.body2 = random.chance(0.3) ? draw_other(random, kind) : draw_superellipsoid(random, kind);
  if (random.chance(0.5)) std::swap(pair.body1, pair.body2);
  pair.shape1 = samples::make_shape(pair.body1);
  pair.shape2 = samples::make_shape(pair.body2);
  pair.pose1 = {};
  pair.pose2.rotation = draw_rotation(random);
  const double unit = std::min(pair.shape1->half_extents().minCoeff(), pair.shape2->half_extents().minCoeff());
  if (random.chance(0.05)) {  // one body is inside the other
    pair.pose2.position = unit * random.log_uniform(1e-16, 1) * random.direction();
    sample.placed_gap.reset();
  } else {
    const Vector3 n = draw_normal(random);
    place_on_normal(pair, n, draw_relative_gap(random) * unit);
    sample.placed_gap = value_at(pair, n);
  }
  if (random.chance(0.1)) move_frame(pair, random);
}

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
