// Tests of Body, the C++ object behind a geom.
#include "ode/geom/body.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <limits>
#include <memory>

#include "ode/geom/convert.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "support/ode_fixture.hpp"

using namespace supernormal;
using namespace supernormal::ode;
using supernormal::test::Geom;
using supernormal::test::OdeSession;

namespace {

struct RotationDraw : test::Draw {
  RotationDraw() : Draw(5) {}

  dReal operator()() { return dReal(gauss()); }
  Matrix3 noise() {
    Matrix3 N;
    for (double& entry : N.reshaped()) entry = gauss();
    return N;
  }
  Matrix3 rotation() {
    dQuaternion q = {(*this)(), (*this)(), (*this)(), (*this)()};
    dNormalize4(q);
    dMatrix3 R;
    dQtoR(q, R);
    return to_rotation(R);
  }
};

double orthonormality_error(const Matrix3& R) { return (R.transpose() * R - Matrix3::Identity()).norm(); }

}  // namespace

TEST_CASE("body: a copy has the sizes of the rounded body, and a serial number of its own") {
  const auto shape = std::make_shared<Rounded>(std::make_shared<Cylinder>(0.3, 0.4), 0.25);
  const auto body = ode::Body::of(shape);
  body->set_look_ahead(0.125);
  const auto copy = body->copy();
  CHECK(&copy->shape() == &body->shape());
  CHECK(copy->size() == body->size());
  CHECK(copy->radius() == body->radius());
  CHECK(copy->radius() == shape->bounding_radius());
  CHECK(copy->look_ahead() == 0.125);
  CHECK(copy->serial() > body->serial());
}

TEST_CASE_FIXTURE(OdeSession, "rotations that ODE computes in double precision are used unchanged") {
  if (std::numeric_limits<dReal>::epsilon() > 1e-10)
    return;  // rotations in single precision are not orthonormal to double precision
  RotationDraw draw;
  const Geom geom(dCreateSphere(nullptr, 1));
  for (int k = 0; k < test::draws(100000); ++k) {
    dMatrix3 R;
    if (k % 2 == 0) {
      dRFromAxisAndAngle(R, draw(), draw(), draw(), 3 * draw());
    } else {
      dRFromEulerAngles(R, 3 * draw(), 3 * draw(), 3 * draw());
    }
    const Matrix3 of_quaternion = draw.rotation();
    const bool is_taken = orthonormal(to_rotation(R), geom) == to_rotation(R) && orthonormal(of_quaternion, geom) == of_quaternion;
    if (!is_taken) FAIL_CHECK("rotation ", k, " is changed");
  }
}

TEST_CASE_FIXTURE(OdeSession, "the nearest rotation is orthonormal to rounding, and no farther away than the error") {
  RotationDraw draw;
  const Geom geom(dCreateSphere(nullptr, 1));
  for (const double size : {1e-13, 1e-10, 1e-7, 1e-5, 1e-3}) {
    for (int k = 0; k < 1000; ++k) {
      const Matrix3 exact = draw.rotation();
      const Matrix3 rough = exact + size / 4 * draw.noise();
      if (rotation_error(rough) > 9e-3) continue;
      const Matrix3 Q = orthonormal(rough, geom);
      CHECK(orthonormality_error(Q) <= 2e-15);
      // The other factor of a polar decomposition is symmetric.
      const Matrix3 stretch = Q.transpose() * rough;
      CHECK((stretch - stretch.transpose()).norm() <= 1e-14);
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "rotations with entries that are not finite are passed to the core") {
  const Geom geom(dCreateSphere(nullptr, 1));
  for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Matrix3 R = Matrix3::Identity();
    R(1, 2) = wrong;
    CHECK_FALSE(orthonormal(R, geom).allFinite());
  }
}
