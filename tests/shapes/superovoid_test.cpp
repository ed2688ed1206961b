// Tests of tapered superellipsoids against their equation and closed forms.
#include "supernormal/shapes/superovoid.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>

#include "shapes/mass_properties.hpp"
#include "shapes/superovoid_convexity.hpp"
#include "shapes/superovoid_samples.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "support/draw.hpp"
#include "support/refusal.hpp"
#include "support/relative.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

using Real = long double;

/// The left side of the implicit equation, in extended precision.
Real implicit(const Superovoid& shape, const Vector3& point) {
  const Real z = Real{point.z()} / Real{shape.half_axes().z()};
  const Real x = std::abs(Real{point.x()}) / (Real{shape.half_axes().x()} * (1 + Real{shape.taper_x()} * z));
  const Real y = std::abs(Real{point.y()}) / (Real{shape.half_axes().y()} * (1 + Real{shape.taper_y()} * z));
  const Real delta = shape.delta(), epsilon = shape.epsilon();
  return std::pow(std::pow(x, delta) + std::pow(y, delta), epsilon / delta) + std::pow(std::abs(z), epsilon);
}

/// Computes max over the heights z = s c of the width of the section plus n_z z by golden section, independently of the library.
double slow_support(const Superovoid& shape, const Vector3& n) {
  const Real p = Real{shape.delta()} / (Real{shape.delta()} - 1), epsilon = shape.epsilon();
  const auto value = [&](Real s) {
    const Real x = std::abs(Real{shape.half_axes().x()} * (1 + shape.taper_x() * s) * n.x());
    const Real y = std::abs(Real{shape.half_axes().y()} * (1 + shape.taper_y() * s) * n.y());
    const Real large = std::max(x, y), small = std::min(x, y);
    const Real width = large > 0 ? large * std::pow(1 + std::pow(small / large, p), 1 / p) : 0;
    const Real meridian = std::pow(1 - std::pow(std::abs(s), epsilon), 1 / epsilon);
    return meridian * width + Real{shape.half_axes().z()} * n.z() * s;
  };
  constexpr Real kGolden = 0.6180339887498948482L;
  Real low = -1, high = 1;
  for (int i = 0; i < 90; ++i) {
    const Real left = high - kGolden * (high - low), right = low + kGolden * (high - low);
    (value(left) < value(right) ? low : high) = value(left) < value(right) ? left : right;
  }
  return static_cast<double>(value(0.5L * (low + high)));
}

}  // namespace

TEST_CASE("superovoid: the boundary point satisfies the implicit equation to 1e-12") {
  const std::vector<Vector3> normals = all_normals(60, 1);
  for (const Superovoid& shape : superovoids(1.02, 200)) {
    for (const Vector3& n : normals) {
      const double residual = static_cast<double>(std::abs(implicit(shape, shape.point(n)) - 1));
      if (!(residual <= 1e-12)) FAIL_CHECK(text(shape), " n ", text(n), " residual ", residual);
    }
  }
}

TEST_CASE("superovoid: h is the largest width over all heights") {
  int checked = 0;
  for (const Superovoid& shape : superovoids(1.01, 1000)) {
    const double size = shape.half_axes().sum();
    for (const Vector3& n : random_normals(draws(4), 2)) {
      const Jet jet = shape.jet(n);
      const double expected = slow_support(shape, n);
      ++checked;
      if (!(std::abs(jet.h - expected) <= 1e-14 * size)) {
        FAIL_CHECK(text(shape), " n ", text(n), " h ", jet.h, " expected ", expected);
      }
    }
  }
  CHECK(checked > draws(300));
}

TEST_CASE("superovoid: with tapers 0 it is the superellipsoid, to rounding") {
  for (const Superellipsoid& straight : superellipsoids(1.01, 1000)) {
    const Superovoid shape(straight.half_axes(), straight.delta(), straight.epsilon(), 0, 0);
    CHECK(shape.half_extents() == straight.half_extents());
    for (const Vector3& n : all_normals(5, 9)) {
      const Jet a = shape.jet(n), b = straight.jet(n);
      const double hessian_size = b.H.cwiseAbs().maxCoeff();
      const bool same = std::abs(a.h - b.h) <= 1e-15 * b.h &&
                        (a.r - b.r).cwiseQuotient(straight.half_axes()).cwiseAbs().maxCoeff() <= 2e-15 &&
                        (a.H - b.H).cwiseAbs().maxCoeff() <= 1e-14 * hessian_size + 1e-290;
      if (!same) {
        FAIL_CHECK(text(straight), " n ", text(n), " h ", a.h - b.h, " r ", (a.r - b.r).norm(), " H ", (a.H - b.H).norm(), " of ",
                   hessian_size);
      }
    }
    const MassProperties a = shape.mass_properties(), b = straight.mass_properties();
    CHECK(a.volume == relative(b.volume).epsilon(1e-14));
    CHECK((a.second_moment - b.second_moment).norm() <= 1e-13 * b.second_moment.norm());
    CHECK(a.centroid == Vector3(0, 0, 0));
  }
}

TEST_CASE("superovoid: opposite tapers put it upside down; x and y may be exchanged") {
  for (const Superovoid& shape : superovoids(1.01, 1000)) {
    const Vector3& axes = shape.half_axes();
    const Superovoid flipped(axes, shape.delta(), shape.epsilon(), -shape.taper_x(), -shape.taper_y());
    const Superovoid exchanged(Vector3(axes.y(), axes.x(), axes.z()), shape.delta(), shape.epsilon(), shape.taper_y(),
                               shape.taper_x());
    for (const Vector3& n : random_normals(5, 10)) {
      const Vector3 r = shape.point(n);
      CHECK(flipped.point(Vector3(n.x(), n.y(), -n.z())) == Vector3(r.x(), r.y(), -r.z()));
      const Vector3 swapped = exchanged.point(Vector3(n.y(), n.x(), n.z()));
      CHECK((swapped - Vector3(r.y(), r.x(), r.z())).norm() <= 1e-13 * r.norm());
    }
    CHECK(shape.half_extents() == flipped.half_extents());
    CHECK((shape.half_extents() - shape.Shape::half_extents()).norm() <= 1e-15 * axes.norm());
  }
}

TEST_CASE("superovoid: mass against quadrature over the normals, and against one through the sections") {
  for (const Superovoid& shape : {Superovoid(Vector3(3, 2, 1), 2, 2, 0.25, 0.25), Superovoid(Vector3(3, 2, 1), 2, 2, 0.3, -0.15),
                                  Superovoid(Vector3(1, 1, 4), 2, 2, 0, -0.2)}) {
    const MassProperties exact = shape.mass_properties(), numeric = quadrature_mass_properties(shape);
    CHECK(numeric.relative_error <= 1e-9);
    CHECK(numeric.volume == relative(exact.volume).epsilon(1e-10));
    CHECK((numeric.centroid - exact.centroid).norm() <= 1e-10 * shape.half_axes().norm());
    CHECK((numeric.second_moment - exact.second_moment).norm() <= 1e-10 * exact.second_moment.norm());
  }
  for (const Superovoid& shape : superovoids(1.01, 1000)) {
    // The substitution s = (1 + tanh(pi/2 sinh t))/2 resolves both ends of each half (Takahasi and Mori 1974).
    double volume = 0, first = 0, height = 0;
    for (int i = -600; i <= 600; ++i) {
      const double t = i / 150.0, u = std::numbers::pi / 2 * std::sinh(t);
      const double s = 1 / (1 + std::exp(-2 * u)), rest = 1 / (1 + std::exp(2 * u));  // 1 - s
      const double weight = std::numbers::pi * std::cosh(t) * s * rest / 150;
      const double log_s = s < 0.5 ? std::log(s) : std::log1p(-rest);
      const double meridian = std::pow(-std::expm1(shape.epsilon() * log_s), 1 / shape.epsilon());
      for (const double z : {s, -s}) {
        const double area = weight * meridian * meridian * (1 + shape.taper_x() * z) * (1 + shape.taper_y() * z);
        volume += area;
        first += area * z;
        height += area * z * z;
      }
    }
    const double d1 = std::tgamma(1 + 1 / shape.delta()), section = 4 * d1 * d1 / std::tgamma(1 + 2 / shape.delta());
    const MassProperties mass = shape.mass_properties();
    const double c = shape.half_axes().z();
    CHECK(mass.volume == relative(section * shape.half_axes().prod() * volume).epsilon(1e-12));
    CHECK(std::abs(mass.centroid.z() - c * first / volume) <= 1e-12 * c);
    CHECK(mass.second_moment(2, 2) / mass.volume == relative(c * c * height / volume).epsilon(1e-12));
    CHECK(mass.centroid.head<2>() == Eigen::Vector2d(0, 0));
  }
}

TEST_CASE("superovoid: mass when rounded: by layers, and by quadrature over the normals") {
  const auto round = std::make_shared<Superovoid>(Vector3(3, 2, 1), 2, 2, 0.5, 0.2);
  const Rounded rounded(round, 0.4);
  const MassProperties layered = rounded.mass_properties(), numeric = quadrature_mass_properties(rounded);
  CHECK(layered.volume == relative(numeric.volume).epsilon(1e-10));
  CHECK((layered.centroid - numeric.centroid).norm() <= 1e-10);
  CHECK((layered.second_moment - numeric.second_moment).norm() <= 1e-10 * numeric.second_moment.norm());
  // Steiner's formula: the volume is a cubic in the radius, the last coefficient is the ball, the first the body itself. The
  // body's centroid moves towards the centroid of its surface.
  for (const double exponent : {1.3, 4.0, 50.0}) {
    const double taper = 0.8 * Superovoid::max_taper(exponent);
    const auto core = std::make_shared<Superovoid>(Vector3(3, 2, 1), exponent, exponent, taper, taper);
    double v[4];
    for (int k = 0; k < 4; ++k) v[k] = Rounded(core, k).mass_properties().volume;
    CHECK((v[3] - 3 * v[2] + 3 * v[1] - v[0]) / 6 == relative(4 * std::numbers::pi / 3).epsilon(1e-8));
    CHECK(Rounded(core, 1e-9).mass_properties().volume == relative(v[0]).epsilon(1e-8));
    CHECK(Rounded(core, 1e6).mass_properties().centroid.z() < core->mass_properties().centroid.z() + 1);
  }
}

TEST_CASE("superovoid: what is not convex is refused, with the condition that fails") {
  const Vector3 axes(3, 2, 1);
  CHECK(Superovoid::max_taper(2) == test::relative(std::numbers::sqrt2 / 2).epsilon(1e-15));
  CHECK(refusal([&] { Superovoid(axes, 2, 4, 0.9, 0.5); }) ==
        "taper_x = 0.9 is outside [-0.8919053362520408, 0.8919053362520408], where a body with epsilon = 4 is convex: |taper| <= "
        "2^(1/epsilon) (epsilon - 1)/epsilon");
  CHECK(refusal([&] { Superovoid(axes, 2, 2, 0, std::numeric_limits<double>::quiet_NaN()); }).find("taper_y = nan is outside") ==
        0);
  CHECK(refusal([&] { Superovoid(axes, 2, 2.5, 0.1, 0.2); }) ==
        "taper_x = 0.1 and taper_y = 0.2 differ, but with epsilon = 2.5 a body is convex only if they are equal: above 2 it has "
        "straight sides, which different tapers twist");
  CHECK(refusal([&] { Superovoid(axes, 1.1, 2, 0.5, -0.5); })
            .find("taper_x = 0.5 and taper_y = -0.5 with delta = 1.1 and epsilon = 2: not convex, because the width of the section "
                  "in some direction is not a concave function of z at z = ") == 0);
  CHECK(refusal([&] { Superovoid(axes, 2, 2, 0.5, -0.5); }).empty());
  CHECK(refusal([&] { Superovoid(axes, 0.9, 2, 0, 0); }) == "delta = 0.9 is outside [1.01, 1000]");
  CHECK(refusal([&] { Superovoid(axes, 2, 1001, 0, 0); }) == "epsilon = 1001 is outside [1.01, 1000]");
  CHECK(refusal([&] { Superovoid(Vector3(1, 0, 1), 2, 2, 0, 0); }) == "half-axis b = 0 m is outside [1e-30, 1e+30] m");
  // The closed form in the header: k^2 <= delta - 1 for tapers -k and k with epsilon = 2.
  CHECK(refusal([&] { Superovoid(axes, 1.25, 2, -0.499999, 0.499999); }).empty());
  CHECK_FALSE(refusal([&] { Superovoid(axes, 1.25, 2, -0.500001, 0.500001); }).empty());
}

TEST_CASE("superovoid: the limit of convexity is exact: chords of the surface, scanned") {
  // The width g(s) of the section in a direction (A, B) is concave: no midpoint of a chord lies above it. Exponents, tapers and
  // directions are random; the least second difference tells on which side of the limit a body is.
  std::mt19937_64 engine(13);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int convex = 0, refused = 0;
  for (int i = 0; i < draws(400); ++i) {
    const double delta = 1.05 + 4 * std::abs(uniform(engine)) * (i % 2 == 0 ? 1 : 0.02);
    const double epsilon = i % 4 == 3 ? 2.05 + 4 * std::abs(uniform(engine)) : 1.1 + 0.9 * std::abs(uniform(engine));
    const double x = 1.1 * uniform(engine), y = i % 4 >= 2 ? x : 1.1 * uniform(engine);
    const double p = delta / (delta - 1);
    double least = std::numeric_limits<double>::infinity();
    for (int trial = 0; trial < 4000; ++trial) {
      const double s = 0.999 * uniform(engine), step = 1e-3 * (1 - std::abs(s));
      if (x == y && std::abs(s) < 0.1) continue;  // a straight side, where only rounding is left
      const double share = std::abs(uniform(engine));
      if (std::min(1 + x * s, 1 + y * s) <= 0.01) {
        least = -1;
        break;
      }
      const auto width = [&](double height) {
        const double inside =
            std::pow(share * (1 + x * height) / (1 + x * s), p) + std::pow((1 - share) * (1 + y * height) / (1 + y * s), p);
        return std::pow(1 - std::pow(std::abs(height), epsilon), 1 / epsilon) * std::pow(inside, 1 / p);
      };
      const double room = 1 - std::pow(std::abs(s), epsilon);
      const double second = (2 * width(s) - width(s + step) - width(s - step)) / (step * step) / width(s);
      least = std::min(least, second * room * room * std::pow(std::abs(s), 2 - epsilon) / (epsilon - 1));
    }
    const bool accepted = refusal([&] { Superovoid(Vector3(3, 2, 1), delta, epsilon, x, y); }).empty();
    (accepted ? convex : refused) += 1;
    // The scan is coarse: within 5 % of the limit it proves nothing.
    if (least < -0.05) CHECK_MESSAGE(!accepted, "delta ", delta, " epsilon ", epsilon, " tapers ", x, " ", y, " least ", least);
    if (least > 0.05) CHECK_MESSAGE(accepted, "delta ", delta, " epsilon ", epsilon, " tapers ", x, " ", y, " least ", least);
  }
  CHECK(convex > draws(50));
  CHECK(refused > 50);
}
