#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <tuple>

#include "model/distance.hpp"

using namespace fit;

namespace {

/// The body with one number changed by `step`, in the order of Parameter.
Body varied(const Body& body, int parameter, double step) {
  Body result = body;
  if (parameter < kRotation) {
    result.position[parameter] += step;
  } else if (parameter < kLogAxes) {
    result.orientation = body.orientation * Eigen::Quaterniond(Eigen::AngleAxisd(step, Vector3::Unit(parameter - kRotation)));
  } else if (parameter < kLogDelta) {
    result.half_axes[parameter - kLogAxes] *= std::exp(step);
  } else if (parameter == kLogDelta) {
    result.delta = 1 + (body.delta - 1) * std::exp(step);
  } else if (parameter == kLogEpsilon) {
    result.epsilon = 1 + (body.epsilon - 1) * std::exp(step);
  } else {
    result.taper += step;
  }
  return result;
}

}  // namespace

TEST_CASE("the gradient of the distance agrees with finite differences") {
  const Eigen::Quaterniond orientation = Eigen::Quaterniond(0.7, 0.3, -0.2, 0.5).normalized();
  for (const auto& [family, delta, epsilon, taper] : {std::tuple{Family::Superellipsoid, 2.5, 4.0, 0.0},
                                                      {Family::Superellipsoid, 1.4, 1.8, 0.0},
                                                      {Family::Superovoid, 3.0, 2.2, -0.3},
                                                      {Family::Superovoid, 1.7, 5.0, 0.2}}) {
    const Body body{family, {0.3, -0.2, 0.5}, orientation, {1.5, 1.1, 0.8}, delta, epsilon, taper};
    const DistanceFunction function(body);
    for (int k = 0; k < 20; ++k) {
      // Around the body, inside and outside.
      const double radius = k % 2 == 0 ? 1.6 : 0.9;
      const Vector3 x = body.position + radius * Vector3(std::cos(k), std::sin(2.3 * k), std::cos(1.7 * k + 1));
      const Gradient gradient = function.gradient(function.find(x).value());
      for (int i = 0; i < (family == Family::Superovoid ? kParameters : kTaper); ++i) {
        constexpr double kStep = 1e-5;
        const double above = DistanceFunction(varied(body, i, kStep)).find(x)->distance;
        const double below = DistanceFunction(varied(body, i, -kStep)).find(x)->distance;
        CAPTURE(k);
        CAPTURE(i);
        CHECK(gradient[i] == doctest::Approx((above - below) / (2 * kStep)).epsilon(1e-5).scale(1));
      }
    }
  }
}

TEST_CASE("boundary points have the distance 0, and their derivatives agree with finite differences") {
  for (const auto& [delta, epsilon, taper] : {std::tuple{2.5, 4.0, 0.0}, {1.01, 1.01, 0.0}, {20.0, 12.0, 0.0}, {1.7, 5.0, 0.2}}) {
    const Body body{Family::Superovoid, Vector3::Zero(), Eigen::Quaterniond::Identity(), {1.5, 1.1, 0.8}, delta, epsilon, taper};
    const DistanceFunction function(body);
    for (int k = 0; k < 20; ++k) {
      const Vector3 u = k == 0 ? Vector3::UnitZ() : Vector3(std::cos(k), std::sin(2.3 * k), std::cos(1.7 * k + 1)).normalized();
      PointDerivatives derivatives;
      CHECK(std::abs(function.find(boundary_point(body, u, &derivatives))->distance) < 1e-9);
      CHECK(derivatives.leftCols<kLogAxes>().isZero(0));
      for (int i = kLogAxes; i < kParameters; ++i) {
        constexpr double kStep = 1e-5;
        const Vector3 difference = boundary_point(varied(body, i, kStep), u) - boundary_point(varied(body, i, -kStep), u);
        CAPTURE(k);
        CAPTURE(i);
        CHECK((derivatives.col(i) - difference / (2 * kStep)).norm() < 1e-6);
      }
    }
  }
}

TEST_CASE("a point is inside the body exactly if its distance is negative") {
  const Body body{
      Family::Superovoid, {0.3, -0.2, 0.5}, Eigen::Quaterniond(0.7, 0.3, -0.2, 0.5).normalized(), {1.5, 1.1, 0.8}, 3, 4, -0.3};
  const DistanceFunction function(body);
  int inside = 0;
  for (int k = 0; k < 500; ++k) {
    const Vector3 x = body.position + 1.5 * Vector3(std::cos(k), std::sin(2.3 * k), std::cos(1.7 * k + 1));
    CHECK(function.contains(x) == (function.find(x)->distance < 0));
    inside += function.contains(x) ? 1 : 0;
  }
  CHECK(inside > 50);
  CHECK(inside < 450);
}

TEST_CASE("noise moves points out of a sphere by its variance over the radius") {
  const Body sphere{Family::Ellipsoid, Vector3::Zero(), Eigen::Quaterniond::Identity(), Vector3::Constant(2), 2, 2, 0};
  const DistanceFunction function(sphere);
  const Witness witness = function.find({2, 0, 0}).value();
  // E|x| - R = sigma^2/R + O(sigma^4) for three normal coordinates of standard deviation sigma.
  CHECK(noise_offset(function, witness, 0.01) == doctest::Approx(1e-4 / 2).epsilon(1e-4));
}
