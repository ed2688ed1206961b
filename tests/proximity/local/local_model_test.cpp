// The quadratic model of s around a normal.
#include "proximity/local/local_model.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "supernormal/shapes/sphere.hpp"
#include "support/reference_pairs.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

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
