#include "support/hard_cases/body.hpp"

#include <array>
#include <cstdio>
#include <utility>

#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/callback_shape.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/shapes/superovoid.hpp"

namespace supernormal::samples {
namespace {

using Kind = Body::Kind;

/// A polytope and the points to which it refers.
struct OwnedPolytope {
  explicit OwnedPolytope(std::vector<Vector3> corners) : points(std::move(corners)), shape(points) {}

  std::vector<Vector3> points;
  Polytope shape;
};

std::shared_ptr<const Shape> make_polytope(const Body& body) {
  const auto owned = std::make_shared<OwnedPolytope>(body.points);
  return {owned, &owned->shape};
}

std::shared_ptr<const Shape> make_plain(const Body& body) {
  const Vector3& lengths = body.lengths;
  switch (body.kind) {
    case Kind::Ellipsoid:
      return std::make_shared<Ellipsoid>(lengths);
    case Kind::Superellipsoid:
      return std::make_shared<Superellipsoid>(lengths, body.delta, body.epsilon);
    case Kind::Superovoid:
      return std::make_shared<Superovoid>(lengths, body.delta, body.epsilon, body.taper_x, body.taper_y);
    case Kind::Box:
      return std::make_shared<Box>(lengths);
    case Kind::Capsule:
      return std::make_shared<Capsule>(lengths.x(), lengths.z());
    case Kind::Cylinder:
      return std::make_shared<Cylinder>(lengths.x(), lengths.z());
    case Kind::Polytope:
      break;
  }
  return make_polytope(body);
}

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::Ellipsoid:
      return "ellipsoid";
    case Kind::Superellipsoid:
      return "superellipsoid";
    case Kind::Superovoid:
      return "superovoid";
    case Kind::Box:
      return "box";
    case Kind::Capsule:
      return "capsule";
    case Kind::Cylinder:
      return "cylinder";
    case Kind::Polytope:
      break;
  }
  return "polytope";
}

}  // namespace

Body Body::rounded(double radius) const {
  Body body = *this;
  body.rounding = radius;
  return body;
}

Body Body::scaled(double unit) const {
  Body body = *this;
  body.lengths *= unit;
  body.rounding *= unit;
  for (Vector3& point : body.points) point *= unit;
  return body;
}

Body Body::by_callbacks() const {
  Body body = *this;
  body.is_callback = true;
  return body;
}

Body ellipsoid(const Vector3& half_axes) { return {.kind = Kind::Ellipsoid, .lengths = half_axes}; }

Body superellipsoid(const Vector3& half_axes, double delta, double epsilon) {
  return {.kind = Kind::Superellipsoid, .lengths = half_axes, .delta = delta, .epsilon = epsilon};
}

Body superovoid(const Vector3& half_axes, double delta, double epsilon, double taper_x, double taper_y) {
  return {
      .kind = Kind::Superovoid, .lengths = half_axes, .delta = delta, .epsilon = epsilon, .taper_x = taper_x, .taper_y = taper_y};
}

Body box(const Vector3& half_lengths) { return {.kind = Kind::Box, .lengths = half_lengths}; }

Body capsule(double radius, double half_length) { return {.kind = Kind::Capsule, .lengths = {radius, radius, half_length}}; }

Body cylinder(double radius, double half_length) { return {.kind = Kind::Cylinder, .lengths = {radius, radius, half_length}}; }

Body polytope(std::vector<Vector3> points) { return {.kind = Kind::Polytope, .points = std::move(points)}; }

Body superball(double radius, double exponent) { return superellipsoid(Vector3::Constant(radius), exponent, exponent); }

std::shared_ptr<const Shape> make_shape(const Body& body) {
  std::shared_ptr<const Shape> shape = make_plain(body);
  if (body.rounding > 0) shape = std::make_shared<Rounded>(std::move(shape), body.rounding);
  if (!body.is_callback) return shape;
  return std::make_shared<CallbackShape>([shape](const Vector3& n) { return shape->support(n); },
                                         [shape](const Vector3& n) { return shape->point(n); });
}

std::string describe(const Body& body) {
  std::string out = name_of(body.kind);
  if (body.kind == Kind::Polytope) {
    out += " of " + std::to_string(body.points.size()) + " points";
  } else {
    out += " (" + text(body.lengths.x()) + ", " + text(body.lengths.y()) + ", " + text(body.lengths.z()) + ") m";
  }
  if (body.kind == Kind::Superellipsoid || body.kind == Kind::Superovoid)
    out += "; " + text(body.delta) + ", " + text(body.epsilon);
  if (body.kind == Kind::Superovoid) out += "; taper " + text(body.taper_x) + ", " + text(body.taper_y);
  if (body.rounding > 0) out += ", rounded " + text(body.rounding) + " m";
  if (body.is_callback) out += ", by callbacks";
  return out;
}

std::string text(double value) {
  std::array<char, 32> buffer;
  std::snprintf(buffer.data(), buffer.size(), "%g", value);
  return buffer.data();
}

std::string exact_text(double value) {
  std::array<char, 32> buffer;
  std::snprintf(buffer.data(), buffer.size(), "%.17g", value);
  return buffer.data();
}

std::string exact_text(const Vector3& v) {
  return "(" + exact_text(v.x()) + ", " + exact_text(v.y()) + ", " + exact_text(v.z()) + ")";
}

}  // namespace supernormal::samples
