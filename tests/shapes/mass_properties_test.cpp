// Tests of volume, centroid and second moments: against references, closed forms and one another.
#include "shapes/mass_properties.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/callback_shape.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "support/draw.hpp"
#include "support/relative.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

Vector3 mean_squares(const MassProperties& mass) { return mass.second_moment.diagonal() / mass.volume; }

/// Checks agreement relative to the body's size, moments about the origin included.
void check_equal(const MassProperties& a, const MassProperties& b, double tolerance, const std::string& name) {
  const double moment = b.second_moment.trace();
  const double length = std::sqrt(moment / b.volume);
  const double volume_error = std::abs(a.volume / b.volume - 1);
  const double centroid_error = (a.centroid - b.centroid).norm() / length;
  const double moment_error = (a.second_moment - b.second_moment).cwiseAbs().maxCoeff() / moment;
  if (!(std::max({volume_error, centroid_error, moment_error}) <= tolerance)) {
    FAIL_CHECK(name, ": volume ", volume_error, " centroid ", centroid_error, " moment ", moment_error);
  }
}

/// The shape rotated and moved, as a user-defined body.
CallbackShape placed(const std::shared_ptr<const Shape>& shape, const Matrix3& rotation, const Vector3& position,
                     bool with_hessian) {
  const auto support = [=](const Vector3& n) { return shape->support(rotation.transpose() * n) + n.dot(position); };
  const auto point = [=](const Vector3& n) { return Vector3(rotation * shape->point(rotation.transpose() * n) + position); };
  if (!with_hessian) return {support, point};
  const auto hessian = [=](const Vector3& n) {
    return Matrix3(rotation * shape->jet(rotation.transpose() * n).H * rotation.transpose());
  };
  return {support, point, hessian};
}

MassProperties placed(const MassProperties& mass, const Matrix3& rotation, const Vector3& position) {
  MassProperties moved = mass;
  const Vector3 turned = rotation * mass.centroid;
  moved.centroid = turned + position;
  moved.second_moment =
      rotation * mass.second_moment * rotation.transpose() +
      mass.volume * (turned * position.transpose() + position * turned.transpose() + position * position.transpose());
  return moved;
}

/// Coefficients of V(radius) = V0 + S radius + M radius^2 + K radius^3, from the volumes at 0, 1, 2 and 3.
Eigen::Vector4d steiner(const std::shared_ptr<const Shape>& core) {
  double v[4];
  for (int i = 0; i < 4; ++i) v[i] = Rounded(core, i).mass_properties().volume;
  const double d1 = v[1] - v[0], d2 = v[2] - 2 * v[1] + v[0], d3 = v[3] - 3 * v[2] + 3 * v[1] - v[0];
  return {v[0], d1 - d2 / 2 + d3 / 3, d2 / 2 - d3 / 2, d3 / 6};
}

const Matrix3 kSomeRotation = Eigen::AngleAxisd(0.9, Vector3(1, 2, 3).normalized()).toRotationMatrix();
const Vector3 kSomePosition(0.5, -2, 4);

}  // namespace

TEST_CASE("mass: superellipsoid against the reference numbers") {
  const MassProperties boxy = Superellipsoid(Vector3(3, 2, 1), 4, 4).mass_properties();
  CHECK(boxy.volume == relative(38.8919241107183).epsilon(2e-15));
  CHECK(mean_squares(boxy).x() == relative(2.4675115376401).epsilon(1e-14));
  const MassProperties mixed = Superellipsoid(Vector3(1, 0.8, 0.6), 1.3, 5).mass_properties();
  CHECK(mixed.volume == relative(2.18581004266971).epsilon(2e-15));
  CHECK(mean_squares(mixed).x() == relative(0.189146356547047).epsilon(4e-15));
  CHECK(mean_squares(mixed).y() == relative(0.12105366819011).epsilon(2e-14));
  CHECK(mean_squares(mixed).z() == relative(0.104342869785707).epsilon(4e-15));
  CHECK(mixed.relative_error == 0);
  CHECK(mixed.centroid == Vector3(0, 0, 0));
}

TEST_CASE("mass: superellipsoid with exponents 2 is an ellipsoid, with half-axes equal a sphere") {
  const Vector3 axes(3, 2, 1);
  check_equal(Superellipsoid(axes, 2, 2).mass_properties(), Ellipsoid(axes).mass_properties(), 4e-15, "ellipsoid");
  check_equal(Ellipsoid(Vector3(2, 2, 2)).mass_properties(), Sphere(2).mass_properties(), 1e-15, "sphere");
  CHECK(Sphere(0).mass_properties().volume == 0);
}

TEST_CASE("mass: superellipsoid between octahedron and box") {
  const Vector3 axes(3, 2, 1);
  const MassProperties box = Superellipsoid(axes, 1000, 1000).mass_properties();
  CHECK(box.volume < 48);
  CHECK(box.volume == relative(48).epsilon(1e-5));  // 1 - O(1/exponent^2)
  CHECK(mean_squares(box).x() == relative(3).epsilon(1e-4));
  const MassProperties octahedron = Superellipsoid(axes, 1.01, 1.01).mass_properties();
  CHECK(octahedron.volume > 8);  // 4/3 abc, and 3 % more at exponents of 1.01
  CHECK(octahedron.volume == relative(8).epsilon(0.04));
  CHECK(mean_squares(octahedron).x() == relative(0.9).epsilon(0.04));
}

TEST_CASE("mass: quadrature over the normals against closed forms, rotated and moved") {
  for (const Vector3& axes :
       {Vector3(3, 2, 1), Vector3(100, 1, 1), Vector3(1, 100, 100), Vector3(1, 10, 100), Vector3(1e-8, 2e-8, 3e-8)}) {
    const auto ellipsoid = std::make_shared<Ellipsoid>(axes);
    const double size = axes.maxCoeff();
    check_equal(quadrature_mass_properties(*ellipsoid), ellipsoid->mass_properties(), 1e-13, "ellipsoid " + text(axes));
    for (const bool with_hessian : {true, false}) {
      const CallbackShape shape = placed(ellipsoid, kSomeRotation, size * kSomePosition, with_hessian);
      const MassProperties mass = shape.mass_properties();
      check_equal(mass, placed(ellipsoid->mass_properties(), kSomeRotation, size * kSomePosition), 1e-11, "turned " + text(axes));
      CHECK(mass.relative_error <= 1e-10);
    }
  }
}

TEST_CASE("mass: moving the origin of a user's body moves its centroid and nothing else") {
  // An egg: no symmetry along z. h = sqrt(...) + 0.2 (n_z^3-like term) is smooth; convexity is checked by the constructor.
  const auto h = [](const Vector3& n) { return 1 + 0.15 * n.z() * n.z() * n.z(); };
  const auto r = [&](const Vector3& n) {
    const Vector3 gradient(0, 0, 0.45 * n.z() * n.z());
    return Vector3(h(n) * n + gradient - n * n.dot(gradient));
  };
  const auto egg = std::make_shared<CallbackShape>(h, r);
  const MassProperties mass = egg->mass_properties();
  CHECK(mass.relative_error <= 1e-10);
  CHECK(std::abs(mass.centroid.z()) > 0.01);
  CHECK(mass.centroid.head<2>().norm() <= 1e-13);
  check_equal(placed(egg, kSomeRotation, kSomePosition, false).mass_properties(), placed(mass, kSomeRotation, kSomePosition), 1e-11,
              "egg");
}

TEST_CASE("mass: rounded bodies with closed forms") {
  check_equal(Rounded(std::make_shared<Sphere>(2), 0.5).mass_properties(), Sphere(2.5).mass_properties(), 1e-15, "sphere");
  check_equal(Rounded(std::make_shared<Ellipsoid>(Vector3(2, 2, 2)), 0.5).mass_properties(), Sphere(2.5).mass_properties(), 1e-13,
              "ellipsoid");
  const auto ellipsoid = std::make_shared<Ellipsoid>(Vector3(3, 2, 1));
  check_equal(Rounded(ellipsoid, 0).mass_properties(), ellipsoid->mass_properties(), 0, "radius 0");
  const auto once = std::make_shared<Rounded>(ellipsoid, 0.2);
  check_equal(Rounded(once, 0.3).mass_properties(), Rounded(ellipsoid, 0.5).mass_properties(), 1e-12, "rounded twice");
}

TEST_CASE("mass: a rounding that rounding hides leaves the mass of the core, and no product of its moments underflows") {
  const auto core = std::make_shared<Superellipsoid>(Vector3(1, 0.8, 0.5), 3, 5);
  for (const double radius : {4.8447493326007523e-215, std::numeric_limits<double>::denorm_min(), 1e-30}) {
    const MassProperties mass = Rounded(core, radius).mass_properties();
    check_equal(mass, core->mass_properties(), 0, "thin layer");
    CHECK(mass.relative_error == core->mass_properties().relative_error);
  }
  // This is the thinnest layer that shows: one of 1e-15 is the area times the radius.
  const double swept = Rounded(core, 1e-15).mass_properties().volume;
  CHECK(swept > core->mass_properties().volume);
}

TEST_CASE("mass: two independent ways for a rounded ellipsoid and a rounded user's body") {
  const auto ellipsoid = std::make_shared<Ellipsoid>(Vector3(3, 2, 1));
  const MassProperties expected = Rounded(ellipsoid, 0.5).mass_properties();
  check_equal(quadrature_mass_properties(Rounded(ellipsoid, 0.5)), expected, 1e-12, "quadrature");
  const auto user = std::make_shared<CallbackShape>(placed(ellipsoid, kSomeRotation, kSomePosition, true));
  check_equal(Rounded(user, 0.5).mass_properties(), placed(expected, kSomeRotation, kSomePosition), 1e-12, "user's body");
  const auto superellipsoid = std::make_shared<Superellipsoid>(Vector3(3, 2, 1), 2, 2);
  check_equal(Rounded(superellipsoid, 0.5).mass_properties(), expected, 1e-13, "superellipsoid");
}

TEST_CASE("mass: quadrature is within its reported error for bodies that are not smooth") {
  for (const double exponent : {1.3, 1.7, 2.4, 3.0, 5.0}) {
    const auto core = std::make_shared<Superellipsoid>(Vector3(3, 2, 1), exponent, exponent);
    const MassProperties numeric = quadrature_mass_properties(*core);
    check_equal(numeric, core->mass_properties(), numeric.relative_error, text(*core));
    const Rounded rounded(core, 0.3);
    const MassProperties rounded_numeric = quadrature_mass_properties(rounded);
    check_equal(rounded_numeric, rounded.mass_properties(), rounded_numeric.relative_error, "rounded " + text(*core));
    if (exponent < 2) CHECK(rounded_numeric.relative_error < 0.01);  // no flat faces: all of the surface is seen
  }
}

TEST_CASE("mass: Steiner's formula, coefficient by coefficient") {
  // Areas and mean widths are by other parametrizations: S by the angles of section and meridian, M = int h dw by tanh-sinh in
  // mpmath.
  struct Reference {
    Vector3 axes;
    double delta, epsilon, area, width;
  };
  const Reference references[] = {{Vector3(3, 2, 1), 2, 2, 48.882146302582, 26.404857387989822},
                                  {Vector3(3, 2, 1), 4, 4, 66.38462360396, 30.978672011529972},
                                  {Vector3(1, 0.8, 0.6), 1.3, 5, 8.7722976163153, 10.847858786440533},
                                  {Vector3(3, 2, 1), 20, 12, 81.52792031123, 35.723602895655757}};
  for (const Reference& reference : references) {
    const auto core = std::make_shared<Superellipsoid>(reference.axes, reference.delta, reference.epsilon);
    const Eigen::Vector4d coefficients = steiner(core);
    CHECK(coefficients[0] == relative(core->mass_properties().volume).epsilon(1e-14));
    CHECK(coefficients[1] == relative(reference.area).epsilon(1e-12));
    CHECK(coefficients[2] == relative(reference.width).epsilon(1e-12));
    CHECK(coefficients[3] == relative(4 * std::numbers::pi / 3).epsilon(1e-12));
  }
}

TEST_CASE("mass: Steiner's formula for every exponent and slender bodies") {
  for (const Superellipsoid& shape : superellipsoids(1.01, 1000)) {
    const auto is_chosen = [](double exponent) {
      return exponent == 1.01 || exponent == 1.8 || exponent == 7.5 || exponent == 1000;
    };
    if (!is_chosen(shape.delta()) || !is_chosen(shape.epsilon())) continue;
    const auto core = std::make_shared<Superellipsoid>(shape);
    const Eigen::Vector4d coefficients = steiner(core);
    // The cubic coefficient is the unit sphere's volume: the normals are covered once. Differences of volumes lose the digits
    // that `lost` counts.
    const double lost = Rounded(core, 3).mass_properties().volume;
    if (!(std::abs(coefficients[3] - 4 * std::numbers::pi / 3) <= 1e-13 * lost))
      FAIL_CHECK(text(shape), " cubic ", coefficients[3]);
    CHECK(Rounded(core, 0.1).mass_properties().relative_error <= 1e-10);
    // A thin layer is area times thickness: second moments continue the core's.
    const double thin = 1e-9 * shape.half_axes().minCoeff();
    check_equal(Rounded(core, thin).mass_properties(), shape.mass_properties(), 1e-8, text(shape));
  }
}

TEST_CASE("mass: a rounded box is the closed form") {
  const double a = 3, b = 2, c = 1, r = 0.5, pi = std::numbers::pi;
  const MassProperties mass = Rounded(std::make_shared<Box>(Vector3(a, b, c)), r).mass_properties();
  CHECK(mass.volume ==
        relative(8 * a * b * c + 8 * (a * b + b * c + c * a) * r + 2 * pi * (a + b + c) * r * r + 4 * pi / 3 * r * r * r)
            .epsilon(1e-15));
  // Slices across x: the rounded rectangle of b, c within the box, and beyond it, at a + s, that of the radius sqrt(r^2 - s^2).
  const double straight = 4 * b * c + 4 * (b + c) * r + pi * r * r;
  const double beyond = 4 * b * c * (a * a * r + a * r * r + r * r * r / 3) +
                        4 * (b + c) * (a * a * pi * r * r / 4 + 2 * a * r * r * r / 3 + pi * r * r * r * r / 16) +
                        pi * (a * a * 2 * r * r * r / 3 + a * r * r * r * r / 2 + 2 * std::pow(r, 5) / 15);
  CHECK(mass.second_moment(0, 0) == relative(2 * (straight * a * a * a / 3 + beyond)).epsilon(1e-15));
  CHECK(mass.centroid.norm() <= 1e-15);
  CHECK(mass.relative_error == 0);
}

TEST_CASE("mass: Steiner's formula is additive: a rounded tetrahedron, cut through an edge, is its halves less the rounded cut") {
  Draw draw(5);
  for (int i = 0; i < draws(100); ++i) {
    Vector3 p[4];
    for (Vector3& point : p) point = draw.in_box({1, 2, 3}) + kSomePosition;
    const Vector3 cut = p[2] + draw.uniform(0.1, 0.9) * (p[3] - p[2]);
    const double radius = draw.uniform(0.01, 3);
    const auto swept = [&](std::initializer_list<Vector3> points) {
      return swept_polytope(std::span(points.begin(), points.size()), radius);
    };
    const MassProperties first = swept({p[0], p[1], p[2], cut}), second = swept({p[0], p[1], cut, p[3]});
    const MassProperties shared = swept({p[0], p[1], cut}), whole = swept({p[0], p[1], p[2], p[3]});
    MassProperties sum;
    sum.volume = first.volume + second.volume - shared.volume;
    sum.centroid = (first.volume * first.centroid + second.volume * second.centroid - shared.volume * shared.centroid) / sum.volume;
    sum.second_moment = first.second_moment + second.second_moment - shared.second_moment;
    check_equal(sum, whole, 1e-13, "cut " + std::to_string(i));
  }
}

TEST_CASE("mass: a rounded cylinder is the limit of rounded prisms") {
  const Rounded cylinder(std::make_shared<Cylinder>(2, 1.5), 0.5);
  double before = 1;
  for (const int corners : {40, 80}) {
    std::vector<Vector3> points;
    for (int k = 0; k < 2 * corners; ++k) {
      const double angle = std::numbers::pi * (k - k % 2) / corners;
      points.emplace_back(2 * std::cos(angle), 2 * std::sin(angle), k % 2 == 0 ? 1.5 : -1.5);
    }
    const MassProperties prism = swept_polytope(points, 0.5), exact = cylinder.mass_properties();
    const double defect = 1 - prism.volume / exact.volume, across = 1 - prism.second_moment(0, 0) / exact.second_moment(0, 0);
    const double along = 1 - prism.second_moment(2, 2) / exact.second_moment(2, 2);
    for (const double ratio : {across / defect, along / defect}) CHECK((ratio > 0.5 && ratio < 3));
    if (corners == 80) CHECK(defect == relative(before / 4).epsilon(0.01));  // quadratic in the angle of a side
    before = defect;
  }
}

TEST_CASE("mass: a lens, whose edge is an open set of normals, within its reported error") {
  const double radius = 1, offset = 0.6, rim = 0.8;  // two balls of radius 1, 1.2 apart
  const auto on_cap = [=](const Vector3& n) { return std::abs(n.z()) >= offset / radius; };
  const auto h = [=](const Vector3& n) { return on_cap(n) ? radius - offset * std::abs(n.z()) : rim * std::hypot(n.x(), n.y()); };
  const auto r = [=](const Vector3& n) {
    if (on_cap(n)) return Vector3(radius * n - Vector3(0, 0, std::copysign(offset, n.z())));
    const double across = std::hypot(n.x(), n.y());
    return Vector3(rim * n.x() / across, rim * n.y() / across, 0);
  };
  const auto hessian = [=](const Vector3& n) {
    if (on_cap(n)) return Matrix3(radius * (Matrix3::Identity() - n * n.transpose()));
    const double across = std::hypot(n.x(), n.y());
    const Vector3 around(-n.y() / across, n.x() / across, 0);
    return Matrix3(rim / across * around * around.transpose());
  };
  const double cap = radius - offset;
  const double volume = 2 * std::numbers::pi * cap * cap * (3 * radius - cap) / 3;
  for (const bool with_hessian : {true, false}) {
    const auto lens =
        std::make_shared<CallbackShape>(h, r, with_hessian ? CallbackShape::Hessian(hessian) : CallbackShape::Hessian());
    for (const MassProperties& mass :
         {lens->mass_properties(), placed(lens, kSomeRotation, kSomePosition, with_hessian).mass_properties()}) {
      CHECK(std::abs(mass.volume / volume - 1) <= mass.relative_error);
      CHECK(mass.relative_error < 0.5);
      CHECK(mass.volume == relative(volume).epsilon(0.03));
    }
  }
}

TEST_CASE("mass: flat faces and straight edges, which the normals do not see, are in the reported error") {
  const Vector3 half(3, 2, 1);
  const auto h = [=](const Vector3& n) { return half.dot(n.cwiseAbs()); };
  const auto r = [=](const Vector3& n) {
    return Vector3(std::copysign(half.x(), n.x()), std::copysign(half.y(), n.y()), std::copysign(half.z(), n.z()));
  };
  for (const bool with_hessian : {true, false}) {
    const CallbackShape box(
        h, r, with_hessian ? CallbackShape::Hessian([](const Vector3&) { return Matrix3::Zero(); }) : CallbackShape::Hessian());
    const MassProperties mass = box.mass_properties();
    CHECK(std::abs(mass.volume / 48 - 1) <= mass.relative_error + 1e-12);
    CHECK(mass.relative_error > 0.9);
  }
  // A disk swept by a sphere has two flat faces and no edge.
  const double disk = 2, radius = 0.5;
  const auto across = [](const Vector3& n) { return std::hypot(n.x(), n.y()); };
  const CallbackShape pill([=](const Vector3& n) { return disk * across(n) + radius; },
                           [=](const Vector3& n) {
                             const double length = across(n);
                             return Vector3(radius * n + (length > 0 ? disk / length : 0) * Vector3(n.x(), n.y(), 0));
                           });
  const double volume = std::numbers::pi * disk * disk * 2 * radius + std::numbers::pi * std::numbers::pi * disk * radius * radius +
                        4 * std::numbers::pi / 3 * std::pow(radius, 3);
  const MassProperties mass = pill.mass_properties();
  CHECK(std::abs(mass.volume / volume - 1) <= mass.relative_error);
  CHECK(mass.relative_error < 0.6);
}

TEST_CASE("mass: a shape that delivers no numbers is an error, not a mass") {
  bool broken = false;
  const CallbackShape shape(
      [&](const Vector3&) { return broken ? std::numeric_limits<double>::quiet_NaN() : 1.0; },
      [&](const Vector3& n) { return broken ? Vector3(n * std::numeric_limits<double>::infinity()) : Vector3(n); });
  CHECK(shape.mass_properties().volume == relative(4 * std::numbers::pi / 3));
  broken = true;
  CHECK_THROWS_AS(shape.mass_properties(), std::domain_error);
}

TEST_CASE("mass: the inertia is about the centroid, wherever the origin of the body's frame is") {
  const Vector3 half_axes(1, 0.8, 0.6);
  const auto ellipsoid = std::make_shared<Ellipsoid>(half_axes);
  const double volume = 4.0 / 3 * std::numbers::pi * half_axes.prod();
  const Vector3 squares = half_axes.cwiseAbs2() / 5;
  const Vector3 expected = volume * Vector3(squares.y() + squares.z(), squares.z() + squares.x(), squares.x() + squares.y());
  for (const Vector3& position : {Vector3(0, 0, 0), Vector3(2, -1, 0.5)}) {
    const Matrix3 inertia = placed(ellipsoid, Matrix3::Identity(), position, true).mass_properties().inertia();
    CHECK((inertia - Matrix3(expected.asDiagonal())).cwiseAbs().maxCoeff() < 1e-9 * volume);
  }
}
