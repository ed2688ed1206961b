// The gap function: its value from the shapes' own, its derivatives from differences, and the quadratic model of s around a normal.
#include "supernormal/proximity/gap_function.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>

#include "proximity/local/local_model.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/callback_shape.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "support/draw.hpp"
#include "support/reference_pairs.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

const Superellipsoid kShape1(Vector3(3, 2, 1), 2.4, 1.8), kShape2(Vector3(1, 0.5, 2), 1.6, 3);
const Pose kPose1{{10, -4, 2}, Eigen::Quaterniond(0.5, 0.1, -0.7, 0.2).normalized().toRotationMatrix()};
const Pose kPose2{{12, -1, 5}, Eigen::Quaterniond(-0.3, 0.8, 0.2, 0.4).normalized().toRotationMatrix()};

void check_plane(const LocalModel& local, const GapFunction& gap, const GapJet& jet) {
  const Matrix3& R = gap.rotation();
  const TangentPlane& plane = local.plane1;
  CHECK((plane.n - jet.n).norm() <= 1e-15);
  for (const Vector3& t : {plane.t1, plane.t2}) {
    CHECK(std::abs(t.norm() - 1) <= 1e-15);
    CHECK(std::abs(t.dot(plane.n)) <= 1e-15);
  }
  CHECK(std::abs(plane.t1.dot(plane.t2)) <= 1e-15);
  CHECK((R * local.plane2.n - plane.n).norm() <= 1e-15);
  CHECK((R * local.plane2.t1 - plane.t1).norm() <= 2e-15);
  CHECK((R * local.plane2.t2 - plane.t2).norm() <= 2e-15);
}

}  // namespace

TEST_CASE("s is the distance of the two supporting planes, d joins the boundary points") {
  GapFunction gap(kShape1, kPose1, kShape2, kPose2);
  for (const Vector3& n : random_normals(100, 41)) {
    GapJet jet;
    gap.evaluate(n, Order::Hessian, jet);
    const Vector3 world = kPose1.rotation * n;
    const Vector3 in_body2 = -(kPose2.rotation.transpose() * world);
    const Vector3 point1 = kPose1.position + kPose1.rotation * kShape1.point(n);
    const Vector3 point2 = kPose2.position + kPose2.rotation * kShape2.point(in_body2);
    CHECK(std::abs(jet.s - world.dot(point2 - point1)) <= 1e-14);
    CHECK((kPose1.rotation * jet.d - (point2 - point1)).norm() <= 2e-14);
    CHECK((jet.m - in_body2).norm() <= 4e-16);
    CHECK(std::abs(n.dot(jet.d) - jet.s) <= 1e-14);
    CHECK((gap.curvature(jet) * n).norm() <= 1e-13);
  }
  CHECK(gap.evaluations() == 100);
}

TEST_CASE("d is the gradient of s, -H the gradient of d") {
  GapFunction gap(kShape1, kPose1, kShape2, kPose2);
  int checked = 0;
  for (const Vector3& n : random_normals(50, 42)) {
    GapJet jet, turned;
    gap.evaluate(n, Order::Hessian, jet);
    if (n.cwiseAbs().minCoeff() < 0.1 || jet.m.cwiseAbs().minCoeff() < 0.1) continue;
    ++checked;
    const Matrix3 curvature = gap.curvature(jet);
    for (const Vector3& t : tangents(n)) {
      const auto at = [&](double angle, Order order) -> const GapJet& {
        gap.evaluate(std::cos(angle) * n + std::sin(angle) * t, order, turned);
        return turned;
      };
      const Derivative slope = derivative([&](double angle) { return Vector3(at(angle, Order::Value).s, 0, 0); }, 0.02);
      const Derivative bend = derivative([&](double angle) { return at(angle, Order::Point).d; }, 0.02);
      CHECK(std::abs(slope.value.x() - t.dot(jet.d)) <= 1e-10);
      CHECK((bend.value + curvature * t).norm() <= 1e-9 * (1 + curvature.norm()));
    }
  }
  CHECK(checked >= 10);
}

TEST_CASE("an order asks for no more than it names") {
  GapFunction gap(kShape1, kPose1, kShape2, kPose2);
  GapJet jet;
  gap.evaluate(Vector3::UnitZ(), Order::Value, jet);
  CHECK(jet.d == Vector3::Zero());
  gap.evaluate(Vector3::UnitZ(), Order::Point, jet);
  CHECK(jet.d != Vector3::Zero());
  CHECK(jet.jet1.H == Matrix3::Zero());
}

TEST_CASE("the unit of length is the smallest half-extent of what is not a point") {
  const auto unit = [](const Shape& a, const Shape& b) { return GapFunction(a, {}, b, {}).length_unit(); };
  CHECK(unit(kShape1, kShape2) == 0.5);
  CHECK(unit(Sphere(0), kShape1) == 1);
  CHECK(unit(kShape2, Sphere(0)) == 0.5);
  CHECK(unit(Sphere(0), Sphere(0)) == 0);
}

TEST_CASE("the stated rounding of s is one") {
  // The closed form is the distance of the supporting planes of two ellipsoids, in long double.
  const Vector3 half1(3, 2, 1), half2(0.5, 4, 2);
  const Ellipsoid shape1(half1), shape2(half2);
  const Vector3 offset(5, 1, -3);
  GapFunction gap(shape1, {}, shape2, {offset, Matrix3::Identity()});
  CHECK(gap.rounding() < 5e-14);
  for (const Vector3& n : random_normals(1000, 43)) {
    GapJet jet;
    gap.evaluate(n, Order::Value, jet);
    const auto support = [&](const Vector3& half) {
      return std::sqrt((half.cast<long double>().cwiseProduct(n.cast<long double>())).squaredNorm());
    };
    const long double exact = n.cast<long double>().dot(offset.cast<long double>()) - support(half1) - support(half2);
    CHECK(std::abs(static_cast<double>(jet.s - exact)) <= gap.rounding());
  }
}

// The rotation of body 2 is known to its last digit, times the distance of the body from the origin of its frame.
TEST_CASE("the stated rounding of s counts how far bodies are from the origins of their frames, and so does what is claimed") {
  using Real = long double;
  using Real3 = Eigen::Matrix<Real, 3, 1>;
  Draw random(44);
  const auto draw = [&] { return Vector3{random.gauss(), random.gauss(), random.gauss()}; };
  for (int k = 0; k < 1000; ++k) {
    const Vector3 centre1 = 1e6 * draw(), centre2 = centre1 + 4 * draw().normalized();
    std::array<Vector3, 8> points1, points2;
    for (Vector3& point : points1) point = centre1 + 0.3 * draw();
    for (Vector3& point : points2) point = centre2 + 0.3 * draw();
    const Polytope shape1(points1), shape2(points2);
    const Vector3 w = draw(), v = draw();
    const Pose pose{Vector3::Zero(), Eigen::AngleAxisd(w.x(), v.normalized()).toRotationMatrix()};
    GapFunction gap(shape1, pose, shape2, pose);
    const Proximity out = find_proximity(shape1, pose, shape2, pose);
    GapJet jet;
    gap.evaluate((pose.rotation.transpose() * out.normal).normalized(), Order::Value, jet);
    const Real3 n = jet.n.cast<Real>().normalized();
    const Eigen::Matrix<Real, 3, 3> R = pose.rotation.cast<Real>();
    const Real3 m = -(R.transpose() * (R * n));
    const auto support = [](const auto& points, const Real3& normal) {
      Real highest = -std::numeric_limits<Real>::infinity();
      for (const Vector3& point : points) highest = std::max(highest, normal.dot(point.cast<Real>()));
      return highest;
    };
    const Real exact = -support(points1, n) - support(points2, m);
    CHECK(std::abs(static_cast<double>(jet.s - exact)) <= gap.rounding());
    // The largest value of s is no less than that at this normal.
    CHECK(static_cast<double>(exact) <= out.gap + out.global_error);
    CHECK(gap.rounding() <= 1e-7);
  }
}

TEST_CASE("a Hessian needs the Hessians of both bodies") {
  const CallbackShape plain([](const Vector3& n) { return kShape1.support(n); }, [](const Vector3& n) { return kShape1.point(n); });
  CHECK(GapFunction(kShape1, {}, kShape2, {}).has_hessian());
  CHECK_FALSE(GapFunction(plain, {}, kShape2, {}).has_hessian());
  CHECK_FALSE(GapFunction(kShape2, {}, plain, {}).has_hessian());
}

TEST_CASE("the model predicts s to third order") {
  const Superellipsoid shape1(Vector3(3, 2, 1), 2.4, 1.8), shape2(Vector3(1, 0.5, 2), 1.6, 3);
  const Pose pose2{{2, 3, 3}, Eigen::Quaterniond(-0.3, 0.8, 0.2, 0.4).normalized().toRotationMatrix()};
  GapFunction gap(shape1, {}, shape2, pose2);
  int checked = 0;
  for (const Vector3& n : random_normals(60, 71)) {
    GapJet jet, there;
    gap.evaluate(n, Order::Hessian, jet);
    if (n.cwiseAbs().minCoeff() < 0.1 || jet.m.cwiseAbs().minCoeff() < 0.1) continue;
    ++checked;
    const LocalModel local = LocalModel::of(gap, jet);
    check_plane(local, gap, jet);
    const LocalModel summed = LocalModel::of(gap, jet, gap.curvature(jet));
    check_plane(summed, gap, jet);
    for (const double angle : {0.4, 1.7, 3.3, 5.1}) {
      const Vector2 direction(std::cos(angle), std::sin(angle));
      const auto defect = [&](const LocalModel& m, double reach) {
        const Vector2 u = reach * direction;
        gap.evaluate((n + m.plane1.lift(u)).normalized(), Order::Value, there);
        return std::abs(there.s - jet.s - m.model.gain(u));
      };
      for (const LocalModel* m : {&local, &summed}) {
        // Ten times nearer, a thousand times better; the exponent 3 without its constant needs two distances.
        const double far = defect(*m, 1e-2), near = defect(*m, 1e-3);
        CHECK(near <= 1e-2 * far + 3e-9);
        CHECK(near <= 1e-6);
      }
    }
  }
  CHECK(checked >= 10);
}

TEST_CASE("an infinite radius of curvature stays in its own entry") {
  // Edges of a rotated box: the wall's flatness must not spill over the radius across the edge.
  const Superellipsoid box(Vector3(3, 2, 1), 60, 60);
  const Pose pose2{{4, 3, 2}, Eigen::Quaterniond(-0.3, 0.8, 0.2, 0.4).normalized().toRotationMatrix()};
  for (const Vector3& in_body2 : {Vector3(1, 1e-12, 0.4), Vector3(-1e-9, 0.8, 0.5), Vector3(0.3, 0.7, 1e-10)}) {
    const Ellipsoid ball(Vector3(0.5, 0.6, 0.7));
    GapFunction gap(ball, {}, box, pose2);
    GapJet jet;
    gap.evaluate(-(pose2.rotation * in_body2.normalized()), Order::Hessian, jet);
    const LocalModel local = LocalModel::of(gap, jet);
    check_plane(local, gap, jet);
    const Eigen2 e(local.A2);
    // In the box's own frame, without the rotation, the same numbers.
    GapFunction aligned(ball, {}, box, {{4, 3, 2}, Matrix3::Identity()});
    GapJet aligned_jet;
    aligned.evaluate(-in_body2.normalized(), Order::Hessian, aligned_jet);
    const Eigen2 expected(LocalModel::of(aligned, aligned_jet).A2);
    CHECK(expected.high > 1e5 * expected.low);
    CHECK(std::abs(e.low / expected.low - 1) <= 1e-4);
    CHECK(std::abs(e.high / expected.high - 1) <= 1e-4);
  }
}

TEST_CASE("two points have no curvature, and a basis all the same") {
  for (const Vector3& n : singular_normals()) {
    const Sphere point(0);
    GapFunction gap(point, {}, point, {{1, 2, 3}, Matrix3::Identity()});
    GapJet jet;
    gap.evaluate(n, Order::Hessian, jet);
    const LocalModel local = LocalModel::of(gap, jet);
    check_plane(local, gap, jet);
    CHECK(local.A1.xx == 0);
    CHECK(std::abs(local.model.A.xx - jet.s) <= 1e-15);
  }
}
