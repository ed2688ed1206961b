// The reported error where the model of the gap function says too little: cases that the soak program found.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>

#include "relative.hpp"
#include "shapes/without_hessian.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/solvers/gap_function.hpp"
#include "supernormal/solvers/solve.hpp"

using namespace supernormal;
using supernormal::test::without_hessian;

namespace {

double gap_at(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2, const Vector3& n) {
  GapFunction gap(shape1, pose1, shape2, pose2);
  GapJet jet;
  gap.evaluate(pose1.rotation.transpose() * n, Order::Value, jet);
  return jet.s;
}

}  // namespace

// Both have their sharpest vertex there: s = -depth cos(turn), and no curvature that a program's functions would show.
TEST_CASE("vertex in vertex without Hessians: the normal between is a minimum, and the reported error covers the hill around it") {
  const auto sharp1 = std::make_shared<Superellipsoid>(Vector3(1.1, 0.635, 0.75), 1.108, 1.143);
  const Superellipsoid body1(*sharp1);
  const CallbackShape body2 = without_hessian(std::make_shared<Superellipsoid>(Vector3(0.529, 1.3, 0.964), 1.162, 1.113));
  for (const double depth : {1e-10, 1e-9, 5e-9, 2e-8, 5e-8}) {
    const Pose pose2{Vector3(0, 0.635 + 1.3 - depth, 0), Matrix3::Identity()};
    const Proximity answer = find_proximity(body1, {}, body2, pose2, {});
    CAPTURE(depth);
    CHECK(answer.status == Status::Converged);
    for (int k = 0; k < 45; ++k) {
      const double turn = std::pow(0.7, k);
      for (int way = 0; way < 12; ++way) {
        const double angle = way * 0.5236;
        const Vector3 n = Vector3(turn * std::cos(angle), 1, turn * std::sin(angle)).normalized();
        REQUIRE(gap_at(body1, {}, body2, pose2, n) <= answer.gap + answer.error + 1e-16);
      }
    }
  }
}

// Both are turned by a millionth from one another. The flat top has an infinite curvature beside which the first steps end: the
// promised gain falls to nothing there, and rises again on the other side.
TEST_CASE("apex on a flat top: a step that ends beside infinite curvature is no convergence") {
  const Superellipsoid apex(Vector3(0.611306, 1.00865, 0.507747), 3.33016, 1.31775);
  const Superellipsoid top(Vector3(0.658949, 1.03858, 0.716509), 1.33293, 3.87141);
  const Vector3 n(-6.1304644873200358e-07, -7.8583620252973426e-08, 1);
  const Pose pose2{Vector3(0.0043862700608445059, 5.6630166193835717e-05, 1.2252065452805536),
                   Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), n).toRotationMatrix()};
  const Proximity answer = find_proximity(apex, {}, top, pose2, {});
  CHECK(answer.status == Status::Converged);
  for (int i = -200; i <= 200; ++i) {
    for (int k = -40; k <= 40; ++k) {
      REQUIRE(gap_at(apex, {}, top, pose2, Vector3(1e-8 * i, 1e-8 * k, 1).normalized()) <= answer.gap + answer.error + 1e-15);
    }
  }
}

// Along a needle the curvature falls from step to step as fast as the slope: what is promised says nothing about what follows.
TEST_CASE("needles tip to tip: steps that grow are no convergence") {
  const Superellipsoid needle(Vector3(1, 1e-4, 1e-4), 1.3, 1.3);
  Pose pose2{Vector3(1.1836731558009868, 0.081589419827538659, -0.97956557560407753), Matrix3::Identity()};
  pose2.rotation << 9, -32, -36, 4, -36, 33, -48, -9, -4;
  pose2.rotation /= 49;
  Settings settings;
  const Proximity exact = find_proximity(needle, {}, needle, pose2, settings);
  CHECK(exact.status == Status::Converged);
  for (const double tolerance : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    settings.tolerance = tolerance;
    const Proximity loose = find_proximity(needle, {}, needle, pose2, settings);
    CHECK(exact.gap <= loose.gap + loose.error + exact.error);
  }
}

// The rim has a boundary point for every such normal, 1e-12 beside that of the face: their cuts differ in the last digits.
TEST_CASE("on a cylinder's face from a normal beside it: the face's depth to rounding") {
  const Cylinder cylinder(1.104268465, 0.6836455581);
  const Superellipsoid body(Vector3(1.2002188, 0.70805422, 0.79908887), 15.2757819, 10.33515995);
  const Matrix3 R = Eigen::AngleAxisd(2.1, Vector3(0.3, -0.9, 0.4).normalized()).toRotationMatrix();
  const double height = body.support(-(R.transpose() * Vector3::UnitZ()));
  const Pose pose2{Vector3(0.1, -0.2, 0.6836455581 + height - 1.2e-5), R};
  Settings settings;
  settings.tolerance = 1e-15;
  const Proximity cold = find_proximity(cylinder, {}, body, pose2, settings);
  CHECK(cold.gap == test::relative(-1.2e-5).epsilon(1e-9));
  for (int k = 0; k < 35; ++k) {
    const double beside = 1e-14 * std::pow(1.7, k);
    for (int way = 0; way < 8; ++way) {
      const Vector3 first = Vector3(beside * std::cos(0.7 * way), beside * std::sin(0.7 * way), 1).normalized();
      const Proximity warm = find_proximity(cylinder, {}, body, pose2, settings, &first);
      REQUIRE(std::abs(warm.gap - cold.gap) <= warm.error + cold.error);
    }
  }
}

// Both are symmetric about the plane in which the normal climbs: it ends on a saddle, and has never seen a turn out of the plane.
TEST_CASE("vertices in a common plane of symmetry, one without a Hessian: the way out of the plane is looked at") {
  const Superellipsoid body1(Vector3(1.32053, 1.33285, 1.40549), 1.298, 1.236);
  const CallbackShape body2 =
      without_hessian(std::make_shared<Superellipsoid>(Vector3(0.596023, 0.555018, 0.950173), 1.1784, 1.1886));
  const Pose pose2{Vector3(0, 1.33285 + 0.555018 - 0.006, 0), Matrix3::Identity()};
  const Proximity answer = find_proximity(body1, {}, body2, pose2, {});
  CHECK(answer.status == Status::Converged);
  for (int k = 0; k < 45; ++k) {
    const Vector3 n = (answer.normal + std::pow(0.7, k) * Vector3::UnitZ()).normalized();
    REQUIRE(gap_at(body1, {}, body2, pose2, n) <= answer.gap + answer.error + 1e-16);
  }
}

// Seen from the needle's flat side the rim's curvature is overestimated to one side and to the other: without the cuts the normal
// zigzags down to that of the cap, 1e-6 beside the maximum.
TEST_CASE("needle across a cylinder's rim: steps that stay as long as the last are no convergence") {
  const Cylinder cylinder(2.7598075274203726, 0.41336571351567486);
  const Superellipsoid needle(Vector3(0.80612899117088677, 0.14950435281593677, 0.067824181045325865), 5.8889, 50.876);
  const Pose pose2{Vector3(0.0105, -2.8766, -0.41336571351567486 - 0.067824181045325865 - 5.7e-7), Matrix3::Identity()};
  const Proximity answer = find_proximity(cylinder, {}, needle, pose2, {});
  CHECK(answer.status == Status::Converged);
  for (int k = 0; k < 60; ++k) {
    const Vector3 n = Vector3(0, -1e-3 * std::pow(0.7, k), -1).normalized();
    REQUIRE(gap_at(cylinder, {}, needle, pose2, n) <= answer.gap + answer.error + 1e-15);
  }
}

// The azimuth of a point that is 1e-312 m off the axis: dividing by that overflows.
TEST_CASE("next to nothing beside a cylinder's axis: the depth along the axis") {
  const Cylinder cylinder(1, 1.077920734531224);
  const Superellipsoid body(Vector3(1.486, 0.68, 1.317), 1.268, 1.151);
  const Pose pose2{Vector3(0, -2e-312, -1.077920734531224 - 1.317 + 1e-3), Matrix3::Identity()};
  const Proximity answer = find_proximity(body, {}, cylinder, pose2, {});
  CHECK(answer.status == Status::Converged);
  CHECK(answer.gap == test::relative(-1e-3).epsilon(1e-12));
}

// A face normal of the box whose nearest corner is exactly on the vertex: the other corners do not hold the normal there.
TEST_CASE("a box's corner exactly on a vertex: the normal between them is a minimum") {
  const Superellipsoid body(Vector3(0.520313, 0.775239, 1.29591), 1.0616, 1.0239);
  const Box box(Vector3(0.8265, 1.3193, 0.51));
  const Pose pose2{Vector3(0.8265, 1.3193, 0.51 + 1.29591 - 2.4e-4), Matrix3::Identity()};
  const Vector3 first = Vector3::UnitZ();
  const Proximity answer = find_proximity(box, {}, body, pose2, {}, &first);
  CHECK(answer.status == Status::Converged);
  for (int k = 0; k < 45; ++k) {
    const Vector3 n = (answer.normal + std::pow(0.7, k) * Vector3(0.55, 0.83, 0)).normalized();
    REQUIRE(gap_at(box, {}, body, pose2, n) <= answer.gap + answer.error + answer.global_error + 1e-15);
  }
}

// The radii of curvature vanish towards the normals of a tip, however fast the last step seemed to converge.
TEST_CASE("needles tip to tip, roughly: two evaluations do not tell how far s rises") {
  const Superellipsoid needle(Vector3(1, 1e-4, 1e-4), 1.3, 1.3);
  Pose pose2{Vector3(1.183667999427793, 0.081650939054187716, -0.97954861724386533), Matrix3::Identity()};
  pose2.rotation << 9, -32, -36, 4, -36, 33, -48, -9, -4;
  pose2.rotation /= 49;
  const Proximity exact = find_proximity(needle, {}, needle, pose2, {});
  Settings settings;
  for (const double tolerance : {1e-5, 1e-4, 1e-3, 1e-2}) {
    settings.tolerance = tolerance;
    const Proximity loose = find_proximity(needle, {}, needle, pose2, settings);
    CHECK(exact.gap <= loose.gap + loose.error + exact.error);
  }
}
