// Tests of tapered superellipsoids: on the surface, on the supporting plane, derivatives, mass.
#include "supernormal/shapes/superovoid.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <memory>
#include <numbers>

#include "shapes/mass_properties.hpp"
#include "shapes/superovoid_convexity.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "support/draw.hpp"
#include "support/relative.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

using Real = long double;

std::string text(const Superovoid& shape) {
  std::ostringstream out;
  out << "half-axes " << test::text(shape.half_axes()) << " delta " << shape.delta() << " epsilon " << shape.epsilon() << " tapers "
      << shape.taper_x() << " " << shape.taper_y();
  return out.str();
}

/// Both tapers as shares of the largest.
struct Tapers {
  double x, y;
};

/// Superovoids of all exponents up to `max_exponent`, with different tapers where that is convex.
std::vector<Superovoid> superovoids(double min_exponent, double max_exponent, const std::vector<Tapers>& tapers) {
  std::vector<Superovoid> shapes;
  for (const Vector3& half_axes : {Vector3(3, 2, 1), Vector3(0.02, 1, 0.3)}) {
    for (const double delta : {1.01, 1.3, 2.0, 2.4, 7.5, 50.0, 200.0, 1000.0}) {
      for (const double epsilon : {1.01, 1.3, 1.8, 2.0, 2.4, 7.5, 50.0, 200.0, 1000.0}) {
        if (std::min(delta, epsilon) < min_exponent || std::max(delta, epsilon) > max_exponent) continue;
        const double largest = Superovoid::max_taper(epsilon);
        for (const Tapers& share : tapers) {
          const double x = share.x * largest, y = share.y * largest;
          if (x != y && (epsilon > 2 || least_convex(delta, epsilon, x, y).margin < 0.01 * (epsilon - 1))) continue;
          shapes.emplace_back(half_axes, delta, epsilon, x, y);
        }
      }
    }
  }
  return some_of(shapes);
}

const std::vector<Tapers> kTapers = {{0.3, 0.3}, {-0.9, -0.9}, {1, 1}, {0.5, -0.2}, {0, 0.7}};

/// The left side of the implicit equation, in extended precision.
Real implicit(const Superovoid& shape, const Vector3& point) {
  const Real z = Real{point.z()} / Real{shape.half_axes().z()};
  const Real x = std::abs(Real{point.x()}) / (Real{shape.half_axes().x()} * (1 + Real{shape.taper_x()} * z));
  const Real y = std::abs(Real{point.y()}) / (Real{shape.half_axes().y()} * (1 + Real{shape.taper_y()} * z));
  const Real delta = shape.delta(), epsilon = shape.epsilon();
  return std::pow(std::pow(x, delta) + std::pow(y, delta), epsilon / delta) + std::pow(std::abs(z), epsilon);
}

/// The gradient of the left side at a point off the coordinate planes, by central differences of the equation itself.
Vector3 implicit_gradient(const Superovoid& shape, const Vector3& point) {
  Vector3 gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const auto f = [&](double step) {
      return Vector3(static_cast<double>(implicit(shape, point + step * Vector3::Unit(axis))), 0, 0);
    };
    gradient[axis] = derivative(f, 0.02 / std::max(shape.delta(), shape.epsilon()) * std::abs(point[axis])).value.x();
  }
  return gradient;
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
  for (const Superovoid& shape : superovoids(1.02, 200, kTapers)) {
    for (const Vector3& n : normals) {
      const double residual = static_cast<double>(std::abs(implicit(shape, shape.point(n)) - 1));
      if (!(residual <= 1e-12)) FAIL_CHECK(text(shape), " n ", test::text(n), " residual ", residual);
    }
  }
}

TEST_CASE("superovoid: h is the largest width over all heights, r lies in the supporting plane") {
  int checked = 0;
  for (const Superovoid& shape : superovoids(1.01, 1000, kTapers)) {
    const double size = shape.half_axes().sum();
    for (const Vector3& n : random_normals(draws(4), 2)) {
      const Jet jet = shape.jet(n);
      const double expected = slow_support(shape, n);
      ++checked;
      if (!(std::abs(jet.h - expected) <= 1e-14 * size)) {
        FAIL_CHECK(text(shape), " n ", test::text(n), " h ", jet.h, " expected ", expected);
      }
    }
    for (const Vector3& n : all_normals(10, 3)) {
      const Jet jet = shape.jet(n);
      if (!(std::abs(n.dot(jet.r) - jet.h) <= 8e-15 * size)) {
        FAIL_CHECK(text(shape), " n ", test::text(n), " n.r ", n.dot(jet.r), " h ", jet.h);
      }
      CHECK(shape.support(n) == jet.h);
      CHECK(shape.point(n) == jet.r);
    }
  }
  CHECK(checked > draws(300));
}

TEST_CASE("superovoid: no point of the boundary lies outside a supporting plane") {
  const std::vector<Vector3> normals = all_normals(40, 4);
  for (const Superovoid& shape : superovoids(1.01, 1000, kTapers)) {
    std::vector<Vector3> points;
    points.reserve(normals.size());
    for (const Vector3& n : normals) points.push_back(shape.point(n));
    for (const Vector3& n : random_normals(15, 5)) {
      const double h = shape.support(n);
      for (const Vector3& point : points) {
        if (!(n.dot(point) <= h + 8e-15 * shape.half_axes().sum())) FAIL_CHECK(text(shape), " n ", test::text(n));
      }
    }
  }
}

TEST_CASE("superovoid: the normal is the gradient of the implicit equation") {
  int checked = 0;
  for (const Superovoid& shape : superovoids(1.3, 7.5, kTapers)) {
    for (const Vector3& n : random_normals(20, 6)) {
      const Vector3 r = shape.point(n);
      const Vector3 share = r.cwiseQuotient(shape.half_extents()).cwiseAbs();
      if (share.minCoeff() < 0.05) continue;  // too narrow for a difference
      ++checked;
      const double angle = (implicit_gradient(shape, r).normalized() - n).norm();
      if (!(angle <= 1e-9)) FAIL_CHECK(text(shape), " n ", test::text(n), " differs by ", angle);
    }
  }
  CHECK(checked > draws(1500));
}

TEST_CASE("superovoid: H is the derivative of r, r the derivative of h") {
  int checked = 0, undecided = 0;
  for (const Superovoid& shape : superovoids(1.01, 1000, {{0.3, 0.3}, {-0.9, -0.9}, {0.5, -0.2}, {0, 0.7}})) {
    for (const Vector3& n : random_normals(8, 7)) {
      if (n.cwiseAbs().minCoeff() < 0.03) continue;
      const Jet jet = shape.jet(n);
      for (const Vector3& t : tangents(n)) {
        const auto turned = [&](double angle) -> Vector3 { return std::cos(angle) * n + std::sin(angle) * t; };
        const double room = 0.2 * std::asin(n.cwiseAbs().minCoeff());
        const Derivative gradient = derivative([&](double angle) { return Vector3(shape.support(turned(angle)), 0, 0); }, room);
        const Derivative bend = derivative([&](double angle) { return shape.point(turned(angle)); }, room);
        const double size = jet.r.norm(), bend_size = (jet.H * t).norm() + size;
        if (gradient.error > 1e-8 * size || bend.error > 1e-7 * bend_size) {
          ++undecided;
          continue;
        }
        ++checked;
        const double miss = std::abs(gradient.value.x() - t.dot(jet.r)), bend_miss = (bend.value - jet.H * t).norm();
        if (!(miss <= 10 * gradient.error + 1e-9 * size && bend_miss <= 10 * bend.error + 1e-8 * bend_size)) {
          FAIL_CHECK(text(shape), " n ", test::text(n), " r by ", miss, " H by ", bend_miss, " of ", bend_size);
        }
      }
    }
  }
  CHECK(checked > draws(3000));
  CHECK(undecided < checked / 10);
}

TEST_CASE("superovoid: H is symmetric, has the normal in its kernel and no negative radius") {
  for (const Superovoid& shape : superovoids(1.01, 1000, kTapers)) {
    for (const Vector3& n : all_normals(20, 8)) {
      const Matrix3 hessian = shape.jet(n).H;
      const double largest = hessian.cwiseAbs().maxCoeff();
      if (largest < 1e-290) continue;
      const Matrix3 H = hessian / largest;
      const double minor_xy = H(0, 0) * H(1, 1) - H(0, 1) * H(0, 1);
      const double minor_yz = H(1, 1) * H(2, 2) - H(1, 2) * H(1, 2);
      const double minor_zx = H(2, 2) * H(0, 0) - H(0, 2) * H(0, 2);
      const bool positive = H.diagonal().minCoeff() >= 0 && std::min({minor_xy, minor_yz, minor_zx}) >= -8e-15;
      if (!(H == H.transpose() && (H * n).norm() <= 1e-14 && positive)) {
        FAIL_CHECK(text(shape), " n ", test::text(n), " |H n| ", (H * n).norm(), " minors ", minor_xy, " ", minor_yz, " ",
                   minor_zx);
      }
    }
  }
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
        FAIL_CHECK(test::text(straight), " n ", test::text(n), " h ", a.h - b.h, " r ", (a.r - b.r).norm(), " H ",
                   (a.H - b.H).norm(), " of ", hessian_size);
      }
    }
    const MassProperties a = shape.mass_properties(), b = straight.mass_properties();
    CHECK(a.volume == relative(b.volume).epsilon(1e-14));
    CHECK((a.second_moment - b.second_moment).norm() <= 1e-13 * b.second_moment.norm());
    CHECK(a.centroid == Vector3(0, 0, 0));
  }
}

TEST_CASE("superovoid: opposite tapers put it upside down; x and y may be exchanged") {
  for (const Superovoid& shape : superovoids(1.01, 1000, kTapers)) {
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

TEST_CASE("superovoid: the advanced normal of a step of 0 is the normal, of a small step n + dn") {
  for (const Superovoid& shape : superovoids(1.01, 1000, {{0.3, 0.3}, {-0.9, -0.9}, {0.5, -0.2}, {0, 0.7}})) {
    const double exponent = std::max(shape.delta(), shape.epsilon());
    for (const Vector3& n : random_normals(20, 11)) {
      if (n.cwiseAbs().minCoeff() < 0.1) continue;
      const Jet jet = shape.jet(n);
      const double back = (shape.advance_normal(n, jet, Vector3::Zero()).normalized() - n).norm();
      if (!(back <= 1e-14 * exponent)) FAIL_CHECK(text(shape), " n ", test::text(n), " back to ", back);
      for (const Vector3& t : tangents(n)) {
        const auto deviation = [&](double step) {
          return (shape.advance_normal(n, jet, step * t).normalized() - (n + step * t).normalized()).norm();
        };
        // The deviation is of second order: a tenth of the step deviates a hundredth as much.
        const double coarse = deviation(1e-4), fine = deviation(1e-5);
        if (!(fine <= coarse / 50 + 1e-14 * exponent + 1e-14)) {
          FAIL_CHECK(text(shape), " n ", test::text(n), " deviations ", coarse, " ", fine);
        }
      }
    }
  }
}

TEST_CASE("superovoid: finite everywhere, without floating-point exceptions") {
  constexpr int kTrapped = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;
  const auto check = [&](const Superovoid& shape) {
    for (const Vector3& n : all_normals(10, 12)) {
      std::feclearexcept(kTrapped);
      const Jet jet = shape.jet(n);
      const Vector3 advanced = shape.advance_normal(n, jet, 1e-3 * tangents(n)[0]);
      const bool finite = std::isfinite(jet.h) && jet.r.allFinite() && jet.H.allFinite() && advanced.allFinite();
      if (std::fetestexcept(kTrapped) != 0 || !finite || !(advanced.norm() > 0)) {
        FAIL_CHECK(text(shape), " n ", test::text(n), " exceptions ", std::fetestexcept(kTrapped));
      }
    }
  };
  for (const Superovoid& shape : superovoids(1.01, 1000, kTapers)) check(shape);
  for (const Vector3& axes :
       {Vector3(1e-30, 1e-30, 1e-30), Vector3(1e30, 1e30, 1e30), Vector3(1e30, 1, 1e-30), Vector3(1, 1e4, 1e-4)}) {
    for (const double exponent : {1.01, 1.5, 2.0, 5.0, 1000.0}) {
      const double taper = 0.7 * Superovoid::max_taper(exponent);
      check(Superovoid(axes, exponent, exponent, taper, taper));
    }
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
  for (const Superovoid& shape : superovoids(1.01, 1000, kTapers)) {
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
