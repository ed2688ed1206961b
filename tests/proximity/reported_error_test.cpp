// The reported error, which is a bound of bodies that are apart, touch, or overlap by less than the ball that rolls inside them,
// and the proved interval of deeper ones: pairs on which a local model of the gap function says too little.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>

#include "proximity/covers.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/relative.hpp"
#include "support/rotation_between.hpp"
#include "support/shape_samples.hpp"
#include "support/traps.hpp"
#include "support/without_hessian.hpp"

using namespace supernormal;
using supernormal::test::gap_at;
using supernormal::test::must_be_proved;
using supernormal::test::without_hessian;

namespace {

/// Apart, touching, or within the ball that rolls inside: such answers have converged to the maximum, which is proved.
void check_proved(const Proximity& answer) {
  CHECK(answer.status == Status::Converged);
  CHECK(answer.is_global);
}

}  // namespace

// Both have their sharpest vertex there: s = -depth cos(angle), and no curvature that a program's functions would show.
TEST_CASE("vertex in vertex without Hessians: the interval covers the maxima around the normal between, which is a minimum") {
  const auto sharp1 = std::make_shared<Superellipsoid>(Vector3(1.1, 0.635, 0.75), 1.108, 1.143);
  const Superellipsoid body1(*sharp1);
  const CallbackShape body2 = without_hessian(std::make_shared<Superellipsoid>(Vector3(0.529, 1.3, 0.964), 1.162, 1.113));
  for (const double depth : {1e-10, 1e-9, 5e-9, 2e-8, 5e-8}) {
    const Pose pose2{Vector3(0, 0.635 + 1.3 - depth, 0), Matrix3::Identity()};
    const Proximity answer = find_proximity(body1, {}, body2, pose2, {});
    CAPTURE(depth);
    if (must_be_proved(GapFunction(body1, {}, body2, pose2), {}, answer.gap)) check_proved(answer);
    for (int k = 0; k < 45; ++k) {
      const double turn = std::pow(0.7, k);
      for (int way = 0; way < 12; ++way) {
        const double angle = way * 0.5236;
        const Vector3 n = Vector3(turn * std::cos(angle), 1, turn * std::sin(angle)).normalized();
        REQUIRE(gap_at(body1, {}, body2, pose2, n) <= answer.gap + answer.global_error + 1e-16);
      }
    }
  }
}

// They are rotated by a millionth from each other.
TEST_CASE("apex on a flat top, apart: the error covers every normal around, beside which the curvature is infinite") {
  const Superellipsoid apex(Vector3(0.611306, 1.00865, 0.507747), 3.33016, 1.31775);
  const Superellipsoid top(Vector3(0.658949, 1.03858, 0.716509), 1.33293, 3.87141);
  const Vector3 n(-6.1304644873200358e-07, -7.8583620252973426e-08, 1);
  const Pose pose2{Vector3(0.0043862700608445059, 5.6630166193835717e-05, 1.2252065452805536),
                   test::rotation_between(Vector3::UnitZ(), n).toRotationMatrix()};
  const Proximity answer = find_proximity(apex, {}, top, pose2, {});
  check_proved(answer);
  for (int i = -200; i <= 200; ++i) {
    for (int k = -40; k <= 40; ++k) {
      REQUIRE(gap_at(apex, {}, top, pose2, Vector3(1e-8 * i, 1e-8 * k, 1).normalized()) <= answer.gap + answer.error + 1e-15);
    }
  }
}

// Along a needle the curvature falls from step to step as fast as the slope, and vanishes towards the normals of a tip. The first
// step of the last pair turns by 0.6 radians.
TEST_CASE("needles tip to tip, apart: what a rough answer reports covers what an exact one finds") {
  const Superellipsoid needle(Vector3(1, 1e-4, 1e-4), 1.3, 1.3);
  Matrix3 rotation;
  rotation << 9, -32, -36, 4, -36, 33, -48, -9, -4;
  rotation /= 49;
  const Matrix3 other = Eigen::Quaterniond(-0.3030032323743363, 0.7070555157317914, -0.20201529605587054, -0.606177662903718)
                            .normalized()
                            .toRotationMatrix();
  for (const Pose& pose2 : {Pose{{1.1836731558009868, 0.081589419827538659, -0.97956557560407753}, rotation},
                            Pose{{1.183667999427793, 0.081650939054187716, -0.97954861724386533}, rotation},
                            Pose{{1.1836648306002431, 0.081643334851451546, -0.9796003455933715}, other}}) {
    const Proximity exact = find_proximity(needle, {}, needle, pose2);
    check_proved(exact);
    for (const double tolerance : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
      const Proximity rough = find_proximity(needle, {}, needle, pose2, {.tolerance = tolerance});
      check_proved(rough);
      CHECK(exact.gap <= rough.gap + rough.error + exact.error);
    }
  }
}

// The edge has a boundary point for every such normal, 1e-12 beside the face's: their cuts differ in the last digits.
TEST_CASE("on a cylinder's face from a normal beside it: the face's depth to rounding") {
  const Cylinder cylinder(1.104268465, 0.6836455581);
  const Superellipsoid body(Vector3(1.2002188, 0.70805422, 0.79908887), 15.2757819, 10.33515995);
  const Matrix3 R = Eigen::AngleAxisd(2.1, Vector3(0.3, -0.9, 0.4).normalized()).toRotationMatrix();
  const double height = body.support(-(R.transpose() * Vector3::UnitZ()));
  const Pose pose2{Vector3(0.1, -0.2, 0.6836455581 + height - 1.2e-5), R};
  const Settings settings{.tolerance = 1e-15};
  const Proximity cold = find_proximity(cylinder, {}, body, pose2, settings);
  check_proved(cold);
  CHECK(cold.gap == test::relative(-1.2e-5).epsilon(1e-9));
  for (int k = 0; k < 35; ++k) {
    const double beside = 1e-14 * std::pow(1.7, k);
    for (int way = 0; way < 8; ++way) {
      const Vector3 first = Vector3(beside * std::cos(0.7 * way), beside * std::sin(0.7 * way), 1).normalized();
      const Proximity warm = find_proximity(cylinder, {}, body, pose2, settings, &first);
      check_proved(warm);
      REQUIRE(std::abs(warm.gap - cold.gap) <= warm.error + cold.error);
    }
  }
}

// Seen from the needle's flat side the edge's curvature is overestimated to one side and to the other; the maximum is 1e-6 beside
// the normal of the cap.
TEST_CASE("needle across a cylinder's edge, apart: the error covers the normals between the cap's and the maximum") {
  const Cylinder cylinder(2.7598075274203726, 0.41336571351567486);
  const Superellipsoid needle(Vector3(0.80612899117088677, 0.14950435281593677, 0.067824181045325865), 5.8889, 50.876);
  const Pose pose2{Vector3(0.0105, -2.8766, -0.41336571351567486 - 0.067824181045325865 - 5.7e-7), Matrix3::Identity()};
  const Proximity answer = find_proximity(cylinder, {}, needle, pose2, {});
  check_proved(answer);
  for (int k = 0; k < 60; ++k) {
    const Vector3 n = Vector3(0, -1e-3 * std::pow(0.7, k), -1).normalized();
    REQUIRE(gap_at(cylinder, {}, needle, pose2, n) <= answer.gap + answer.error + 1e-15);
  }
}

// The azimuth of a point that is 1e-312 m off the axis: a division by that overflows.
TEST_CASE("next to nothing beside a cylinder's axis: the depth along the axis") {
  const Cylinder cylinder(1, 1.077920734531224);
  const Superellipsoid body(Vector3(1.486, 0.68, 1.317), 1.268, 1.151);
  const Pose pose2{Vector3(0, -2e-312, -1.077920734531224 - 1.317 + 1e-3), Matrix3::Identity()};
  const Proximity answer = find_proximity(body, {}, cylinder, pose2, {});
  CHECK(answer.gap == test::relative(-1e-3).epsilon(1e-12));
}

// The nearest vertex of the box's face is exactly on the tip, and the other vertices have zero multipliers there.
TEST_CASE("a box's vertex exactly on a tip: the interval covers the maxima around the normal between them, which is a minimum") {
  const Superellipsoid body(Vector3(0.520313, 0.775239, 1.29591), 1.0616, 1.0239);
  const Box box(Vector3(0.8265, 1.3193, 0.51));
  const Pose pose2{Vector3(0.8265, 1.3193, 0.51 + 1.29591 - 2.4e-4), Matrix3::Identity()};
  const Vector3 first = Vector3::UnitZ();
  const Proximity answer = find_proximity(box, {}, body, pose2, {}, &first);
  for (int k = 0; k < 45; ++k) {
    const Vector3 n = (answer.normal + std::pow(0.7, k) * Vector3(0.55, 0.83, 0)).normalized();
    REQUIRE(gap_at(box, {}, body, pose2, n) <= answer.gap + answer.global_error + 1e-15);
  }
}

// The gain of a step to a normal 1e-160 away: a division of the next one by that would overflow.
TEST_CASE("next to nothing beside a plane of symmetry: no overflow") {
  const Superellipsoid body1(Vector3(0.50084521668798021, 0.8799530275640064, 1.3617083385272106), 1.0256029248035792,
                             1.0772194785899689);
  const CallbackShape body2 = without_hessian(std::make_shared<Superellipsoid>(
      Vector3(0.94171784691969096, 0.5574478084197092, 1.2885276416047349), 1.175895557386629, 1.1777243209332211));
  const Settings settings{.tolerance = 1e-15};
  const test::Traps traps("a body without a Hessian");
  const Proximity answer =
      find_proximity(body1, {}, body2, {Vector3(-1.0730493914807038, 2.0703247356784026e-162, 0), Matrix3::Identity()}, settings);
  CHECK(answer.gap < 0);
}

TEST_CASE("a ball deep in a ball a thousand times its size: what rounding says of the error is no less than 0") {
  const Sphere small(1), large(1000);
  for (int k = 0; k < 100; ++k) {
    const Eigen::Quaterniond turn(0.9 - 0.017 * k, 0.3, -0.5 + 0.01 * k, 0.2);
    const Pose pose2{{0.1, 1.7, -0.9}, turn.normalized().toRotationMatrix()};
    const Proximity answer = find_proximity(small, {}, large, pose2, {});
    check_proved(answer);
    CHECK(answer.error >= GapFunction(small, {}, large, pose2).rounding());
    CHECK(answer.global_error >= answer.error);
  }
}

// The vertices that are near the normal tell of nothing more to gain; there is, a quarter of a radian away.
TEST_CASE("a box beside an edge of another one a million times as large, apart by next to nothing: what is claimed holds") {
  const Box large(Vector3(0x1.4283cd0da587cp-13, 0x1.b15e815497b9fp-10, 0x1.c496c7d07f13bp-13));
  const Rounded small(std::make_shared<Box>(Vector3(0x1.e9191175c41d6p-31, 0x1.37aaccef9e8e2p-29, 0x1.0bc78d47a46ebp-33)),
                      0x1.6d324f1074326p-49);
  const Pose pose1{Vector3(-0x1.b6404e4667d57p-12, -0x1.f57eee091f7f6p-14, 0x1.488d820e4ff09p-21), Matrix3::Identity()};
  Pose pose2{Vector3(-0x1.14fea4e2b7427p-12, -0x1.d0b6972a84749p-10, 0x1.c5df660f1b4ep-13), Matrix3::Identity()};
  pose2.rotation << -1, -0x1.ea620b47291a6p-31, 0x1.66563bddc833cp-30, 0x1.ea620b47291a6p-31, -1, 0x1.2d7f90bde592dp-28,
      0x1.66563bddc833cp-30, 0x1.2d7f90bde592dp-28, 1;
  const Proximity answer = find_proximity(large, pose1, small, pose2);
  GapFunction gap(large, pose1, small, pose2);
  GapJet jet;
  gap.evaluate(Vector3(2.93676e-11, -0.400022, 0.916505).normalized(), Order::Value, jet);
  CHECK(jet.s > gap.rounding());
  CHECK(jet.s - gap.rounding() <= answer.gap + answer.global_error);
}

TEST_CASE("a box in a flat body, aligned but for rounding: the gap belongs to the normal") {
  const Box box({0.0637, 0.6113, 2.1592});
  const Superellipsoid flat({4.2668, 1.3804, 0.1145}, 41, 97);
  double tilt = 1e-16;
  for (const Vector3& axis : test::random_normals(400, 91)) {
    tilt = tilt < 1e-10 ? 1.1 * tilt : 1e-16;
    const Pose pose{1e-9 * axis, Eigen::AngleAxisd(tilt, axis).toRotationMatrix()};
    const Proximity out = find_proximity(flat, {}, box, pose);
    GapFunction gap(flat, {}, box, pose);
    GapJet jet;
    gap.evaluate(out.normal, Order::Value, jet);
    CHECK(std::abs(jet.s - out.gap) <= gap.rounding());
  }
}
