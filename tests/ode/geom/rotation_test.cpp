// Rotations that are not orthonormal to rounding. Matrices far from a rotation are refused.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include "ode/collider_fixture.hpp"
#include "supernormal/proximity/pose.hpp"

using namespace supernormal::test;
using supernormal::Matrix3;

namespace {

void rotate(dGeomID geom, const Matrix3& R) {
  dMatrix3 rows{};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rows[4 * row + column] = dReal(R(row, column));
  }
  dGeomSetRotation(geom, rows);
}

void check_refused(dGeomID g1, dGeomID g2, const std::string& who) {
  CAPTURE(who);
  snProximity answer;
  CHECK(snGeomProximity(g1, g2, &answer) == 0);
  const std::string text = snLastError();
  CAPTURE(text);
  CHECK(text.find("the rotation of " + who + " is [") != std::string::npos);
  CHECK(text.find("right-handed") != std::string::npos);
  CHECK(collide(g1, g2).empty());
  CHECK(std::string(snLastError()).find("dCollide: the rotation of " + who) == 0);
}

}  // namespace

TEST_CASE("a matrix that is not near a rotation is refused by name, and gives no contact and no NaN") {
  OdeSession session;
  Matrix3 shear = Matrix3::Identity(), mirror = Matrix3::Identity();
  shear(0, 1) = 0.05;
  mirror(2, 2) = -1;
  const Matrix3 huge = Matrix3::Constant(double{std::numeric_limits<dReal>::max()});
  for (const Matrix3& wrong : {Matrix3(1.02 * Matrix3::Identity()), shear, mirror, Matrix3(Matrix3::Zero()), huge}) {
    const Geom body(snCreateSuperellipsoid(nullptr, 1, dReal(0.8), dReal(0.6), 3, 4));
    const Geom other(snCreateEllipsoid(nullptr, 1, 1, 1));
    rotate(body, wrong);
    check_refused(body, other, "a geom of this library's class");
    check_refused(other, body, "a geom of this library's class");
    CHECK(std::isnan(snGeomPointDepth(body, 0, 0, 0)));
    CHECK(std::string(snLastError()).find("snGeomPointDepth: the rotation of ") == 0);
    const dVector3 up = {0, 0, 1, 0};
    dVector3 point = {7, 7, 7, 7};
    CHECK(snGeomSupport(body, up, point) == 0);
    CHECK(point[0] == 7);
    dReal aabb[6];
    dGeomGetAABB(body, aabb);
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(aabb[2 * axis] == -dInfinity);
      CHECK(aabb[2 * axis + 1] == dInfinity);
    }
  }
  const Geom body(snCreateEllipsoid(nullptr, 1, 1, 1));
  const Geom box(dCreateBox(nullptr, 1, 1, 1));
  rotate(box, shear);
  check_refused(body, box, "a dBox");
  check_refused(box, body, "a dBox");
}

TEST_CASE("a rotation with three decimals is accepted") {
  OdeSession session;
  const Geom body(snCreateEllipsoid(nullptr, 1, 1, 1));
  Matrix3 typed;
  typed << 0.866, -0.5, 0, 0.5, 0.866, 0, 0, 0, 1;
  rotate(body, typed);
  const double depth = snGeomPointDepth(body, dReal(0.3), dReal(0.4), 0);
  CHECK(depth == doctest::Approx(0.5).epsilon(1e-6));
}
