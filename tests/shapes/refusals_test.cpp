// Tests that constructors refuse invalid bodies, also bodies given by functions, and name the parameter, its value and its range.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "supernormal/shapes/callback_shape.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/refusal.hpp"
#include "support/relative.hpp"
#include "support/shape_samples.hpp"
#include "support/traps.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string refusal_of_axes(double a, double b, double c) {
  std::string ellipsoid = refusal([&] { Ellipsoid{Vector3(a, b, c)}; });
  CHECK(refusal([&] { Superellipsoid(Vector3(a, b, c), 3, 3); }) == ellipsoid);
  return ellipsoid;
}

const Ellipsoid kReference(Vector3(3, 2, 1));
const CallbackShape::Support kGoodSupport = [](const Vector3& n) { return kReference.support(n); };
const CallbackShape::Point kGoodPoint = [](const Vector3& n) { return kReference.point(n); };
const CallbackShape::Hessian kGoodHessian = [](const Vector3& n) { return kReference.jet(n).H; };

std::string refusal_of(const CallbackShape::Support& support, const CallbackShape::Point& point,
                       const CallbackShape::Hessian& hessian = {}) {
  return refusal([&] { CallbackShape(support, point, hessian); });
}

}  // namespace

TEST_CASE("half-axes outside the range are refused by name") {
  const Traps traps("refusals of half-axes");
  CHECK(refusal_of_axes(0, 1, 1) == "half-axis a = 0 m is outside [1e-30, 1e+30] m");
  CHECK(refusal_of_axes(1, -2.5, 1) == "half-axis b = -2.5 m is outside [1e-30, 1e+30] m");
  CHECK(refusal_of_axes(1, 1, kNan) == "half-axis c = nan m is outside [1e-30, 1e+30] m");
  CHECK(refusal_of_axes(1, kInfinity, 1) == "half-axis b = inf m is outside [1e-30, 1e+30] m");
  CHECK(refusal_of_axes(5e-324, 1, 1) == "half-axis a = 5e-324 m is outside [1e-30, 1e+30] m");
  CHECK(refusal_of_axes(1, 1, 1e31) == "half-axis c = 1e+31 m is outside [1e-30, 1e+30] m");
  CHECK(refusal_of_axes(1e-30, 1, 1e30).empty());
}

TEST_CASE("exponents outside the range are refused by name") {
  const Traps traps("refusals of exponents");
  const Vector3 axes(3, 2, 1);
  CHECK(refusal([&] { Superellipsoid(axes, 0.9, 2); }) == "delta = 0.9 is outside [1.01, 1000]");
  CHECK(refusal([&] { Superellipsoid(axes, 2, 1); }) == "epsilon = 1 is outside [1.01, 1000]");
  CHECK(refusal([&] { Superellipsoid(axes, kNan, 2); }) == "delta = nan is outside [1.01, 1000]");
  CHECK(refusal([&] { Superellipsoid(axes, 2, -kInfinity); }) == "epsilon = -inf is outside [1.01, 1000]");
  CHECK(refusal([&] { Superellipsoid(axes, 1000.5, 2); }) == "delta = 1000.5 is outside [1.01, 1000]");
  CHECK(refusal([&] { Superellipsoid(axes, 1.01, 1000); }).empty());
}

TEST_CASE("radii outside the range are refused by name; 0 is a point") {
  const Traps traps("refusals of radii");
  const auto core = std::make_shared<Sphere>(1);
  for (const auto& construct : {std::function<void(double)>([](double radius) { Sphere{radius}; }),
                                std::function<void(double)>([&](double radius) { Rounded(core, radius); })}) {
    CHECK(refusal([&] { construct(-1e-3); }) == "radius = -0.001 m is outside [0, 1e+30] m");
    CHECK(refusal([&] { construct(kNan); }) == "radius = nan m is outside [0, 1e+30] m");
    CHECK(refusal([&] { construct(kInfinity); }) == "radius = inf m is outside [0, 1e+30] m");
    CHECK(refusal([&] { construct(0); }).empty());
  }
  CHECK(refusal([] { Rounded(nullptr, 1); }) == "core is null; a shape is needed");
}

TEST_CASE("callbacks are passed on unchanged") {
  const CallbackShape with(kGoodSupport, kGoodPoint, kGoodHessian), without(kGoodSupport, kGoodPoint);
  CHECK(with.traits().has_hessian);
  CHECK_FALSE(without.traits().has_hessian);
  CHECK_FALSE(with.traits().has_flat_faces);
  CHECK(with.half_extents() == Vector3(3, 2, 1));
  for (const Vector3& n : random_normals(20, 41)) {
    const Jet expected = kReference.jet(n), jet = with.jet(n);
    CHECK(jet.h == expected.h);
    CHECK(jet.r == expected.r);
    CHECK(jet.H == expected.H);
    Jet points_only;
    without.evaluate(n, Order::Point, points_only);
    CHECK(points_only.h == expected.h);
    CHECK(points_only.r == expected.r);
  }
}

TEST_CASE("an order calls no function that it does not need") {
  int points = 0, hessians = 0;
  const CallbackShape shape(
      kGoodSupport, [&](const Vector3& n) { return ++points, kGoodPoint(n); },
      [&](const Vector3& n) { return ++hessians, kGoodHessian(n); });
  points = hessians = 0;
  shape.support(Vector3::UnitX());
  CHECK(points == 0);
  shape.point(Vector3::UnitX());
  CHECK(points == 1);
  CHECK(hessians == 0);
  shape.jet(Vector3::UnitX());
  CHECK(hessians == 1);
}

TEST_CASE("missing functions are refused") {
  CHECK(refusal_of({}, kGoodPoint) == "the support function is missing");
  CHECK(refusal_of(kGoodSupport, {}) == "the point function is missing");
}

TEST_CASE("values that are not finite are refused, with the direction") {
  const auto only_up = [](const Vector3& n) { return n == Vector3::UnitZ(); };
  const std::string support = refusal_of([&](const Vector3& n) { return only_up(n) ? kNan : kGoodSupport(n); }, kGoodPoint);
  CHECK(support == "support = nan is not finite in the direction n = (0, 0, 1)");
  const std::string point =
      refusal_of(kGoodSupport, [&](const Vector3& n) { return only_up(n) ? Vector3(0, HUGE_VAL, 1) : Vector3(kGoodPoint(n)); });
  CHECK(point == "point = (0, inf, 1) is not finite in the direction n = (0, 0, 1)");
  const std::string hessian = refusal_of(
      kGoodSupport, kGoodPoint, [&](const Vector3& n) { return only_up(n) ? Matrix3::Constant(kNan) : Matrix3(kGoodHessian(n)); });
  CHECK(hessian == "hessian is not finite in the direction n = (0, 0, 1)");
}

TEST_CASE("a point off its supporting plane is refused; single precision is accepted") {
  const std::string message = refusal_of([](const Vector3& n) { return 1.25 * kGoodSupport(n); }, kGoodPoint);
  check_contains(message, "differs from support = ");
  check_contains(message, "by more than 1e-6 of the size 3.75 m in the direction n = (");
  CHECK(refusal_of([](const Vector3& n) { return static_cast<float>(kGoodSupport(n)); },
                   [](const Vector3& n) { return Vector3(kGoodPoint(n).cast<float>().cast<double>()); })
            .empty());
}

TEST_CASE("a body without width is refused, one beside its origin is not") {
  const auto segment = [](const Vector3& n) { return std::abs(n.x()); };
  const auto end = [](const Vector3& n) { return Vector3(std::copysign(1.0, n.x()), 0, 0); };
  check_contains(refusal_of(segment, end), "the width support(n) + support(-n) = 0 m is below 2e-30 m in the direction n = (");
  check_contains(refusal_of([](const Vector3&) { return 0.0; }, [](const Vector3&) { return Vector3(0, 0, 0); }),
                 "size of the body = 0 m is outside [1e-30, 1e+30] m");
  // This body is so thin that squares of its thickness underflow (found by tests/fuzz).
  const Vector3 axes(1, 1e-300, 2);
  check_contains(refusal_of([&](const Vector3& n) { return axes.cwiseProduct(n).norm(); },
                            [&](const Vector3& n) { return Vector3(axes.cwiseProduct(axes.cwiseProduct(n).normalized())); }),
                 " m is below 2e-30 m in the direction n = (0, -1, 0)");
  const Vector3 offset(100, 0, 0);
  CHECK(refusal_of([&](const Vector3& n) { return kGoodSupport(n) + n.dot(offset); },
                   [&](const Vector3& n) { return Vector3(kGoodPoint(n) + offset); })
            .empty());
}

TEST_CASE("a body that is not convex is refused") {
  // h = 1 + 0.3 cos(4 angle about z): n.r = h holds, but the contour crosses itself.
  const auto h = [](const Vector3& n) { return 1 + 0.3 * std::cos(4 * std::atan2(n.y(), n.x())); };
  const auto r = [&](const Vector3& n) {
    const double angle = std::atan2(n.y(), n.x());
    const double across = std::hypot(n.x(), n.y());
    const Vector3 around(-std::sin(angle), std::cos(angle), 0);
    return Vector3(h(n) * n - (across > 0 ? 1.2 * std::sin(4 * angle) / across : 0) * around);
  };
  check_contains(refusal_of(h, r), "the body is not convex: point(");
}

TEST_CASE("a Hessian that cannot be one is refused") {
  const auto with = [](const std::function<Matrix3(const Vector3&)>& hessian) {
    return refusal_of(kGoodSupport, kGoodPoint, hessian);
  };
  check_contains(with([](const Vector3& n) {
                   Matrix3 H = kGoodHessian(n);
                   H(0, 1) += 0.1;
                   return H;
                 }),
                 "hessian is not symmetric");
  check_contains(with([](const Vector3& n) { return Matrix3(kGoodHessian(n) + Matrix3::Identity()); }),
                 "hessian times n is not zero");
  check_contains(with([](const Vector3& n) { return Matrix3(-kGoodHessian(n)); }), "hessian has a negative principal radius");
  CHECK(with(kGoodHessian).empty());
  CHECK(with([](const Vector3&) { return Matrix3::Zero(); }).empty());  // the vertices of a polytope have no other
}

TEST_CASE("where the body is sharpest is found from its points") {
  const CallbackShape ball([](const Vector3&) { return 1.0; }, [](const Vector3& n) { return n; });
  CHECK(ball.min_curvature_radius_estimate() == relative(1).epsilon(1e-12));
  // An ellipsoid is sharpest, c^2/a, at the ends of its longest axis.
  const Ellipsoid ellipsoid(Vector3(3, 2, 1));
  const CallbackShape copy([&](const Vector3& n) { return ellipsoid.support(n); },
                           [&](const Vector3& n) { return ellipsoid.point(n); });
  CHECK(copy.min_curvature_radius_estimate() == relative(1.0 / 3).epsilon(1e-6));
  // A vertex is recognised by the radius of curvature near its normal: within five degrees it is still a hundredth of the body's
  // size.
  const Superellipsoid octahedral(Vector3(1, 1, 1), 1.3, 1.3);
  const CallbackShape pointed([&](const Vector3& n) { return octahedral.support(n); },
                              [&](const Vector3& n) { return octahedral.point(n); });
  CHECK(pointed.min_curvature_radius_estimate() <= 1e-6);
  // The intersection of two balls: its edge, a circle around z, bends around the axes across z.
  const auto lens = [](const Vector3& n) -> Vector3 {
    if (std::abs(n.z()) > 0.5) return n - Vector3(0, 0, std::copysign(0.5, n.z()));
    return std::sqrt(0.75) * Vector3(n.x(), n.y(), 0).normalized();
  };
  CHECK(CallbackShape([&](const Vector3& n) { return n.dot(lens(n)); }, lens).min_curvature_radius_estimate() == 0);
}
