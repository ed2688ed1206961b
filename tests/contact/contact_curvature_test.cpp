#include "supernormal/contact/contact_curvature.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

using namespace supernormal;

namespace {

/// An ellipsoid that does not deliver its Hessian.
class Reticent : public Shape {
 public:
  explicit Reticent(const Vector3& half_axes) : body_(half_axes) {}
  void evaluate(const Vector3& n, Order /*order*/, Jet& jet) const override { body_.evaluate(n, Order::Point, jet); }

 private:
  Ellipsoid body_;
};

}  // namespace

TEST_CASE("at the ends of its axes an ellipsoid has the radii a^2/c and b^2/c") {
  const Vector3 a(3, 2, 0.5);
  Pose pose;
  pose.rotation = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  const Vector3 n = pose.rotation * Vector3::UnitZ();
  for (const bool tells : {true, false}) {
    const Matrix3 K = tells ? find_curvature(Ellipsoid(a), pose, n) : find_curvature(Reticent(a), pose, n);
    const Matrix3 body = pose.rotation.transpose() * K * pose.rotation;
    CHECK(std::abs(body(0, 0) - 0.5 / 9) < 1e-6);
    CHECK(std::abs(body(1, 1) - 0.5 / 4) < 1e-6);
    CHECK((K * n).norm() < 1e-12);
  }
}

TEST_CASE("the curvatures of two rotated bodies add") {
  const Ellipsoid body(Vector3(2, 1, 1));
  Pose turned;
  turned.rotation = Eigen::AngleAxisd(std::acos(0.0), Vector3::UnitZ()).toRotationMatrix();
  const Vector3 n = Vector3::UnitZ();
  const ContactCurvature crossed = find_contact_curvature(find_curvature(body, {}, n) + find_curvature(body, turned, -n), n);
  CHECK(std::abs(crossed.smaller - 1.25) < 1e-12);
  CHECK(std::abs(crossed.larger - 1.25) < 1e-12);
  const ContactCurvature parallel = find_contact_curvature(2 * find_curvature(body, {}, n), n);
  CHECK(std::abs(parallel.smaller - 0.5) < 1e-12);
  CHECK(std::abs(parallel.larger - 2) < 1e-12);
}

TEST_CASE("a flat face has curvature 0 and an edge a large curvature") {
  const Superellipsoid box(Vector3(1, 1, 1), 50, 50);
  CHECK(find_curvature(box, {}, Vector3::UnitZ()).norm() < 1e-9);
  const Matrix3 edge = find_curvature(box, {}, Vector3(1, 0, 1).normalized());
  const ContactCurvature principal = find_contact_curvature(edge, Vector3(1, 0, 1).normalized());
  CHECK(principal.larger > 10);
  CHECK(principal.smaller < 1e-9);
}
