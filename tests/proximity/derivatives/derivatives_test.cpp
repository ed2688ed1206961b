// Derivatives of the gap, the common normal and the witness points. The program `derivatives` compares more pairs.
#include "supernormal/proximity/derivatives.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "proximity/derivatives/comparison.hpp"
#include "supernormal/proximity/plane.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/linear_image.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/shapes/superovoid.hpp"
#include "support/draw.hpp"
#include "support/rotation_between.hpp"
#include "support/traps.hpp"
#include "support/without_hessian.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

const Matrix3 kTilted = Eigen::Quaterniond(0.5, 0.1, -0.7, 0.2).normalized().toRotationMatrix();

ProximityDerivatives derivatives(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2) {
  const Proximity answer = find_proximity(shape1, pose1, shape2, pose2);
  const Traps traps("derivatives");
  return find_proximity_derivatives(shape1, pose1, shape2, pose2, answer);
}

bool is_finite(const ProximityDerivatives& d) {
  return d.gap_gradient.allFinite() && d.normal.allFinite() && d.point1.allFinite() && d.point2.allFinite() &&
         d.gap_hessian.allFinite();
}

}  // namespace

TEST_CASE("derivatives: random pairs of all classes agree with differences in long double") {
  DerivativePairs pairs(5);
  Tally tally;
  for (int k = 0; k < draws(64); ++k) compare(pairs.draw(), std::to_string(k), tally);
  CHECK_MESSAGE(tally.first_wrong.empty(), tally.first_wrong);
  CHECK(tally.not_finite == 0);
  CHECK(tally.unreferenced <= draws(3));
  for (const Tally::Figures& figures : tally.figures) {
    CHECK(figures.compared >= draws(55));
    CHECK(figures.wrong == 0);
  }
}

// The rates of 48 000 pairs: 2e-4 wrong, at kinks about 1e-6 rad away, and 2e-4 refused without need.
TEST_CASE("derivatives: where flat sides, faces and edges lie on one another, the gradient holds over 1e-6 rad or is refused") {
  DerivativePairs pairs(9);
  FlatTally tally;
  for (int k = 0; k < 1600; ++k) compare_flat(pairs.draw_flat(), std::to_string(k), tally);
  CHECK_MESSAGE(tally.wrong <= 1, tally.wrong_pairs);
  CHECK(tally.needless <= 3);
  CHECK(tally.defined > 1100);
  CHECK(tally.refused > 200);
}

// A step between two nearly flat sides may lead down. If Newton's method ends there, 13 of these pairs have no derivatives.
TEST_CASE("derivatives: of 6000 flat pairs whose query converges, all but some 6 have a common normal") {
  DerivativePairs pairs(5);
  const Settings settings{.tolerance = 1e-14};
  int without = 0;
  for (int k = 0; k < 6000; ++k) {
    const DerivativePair pair = pairs.draw_flat();
    const Shape &shape1 = *pair.shape1, &shape2 = *pair.shape2;
    const Proximity answer = find_proximity(shape1, pair.pose1, shape2, pair.pose2, settings);
    const ProximityDerivatives found = find_proximity_derivatives(shape1, pair.pose1, shape2, pair.pose2, answer);
    without += answer.status == Status::Converged && found.status == DerivativeStatus::NotConverged;
  }
  CHECK(without <= 9);
}

TEST_CASE("derivatives: two spheres have the closed forms of two points, up to a radius of 1e8 smaller ones") {
  for (const double radius : {0.5, 1e6, 1.6e7, 1.9e7, 2.9e7}) {
    CAPTURE(radius);
    const Sphere sphere1(radius), sphere2(0.3);
    const Vector3 n(2.0 / 3, 1.0 / 3, -2.0 / 3);
    const Pose pose2{(radius + 2.5) * n, kTilted};
    const ProximityDerivatives d = derivatives(sphere1, {}, sphere2, pose2);
    const double distance = pose2.position.norm();
    const Matrix3 tilt = (Matrix3::Identity() - n * n.transpose()) / distance;
    CHECK(d.status == DerivativeStatus::Smooth);
    CHECK((d.gap_gradient.segment<3>(6) - n).norm() <= 1e-15);
    CHECK(d.gap_gradient.segment<3>(9).norm() <= 1e-15);
    CHECK((d.normal.middleCols<3>(6) - tilt).norm() <= 1e-15 / distance);
    CHECK((d.point1.middleCols<3>(6) - radius * tilt).norm() <= 1e-15);
    CHECK((d.point2.middleCols<3>(6) - Matrix3::Identity() + 0.3 * tilt).norm() <= 1e-15);
    CHECK((d.gap_hessian.block<3, 3>(6, 6) - tilt).norm() <= 1e-15 / distance);
    CHECK(d.parameters1.size() == 1);
    CHECK(d.parameters1[0].value == -1);
  }
}

TEST_CASE("derivatives: the gradient alone has the digits of all derivatives, and their status") {
  DerivativePairs pairs(7);
  for (int k = 0; k < 640; ++k) {
    const DerivativePair pair = k % 2 == 0 ? pairs.draw() : pairs.draw_flat();
    const Shape &shape1 = *pair.shape1, &shape2 = *pair.shape2;
    const Proximity answer = find_proximity(shape1, pair.pose1, shape2, pair.pose2);
    const ProximityDerivatives all = find_proximity_derivatives(shape1, pair.pose1, shape2, pair.pose2, answer);
    const GapGradient found = find_gap_gradient(shape1, pair.pose1, shape2, pair.pose2, answer);
    CAPTURE(k);
    CHECK(found.gradient == all.gap_gradient);
    CHECK(found.status == all.status);
    CHECK(found.has_gap == all.has_gap);
    CHECK(found.evaluations == all.evaluations);
  }
}

// The reference is the explicit answer at moved bodies. Its second differences have an error of 1e-16/h^2 + h^2.
TEST_CASE("derivatives: a body and a plane have the derivatives of the explicit answer") {
  DerivativePairs pairs(8);
  int compared = 0;
  for (int k = 0; k < 320; ++k) {
    const DerivativePair pair = pairs.draw();
    const Shape& shape = *pair.shape1;
    const Vector3 normal = kTilted * pair.pose2.rotation.col(0);
    const double offset = normal.dot(pair.pose1.position) - 0.4;
    const auto answer_at = [&](const TwistVector& twist) {
      const auto rotation = [&](int w) {
        const Vector3 vector = twist.segment<3>(w);
        return vector.norm() > 0 ? Eigen::AngleAxisd(vector.norm(), vector.normalized()).toRotationMatrix()
                                 : Matrix3(Matrix3::Identity());
      };
      const Vector3 turned = rotation(9) * normal;
      return find_plane_proximity(shape, {pair.pose1.position + twist.segment<3>(0), rotation(3) * pair.pose1.rotation}, turned,
                                  offset + turned.dot(twist.segment<3>(6)));
    };
    const ProximityDerivatives d = find_plane_derivatives(shape, pair.pose1, normal, offset);
    CAPTURE(k);
    CAPTURE(pair.kind);
    REQUIRE(d.has_normal);
    CHECK(d.evaluations == 0);
    CHECK((d.common_normal + normal).norm() <= 1e-15);
    // The radius of curvature changes over a small angle.
    const double bend = d.point1.norm() / shape.half_extents().norm();
    if (bend > 30) continue;
    ++compared;
    const double h = 1e-5;
    for (int i = 0; i < 12; ++i) {
      const Proximity ahead = answer_at(h * TwistVector::Unit(i)), behind = answer_at(-h * TwistVector::Unit(i));
      const auto difference = [&](Vector3 Proximity::*member) { return Vector3((ahead.*member - behind.*member) / (2 * h)); };
      CHECK(std::abs((ahead.gap - behind.gap) / (2 * h) - d.gap_gradient[i]) <= 1e-8 * bend);
      CHECK((difference(&Proximity::normal) - d.normal.col(i)).norm() <= 1e-8);
      CHECK((difference(&Proximity::point1) - d.point1.col(i)).norm() <= 1e-4 * bend);
      CHECK((difference(&Proximity::point2) - d.point2.col(i)).norm() <= 1e-4 * bend);
    }
    const TwistVector direction = TwistVector::Constant(1 / std::sqrt(12));
    const double second = 1e-3;
    const double curvature =
        (answer_at(second * direction).gap - 2 * answer_at(TwistVector::Zero()).gap + answer_at(-second * direction).gap) /
        (second * second);
    CHECK(std::abs(direction.dot(d.gap_hessian.lazyProduct(direction)) - curvature) <= 1e-3 * bend * d.gap_hessian.norm());
  }
  CHECK(compared > 250);

  const Box box(Vector3(1, 2, 3));
  CHECK(find_plane_derivatives(box, {}, Vector3::UnitZ(), -4).status == DerivativeStatus::FreeOnFace);
  CHECK(find_plane_derivatives(box, {}, Vector3(0, 0.6, 0.8), -9).status == DerivativeStatus::FreeOnFace);
  const Cylinder can(1, 2);
  CHECK(find_plane_derivatives(can, {}, Vector3::UnitX(), -4).status == DerivativeStatus::FreeOnFace);
  CHECK(find_plane_derivatives(can, {}, Vector3::UnitZ(), -4).status == DerivativeStatus::FreeOnFace);
  CHECK(find_plane_derivatives(can, {}, Vector3(0, 0.6, 0.8), -4).status == DerivativeStatus::Smooth);
  const Superellipsoid brick(Vector3(1, 1, 1), 20, 20);
  CHECK(find_plane_derivatives(brick, {}, Vector3::UnitZ(), -4).status == DerivativeStatus::FreeOnFace);
  CHECK(find_plane_derivatives(box, {{std::nan(""), 0, 0}, kTilted}, Vector3::UnitZ(), -4).status ==
        DerivativeStatus::InvalidInput);
}

TEST_CASE("derivatives: their layout does not depend on the instructions that a program is compiled for") {
  CHECK(alignof(ProximityDerivatives) == alignof(double));  // Eigen aligns to a vector of the processor, if anything
}

TEST_CASE("derivatives: the status says what is not defined, and nothing is NaN") {
  const Box box(Vector3(1, 2, 3));
  const Superellipsoid sharp(Vector3(1, 1, 1), 1.01, 1.01), brick(Vector3(1, 1, 1), 200, 200);
  const Ellipsoid ellipsoid(Vector3(1, 2, 3));
  const auto status = [](const Shape& a, const Shape& b, const Pose& pose) {
    const ProximityDerivatives d = derivatives(a, {}, b, pose);
    CHECK(is_finite(d));
    const bool is_defined = d.status == DerivativeStatus::Smooth || d.status == DerivativeStatus::ActiveSet;
    CHECK(d.has_normal == is_defined);
    if (!d.has_normal) CHECK((d.normal.isZero(0) && d.point1.isZero(0) && d.gap_hessian.isZero(0)));
    return d.status;
  };
  CHECK(status(ellipsoid, ellipsoid, {{5, 4, 3}, kTilted}) == DerivativeStatus::Smooth);
  CHECK(status(box, ellipsoid, {{3, 0.2, 0.1}, kTilted}) == DerivativeStatus::ActiveSet);
  CHECK(status(box, box, {{2.5, 0.2, 0.3}, Matrix3::Identity()}) == DerivativeStatus::FreeOnFace);
  CHECK(status(brick, brick, {{0.1, 0.2, 2.1}, Matrix3::Identity()}) == DerivativeStatus::FreeOnFace);
  CHECK(status(ellipsoid, ellipsoid, {Vector3::Zero(), kTilted}) == DerivativeStatus::SeveralMaxima);
  CHECK(status(Superovoid({8, 3, 1}, 2.5, 2.4, 0.2, 0.2), Sphere(4), {}) == DerivativeStatus::SeveralMaxima);  // z and -z are alike
  CHECK(status(Sphere(1), Sphere(0.5), {Vector3::Zero(), kTilted}) == DerivativeStatus::SingularCurvature);
  CHECK(status(Sphere(0), Sphere(0), {Vector3::Zero(), kTilted}) != DerivativeStatus::Smooth);
  CHECK(status(without_hessian(std::make_shared<Ellipsoid>(Vector3(1, 2, 3))), ellipsoid, {{5, 4, 3}, kTilted}) ==
        DerivativeStatus::NoHessian);
  // The point of the sphere is above the border of the face.
  CHECK(status(box, Sphere(0.5), {{2, 2, 0}, Matrix3::Identity()}) == DerivativeStatus::Degenerate);

  Pose broken;
  broken.position.x() = std::numeric_limits<double>::quiet_NaN();
  const Proximity answer = find_proximity(ellipsoid, {}, sharp, {{4, 0, 0}, kTilted});
  CHECK(find_proximity_derivatives(ellipsoid, broken, sharp, {}, answer).status == DerivativeStatus::InvalidInput);
  CHECK(find_proximity_derivatives(ellipsoid, {}, sharp, {}, {}).status == DerivativeStatus::InvalidInput);
  CHECK(find_gap_gradient(ellipsoid, {}, sharp, {}, {}).gradient.isZero(0));
  CHECK(find_gap_gradient(ellipsoid, broken, sharp, {}, answer).status == DerivativeStatus::InvalidInput);
  const Proximity apart = find_proximity(ellipsoid, {}, sharp, {{9, 3, 0}, kTilted}, {.stop_when_apart = true});
  CHECK(apart.status == Status::Apart);
  CHECK(find_proximity_derivatives(ellipsoid, {}, sharp, {{9, 3, 0}, kTilted}, apart).status == DerivativeStatus::NotConverged);
}

// The boundary point of a flat side jumps across it as the bodies rotate, so the gap has a kink. Where the partner is round, or the
// side is flat at one point only, it has none.
// All normals of the vertex or edge have the same gap, up to rounding.
TEST_CASE("derivatives: a capsule whose end is centred on a vertex or an edge of a box has no derivatives, on a face it has") {
  Draw draw(1);
  for (int k = 0; k < 600; ++k) {
    const int free = k % 3;  // coordinates of the point on the box
    const double size = draw.log_uniform(1e-3, 10);
    const Vector3 half = size * draw.within(0.05, 1);
    const Pose pose1{size * draw.direction(), draw.rotation()};
    Vector3 point = half, axis = draw.direction();
    for (int i = 0; i < free; ++i) point[i] *= draw.uniform(-0.9, 0.9);
    axis.tail(3 - free) = axis.tail(3 - free).cwiseAbs();  // the capsule leaves the box
    const double radius = size * draw.uniform(0.01, 0.3), half_length = size * draw.uniform(0.1, 1);
    const Pose pose2{pose1.position + pose1.rotation * (point + half_length * axis),
                     test::rotation_between(Vector3::UnitZ(), pose1.rotation * axis).toRotationMatrix()};
    const ProximityDerivatives found = derivatives(Box(half), pose1, Capsule(radius, half_length), pose2);
    CAPTURE(k);
    CHECK(found.status == (free == 2 ? DerivativeStatus::ActiveSet : DerivativeStatus::SingularCurvature));
    CHECK(found.has_gap == (free == 2));
  }
}

// Two vertices of a face have all the weight of a point on its diagonal. The closed form on a face: the normal rotates with it.
TEST_CASE("derivatives: above the middle of a box's face, and on its diagonals, all is defined") {
  const Box box(Vector3(1, 2, 3));
  const Sphere ball(0.5);
  const Ellipsoid ellipsoid(Vector3(0.5, 0.4, 0.3));
  for (const Shape* shape : {static_cast<const Shape*>(&ball), static_cast<const Shape*>(&ellipsoid)}) {
    for (const Vector3& position : {Vector3(0, 0, 4), Vector3(0.5, 1, 4), Vector3(1.3, 0, 0), Vector3(0.9, 0.1, 0.15)}) {
      for (const bool is_swapped : {false, true}) {
        const Pose pose{position, kTilted};
        const ProximityDerivatives found = is_swapped ? derivatives(*shape, pose, box, {}) : derivatives(box, {}, *shape, pose);
        CAPTURE(position.transpose());
        CHECK(found.status == DerivativeStatus::ActiveSet);
        TwistJacobian expected = TwistJacobian::Zero();
        for (int i = 0; i < 3; ++i) expected.col((is_swapped ? 9 : 3) + i) = Vector3::Unit(i).cross(found.common_normal);
        CHECK((found.normal - expected).norm() <= 1e-12);
      }
    }
  }
  CHECK(derivatives(box, {}, ball, {{1, 0, 4}, kTilted}).status != DerivativeStatus::ActiveSet);  // above the border of the face
}

TEST_CASE("derivatives: a flat side that lies on a face, to within 1e-6 rad, has no gradient by rotations") {
  const Superellipsoid slab(Vector3(0.4, 0.5, 1.5), 4, 1000), brick(Vector3(0.5, 0.4, 0.6), 300, 50),
      mild(Vector3(0.5, 0.4, 0.6), 2.3, 2.3);
  const auto status = [](const Shape& face, const Shape& body, double tilt, double apart) {
    const Matrix3 rotation = Eigen::AngleAxisd(tilt, Vector3(0.6, 0.8, 0)).toRotationMatrix();
    const Vector3 down = -(rotation.transpose() * Vector3::UnitZ());
    const double height = face.support(Vector3::UnitZ()) + body.support(down) + apart;
    return derivatives(face, {}, body, {{0.02, 0.03, height}, rotation}).status;
  };
  const auto can = std::make_shared<Cylinder>(0.65, 0.4);
  const Rounded rounded_can(can, 0.1);
  const Box box(Vector3(0.6, 0.7, 0.3));
  for (const double apart : {0.1, 0.0, -0.01}) {
    CAPTURE(apart);
    for (const Shape* face : {static_cast<const Shape*>(can.get()), static_cast<const Shape*>(&rounded_can),
                              static_cast<const Shape*>(&box), static_cast<const Shape*>(&brick)}) {
      for (const double tilt : {0.0, 1e-14, 1e-9, 1e-7}) {
        CAPTURE(tilt);
        // Between so flat sides the normal may not converge, and that says no gradient, too.
        for (const Shape* body : {static_cast<const Shape*>(&slab), static_cast<const Shape*>(&brick)}) {
          const DerivativeStatus found = status(*face, *body, tilt, apart);
          CHECK((found == DerivativeStatus::FreeOnFace || (tilt > 0 && found == DerivativeStatus::NotConverged)));
        }
      }
      CHECK(status(*face, mild, 0, apart) == DerivativeStatus::Degenerate);
      CHECK(status(*face, slab, 0.1, apart) != DerivativeStatus::FreeOnFace);
      CHECK(status(*face, Sphere(0.3), 0, apart) != DerivativeStatus::FreeOnFace);
      CHECK(status(*face, Ellipsoid(Vector3(1, 1, 1e-2)), 0, apart) != DerivativeStatus::FreeOnFace);
    }
  }
}

// The answer's normal is within its error of the side's, 1e-15 to 1e-9 rad beside it. There a cap has the curvature of its edge.
TEST_CASE("derivatives: a vertex, an edge of a cylinder or a ball above a cap, a flank or a face has derivatives at any answer") {
  Draw draw(3);
  std::vector<Vector3> points(12);
  for (Vector3& point : points) point = draw.direction();
  const auto can = std::make_shared<Cylinder>(1, 0.7);
  const auto brick = std::make_shared<Box>(Vector3(1, 1, 0.7));
  const Rounded rounded_can(can, 0.1), rounded_brick(brick, 0.1);
  const std::vector<std::pair<const Shape*, Vector3>> sides = {{can.get(), Vector3::UnitZ()},
                                                               {&rounded_can, Vector3::UnitZ()},
                                                               {can.get(), Vector3(0.6, -0.8, 0)},
                                                               {brick.get(), -Vector3::UnitZ()},
                                                               {&rounded_brick, Vector3::UnitX()}};
  for (const double size : {0.01, 0.1, 1.0, 10.0}) {
    CAPTURE(size);
    std::vector<Vector3> vertices = points;
    for (Vector3& vertex : vertices) vertex *= size;
    const auto small_box = std::make_shared<Box>(size * Vector3(1, 0.7, 0.5));
    const auto small_can = std::make_shared<Cylinder>(0.6 * size, 0.8 * size);
    const Rounded rounded_box(small_box, 0.1 * size), rounded_small_can(small_can, 0.1 * size);
    const Polytope hull(vertices);
    const Sphere ball(size);
    const std::vector<const Shape*> bodies = {small_box.get(), small_can.get(), &rounded_box, &rounded_small_can, &hull, &ball};
    for (std::size_t side = 0; side < sides.size(); ++side) {
      CAPTURE(side);
      const auto& [base, n] = sides[side];
      for (std::size_t body = 0; body < bodies.size(); ++body) {
        CAPTURE(body);
        for (int k = 0; k < 50; ++k) {
          CAPTURE(k);
          const bool is_flank = n.z() == 0 && base == can.get();  // straight along the axis
          const Vector3 aside = is_flank ? Vector3::UnitZ() : Vector3(n.cross(draw.direction()).normalized());
          const Vector3 point1 = base->support(n) * n + 0.6 * draw.uniform(0, 1) * aside;
          const Matrix3 rotation = draw.rotation();
          const double gap = (0.01 + 0.3 * draw.uniform(0, 1)) * std::min(1.0, size);
          const Vector3 lever2 = rotation * bodies[body]->point(-(rotation.transpose() * n));
          const ProximityDerivatives d = derivatives(*base, {}, *bodies[body], {point1 + gap * n - lever2, rotation});
          CHECK(d.status == DerivativeStatus::ActiveSet);
          CHECK((d.common_normal - n).norm() <= 1e-14);
          CHECK((d.gap_gradient.segment<3>(3) - n.cross(point1)).norm() <= 1e-9 * (1 + size));
          CHECK((d.gap_gradient.segment<3>(9) - lever2.cross(n)).norm() <= 1e-9 * (1 + size));
          // Along the straight side the normal turns with body 1 alone.
          CHECK((aside.transpose() * d.normal.rightCols<6>()).norm() <= 1e-9 / std::min(1.0, size));
        }
      }
    }
  }
}

// Between two nearly flat sides the radii of curvature change by a part in 1e5 within a step of the normal that counts as rounding
// for round bodies.
TEST_CASE("derivatives: nearly flat sides have the same Jacobians in turned frames, from any answer, or are refused") {
  Draw draw(1);
  const auto body = [&] {
    const Vector3 half = draw.within(0.3, 1);
    const double delta = draw.uniform(1.5, 20);
    return Superellipsoid(half, delta, draw.uniform(1.5, 20));
  };
  const auto beside_axis = [&](int axis) {
    return Vector3(Vector3::Unit(axis) + std::pow(10, draw.uniform(-8, -2)) * draw.direction()).normalized();
  };
  int compared = 0, different = 0;
  for (int k = 0; k < 600; ++k) {
    const Superellipsoid body1 = body(), body2 = body();
    const Vector3 n1 = beside_axis(k % 3), n2 = beside_axis(k / 3 % 3);
    const Pose pose1{Vector3::Zero(), draw.rotation()};
    const Vector3 n = pose1.rotation * n1;
    Pose pose2;
    pose2.rotation =
        Eigen::AngleAxisd(draw.uniform(0, 6), n).toRotationMatrix() * test::rotation_between(n2, -n).toRotationMatrix();
    pose2.position = pose1.rotation * body1.point(n1) + draw.uniform(0, 0.3) * n - pose2.rotation * body2.point(n2);
    Proximity answer = find_proximity(body1, pose1, body2, pose2);
    const ProximityDerivatives here = find_proximity_derivatives(body1, pose1, body2, pose2, answer);
    const Matrix3 turn = draw.rotation();
    answer.normal = (turn * answer.normal + 1e-9 * draw.direction()).normalized();
    const ProximityDerivatives there = find_proximity_derivatives(body1, {Vector3::Zero(), turn * pose1.rotation}, body2,
                                                                  {turn * pose2.position, turn * pose2.rotation}, answer);
    if (!here.has_normal || !there.has_normal) continue;
    ++compared;
    const Matrix3 by_v = turn.transpose() * there.normal.middleCols<3>(6) * turn,
                  by_w = turn.transpose() * there.normal.middleCols<3>(9) * turn;
    const double off = (by_v - here.normal.middleCols<3>(6)).norm() + (by_w - here.normal.middleCols<3>(9)).norm();
    different += off > 1e-7 * here.normal.norm();
  }
  CHECK(compared > 300);
  CHECK(different == 0);
}

// The matrix of a rotated body holds the large radius in all its entries, and rounding of it drowns the other radius.
TEST_CASE("derivatives: a radius of curvature that a large one drowns is refused, and known where the large one is along an axis") {
  const Sphere ball(0.3);
  int refused = 0;
  for (const double exponent : {8.0, 20.0}) {
    CAPTURE(exponent);
    const auto body = std::make_shared<Superellipsoid>(Vector3(1, 1, 1), exponent, 2);
    const LinearImage image(body, kTilted);
    for (const double tilt : {1e-6, 1e-10, 1e-14, 1e-16, 1e-18, 1e-20}) {
      CAPTURE(tilt);
      const Vector3 n = Vector3(1, tilt, 0.3).normalized(), position = body->point(n) + 0.5 * n;
      const ProximityDerivatives own = derivatives(*body, {}, ball, {position, Matrix3::Identity()});
      const ProximityDerivatives rotated = derivatives(image, {}, ball, {kTilted * position, Matrix3::Identity()});
      CHECK(own.status == DerivativeStatus::Smooth);
      CHECK(rotated.has_gap);
      if (tilt >= 1e-10) CHECK(rotated.has_normal);
      if (!rotated.has_normal) {
        CHECK(rotated.status == DerivativeStatus::Degenerate);
        ++refused;
        continue;
      }
      const Matrix3 expected = kTilted * own.normal.middleCols<3>(6) * kTilted.transpose();
      CHECK((rotated.normal.middleCols<3>(6) - expected).norm() <= 1e-6 * expected.norm());
    }
  }
  CHECK(refused > 0);
}
