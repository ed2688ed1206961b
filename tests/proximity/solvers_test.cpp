// Tests of the three solvers, every way in which they can end, and special pairs.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "supernormal/contact/contact_manifold.hpp"
#include "supernormal/contact/mesh_contacts.hpp"
#include "supernormal/proximity/plane.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/raycast/ray.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/shapes/superovoid.hpp"
#include "support/draw.hpp"
#include "support/reference_pairs.hpp"
#include "support/refusal.hpp"
#include "support/relative.hpp"
#include "support/shape_samples.hpp"
#include "support/without_hessian.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

Pose upright_at(const Vector3& position) { return {position, Eigen::Matrix3d::Identity()}; }

Settings with(Solver solver) { return {.solver = solver}; }

/// A body whose functions return NaN.
class NotANumber final : public Shape {
 public:
  void evaluate(const Vector3&, Order, Jet& jet) const override { jet = {kNan, Vector3::Constant(kNan), Matrix3::Constant(kNan)}; }
  ShapeTraits traits() const override { return {.has_hessian = true}; }
  Vector3 half_extents() const override { return Vector3::Ones(); }
};

/// A ball whose functions return NaN if the normal's z is above a limit.
class KnownBelow final : public Shape {
 public:
  explicit KnownBelow(double limit) : limit_(limit) {}
  void evaluate(const Vector3& n, Order order, Jet& jet) const override {
    (n.z() > limit_ ? static_cast<const Shape&>(nothing_) : ball_).evaluate(n, order, jet);
  }
  ShapeTraits traits() const override { return {.has_hessian = true}; }
  Vector3 half_extents() const override { return Vector3::Ones(); }

 private:
  double limit_;
  NotANumber nothing_;
  Ellipsoid ball_{Vector3(1, 1.1, 0.9)};
};

std::string refusal_of(const Settings& settings) {
  return refusal([&] { find_proximity(Sphere(1), {}, Sphere(1), {}, settings); });
}

bool is_smooth(const ReferencePair& pair) { return pair.kind == "sphere" || pair.kind == "ellipsoid" || pair.kind == "moderate"; }

}  // namespace

TEST_CASE("two balls: the normal of a warm query is the line of centres to rounding, unless they are concentric") {
  const Sphere sphere(0.7);
  const Ellipsoid equal_axes({0.5, 0.5, 0.5});
  const Superellipsoid exponents_2({0.6, 0.6, 0.6}, 2, 2);
  const Vector3 u = Vector3(0.3, -0.2, 0.9).normalized();
  const Vector3 before = (u + 4e-5 * u.unitOrthogonal()).normalized();
  for (const Shape* const one : {static_cast<const Shape*>(&sphere), static_cast<const Shape*>(&equal_axes)}) {
    for (const Shape* const other : {static_cast<const Shape*>(&equal_axes), static_cast<const Shape*>(&exponents_2)}) {
      const double touch = one->bounding_radius() + other->bounding_radius();
      for (const double distance : {1.1 * touch, 0.999 * touch, 0.2 * touch}) {
        const Proximity p = find_proximity(*one, {}, *other, {distance * u, Matrix3::Identity()}, {}, &before);
        CHECK((p.normal - u).norm() < 1e-15);
        CHECK(p.contact.cross(u).norm() < 1e-15);
        CHECK(p.gap == doctest::Approx(distance - touch).epsilon(1e-14));
      }
      CHECK(find_proximity(*one, {}, *other, {}, {}, &before).normal == before);
    }
  }
}

TEST_CASE("the three solvers agree on ellipsoids, and where they converge on other smooth bodies") {
  int compared = 0;
  for (const ReferencePair& pair : reference_pairs()) {
    if (!is_smooth(pair) || !pair.is_apart_or_touching()) continue;
    for (const Solver solver : {Solver::Newton, Solver::FixedPoint, Solver::Hybrid}) {
      const Proximity out = solve(pair, with(solver));
      // Newton has no safeguard: it loses one pair with moderate exponents.
      if (solver == Solver::Newton && pair.kind == "moderate" && out.status != Status::Converged) continue;
      ++compared;
      const bool good = out.status == Status::Converged && std::abs(out.gap - pair.gap) <= out.error + 1e-14;
      if (!good) {
        FAIL_CHECK(pair.name, " solver ", static_cast<int>(solver), " status ", static_cast<int>(out.status), " gap ", out.gap,
                   " instead of ", pair.gap, " error ", out.error);
      }
    }
  }
  CHECK(compared >= 3 * 3 * 125 - 1);
}

TEST_CASE("the contact point of every solver depends less on the error of the normal than the middle of the witness points") {
  for (const Solver solver : {Solver::Newton, Solver::FixedPoint, Solver::Hybrid}) {
    double of_contact = 0, of_middle = 0;
    for (const ReferencePair& pair : reference_pairs()) {
      if (!is_smooth(pair) || !pair.is_apart_or_touching()) continue;
      Settings loose = with(solver);
      loose.tolerance = 1e-3;
      const Proximity out = solve(pair, loose);
      if (out.status != Status::Converged) continue;
      const Vector3 exact = solve(pair, {.tolerance = 1e-13}).contact;
      of_contact += (out.contact - exact).norm() / pair.unit;
      of_middle += (0.5 * (out.point1 + out.point2) - exact).norm() / pair.unit;
    }
    CAPTURE(static_cast<int>(solver));
    CHECK(of_middle > 0.1);
    CHECK(of_contact <= 0.5 * of_middle);
  }
}

TEST_CASE("bodies without a Hessian are solved to the tolerance") {
  for (const ReferencePair& pair : reference_pairs()) {
    if (!pair.is_apart_or_touching()) continue;
    const CallbackShape shape1 = without_hessian(pair.shape1), shape2 = without_hessian(pair.shape2);
    for (const Solver solver : {Solver::Hybrid, Solver::Newton, Solver::FixedPoint}) {
      if (solver == Solver::FixedPoint && !is_smooth(pair)) continue;  // it has no safeguard and is not for edges
      const Proximity out = find_proximity(shape1, pair.pose1, shape2, pair.pose2, with(solver));
      const double error = std::abs(out.gap - pair.gap);
      // Where nothing is proved, in overlaps deeper than the ball that rolls inside, the reported error is an estimate.
      const bool is_right = out.is_global ? error <= out.error + 1e-14 : error <= 1e-6 * pair.unit;
      const bool good = out.status == Status::Converged && out.error <= 1e-9 * pair.unit && is_right;
      if (!good) {
        FAIL_CHECK(pair.name, " solver ", static_cast<int>(solver), " status ", static_cast<int>(out.status), " error ", error,
                   " reported ", out.error, " evaluations ", out.evaluations);
      }
    }
  }
}

TEST_CASE("Newton of a body without a Hessian is the hybrid") {
  const auto shape = std::make_shared<Ellipsoid>(Vector3(3, 2, 1));
  const CallbackShape body = without_hessian(shape);
  const Proximity newton = find_proximity(body, {}, *shape, upright_at({3, 4, 2}), with(Solver::Newton));
  const Proximity hybrid = find_proximity(body, {}, *shape, upright_at({3, 4, 2}));
  CHECK(newton.gap == hybrid.gap);
  CHECK(newton.evaluations == hybrid.evaluations);
}

TEST_CASE("an early out stops at the first normal that separates") {
  for (const ReferencePair& pair : reference_pairs()) {
    for (const Solver solver : {Solver::Hybrid, Solver::Newton, Solver::FixedPoint}) {
      Settings early = with(solver);
      early.stop_when_apart = true;
      const Proximity out = solve(pair, early);
      if (pair.nominal < 0) {
        if (out.status == Status::Apart || out.gap > out.error) FAIL_CHECK(pair.name, " called apart by ", out.gap);
        continue;
      }
      if (pair.nominal == 0) continue;  // a touching pair may be either
      // The gap is a lower bound of the distance, and the witness points give an upper one.
      const bool bounds = out.status == Status::Apart && out.gap > 0 && out.gap <= pair.gap * (1 + 1e-12) + 1e-14 &&
                          (out.point2 - out.point1).norm() >= pair.gap * (1 - 1e-12) - 1e-14 &&
                          pair.gap - out.gap <= out.error + 1e-14;
      if (solver == Solver::Hybrid && !bounds) FAIL_CHECK(pair.name, " status ", static_cast<int>(out.status), " gap ", out.gap);
      if (out.status != Status::Apart || out.evaluations <= 1) continue;
      Settings before = with(solver);
      before.max_evaluations = out.evaluations - 1;
      const double gap_before = solve(pair, before).gap;
      if (gap_before > 0) FAIL_CHECK(pair.name, " was apart by ", gap_before, " an evaluation before");
    }
  }
}

TEST_CASE("an early out from the normal of an earlier pose takes at most one evaluation") {
  const Settings early{.stop_when_apart = true};
  for (const ReferencePair& pair : reference_pairs()) {
    if (!(pair.nominal > 0)) continue;
    const Vector3 normal = solve(pair).normal;
    const Proximity out = solve(pair, early, &normal);
    const bool good = out.status == Status::Apart && out.evaluations <= 1;
    if (!good) FAIL_CHECK(pair.name, " status ", static_cast<int>(out.status), " evaluations ", out.evaluations);
  }
}

TEST_CASE("a limit of evaluations is kept, and the answer so far is a valid one") {
  int limited = 0;
  for (const ReferencePair& pair : reference_pairs()) {
    for (const Solver solver : {Solver::Hybrid, Solver::Newton, Solver::FixedPoint}) {
      for (const int limit : {1, 2, 3, 5, 9, 17}) {
        Settings settings = with(solver);
        settings.max_evaluations = limit;
        const Proximity out = solve(pair, settings);
        limited += out.status == Status::EvaluationLimit;
        const bool kept = out.evaluations <= limit;
        const bool valid = std::isfinite(out.gap) && out.error >= 0 && out.point1.allFinite() && out.point2.allFinite() &&
                           out.contact.allFinite() && std::abs(out.normal.norm() - 1) <= 4e-16;
        // The value of s for any normal is a lower bound.
        const bool bound = out.gap <= pair.gap + 1e-9 * pair.unit;
        if (!(kept && valid && bound)) {
          FAIL_CHECK(pair.name, " solver ", static_cast<int>(solver), " limit ", limit, " evaluations ", out.evaluations, " gap ",
                     out.gap, " valid ", valid);
        }
        const bool finished = out.status == Status::Converged || out.status == Status::Stalled || out.status == Status::Diverged;
        if (!finished && out.evaluations != limit) FAIL_CHECK(pair.name, " stopped at ", out.evaluations, " of ", limit);
      }
    }
  }
  CHECK(limited > 5000);
}

TEST_CASE("each class of bodies takes its mean evaluations, and no more") {
  struct Class {
    std::string name;
    double mean, most;  // measured, with a twentieth of the mean and half of the most in addition
    std::shared_ptr<const Shape> (*draw)(Draw& draw, const Vector3& half);
  };
  const std::vector<Class> classes = {
      {"superellipsoids", 8.2, 77,
       [](Draw& draw, const Vector3& half) -> std::shared_ptr<const Shape> {
         const double delta = draw.uniform(2.5, 22.5);
         return std::make_shared<Superellipsoid>(half, delta, draw.uniform(2.5, 22.5));
       }},
      {"superovoids", 9.5, 93,
       [](Draw& draw, const Vector3& half) -> std::shared_ptr<const Shape> {
         const double taper = draw.uniform(0, 0.1), delta = draw.uniform(2.2, 6.2);
         return std::make_shared<Superovoid>(half, delta, draw.uniform(2.2, 6.2), taper, taper);
       }},
      {"capsules", 3.3, 11,
       [](Draw&, const Vector3& half) -> std::shared_ptr<const Shape> { return std::make_shared<Capsule>(half.x(), half.y()); }},
      {"cylinders", 16.3, 255,
       [](Draw&, const Vector3& half) -> std::shared_ptr<const Shape> { return std::make_shared<Cylinder>(half.x(), half.y()); }},
      {"boxes", 5.1, 21, [](Draw&, const Vector3& half) -> std::shared_ptr<const Shape> { return std::make_shared<Box>(half); }},
      {"rounded boxes", 4.8, 15, [](Draw&, const Vector3& half) -> std::shared_ptr<const Shape> {
         return std::make_shared<Rounded>(std::make_shared<Box>(half), 0.1);
       }}};
  for (const Class& one : classes) {
    CAPTURE(one.name);
    Draw draw(3);
    double sum = 0, most = 0;
    const int pairs = draws(2000);
    for (int i = 0; i < pairs; ++i) {
      const auto half = [&] { return Vector3(draw.uniform(0.5, 1.5), draw.uniform(0.5, 1.5), draw.uniform(0.5, 1.5)); };
      const auto first = one.draw(draw, half()), second = one.draw(draw, half());
      const Matrix3 rotation = draw.rotation();
      const Vector3 n = draw.direction();
      const double width = first->support(n) + second->support(-(rotation.transpose() * n));
      const Proximity out = find_proximity(*first, {}, *second, {draw.uniform(0.8, 1.2) * width * n, rotation});
      CHECK(out.status == Status::Converged);
      sum += out.evaluations;
      most = std::max<double>(most, out.evaluations);
    }
    CHECK(sum / pairs <= one.mean);
    CHECK(most <= one.most);
  }
}

TEST_CASE("settings out of range are refused with name, value and range") {
  for (const double tolerance : {0.0, -1e-9, 0.9e-15, 1.1, kNan, kInf}) {
    const std::string message = refusal_of({.tolerance = tolerance});
    check_contains(message, "tolerance");
    check_contains(message, "1e-15");
  }
  for (const int limit : {0, -5, 1000001}) {
    const std::string message = refusal_of({.max_evaluations = limit});
    check_contains(message, "max_evaluations");
    check_contains(message, limit == 1000001 ? "1000001" : std::to_string(limit));
  }
  for (const double tolerance : {1e-15, 1.0}) {
    CHECK(refusal_of({.tolerance = tolerance}).empty());
  }
  for (const int limit : {1, 1000000}) {
    CHECK(refusal_of({.max_evaluations = limit}).empty());
  }
}

TEST_CASE("a matrix that is no rotation is called invalid input by every query, and one in single precision is taken") {
  const Superellipsoid body(Vector3(1, 0.8, 0.6), 3, 4);
  const Vector3 z = Vector3::UnitZ();
  const std::array<MeshTriangle, 1> floor = {{{{Vector3(-9, -9, -0.5), Vector3(9, -9, -0.5), Vector3(0, 9, -0.5)}, 0}}};
  const auto answers = [&](const Pose& pose) {
    const bool has_contacts = !MeshContacts().find(body, pose, floor).empty();
    return std::array<bool, 7>{find_proximity(body, pose, Sphere(1), {}).status != Status::InvalidInput,
                               find_proximity(Sphere(1), {}, body, pose).status != Status::InvalidInput,
                               find_plane_proximity(body, pose, z, -0.5).status != Status::InvalidInput,
                               find_ray_hit(body, pose, 5 * z, -z, 10).status != Status::InvalidInput,
                               find_ray_proximity(body, pose, 5 * z, -z, 10).status != Status::InvalidInput,
                               has_contacts,
                               find_nearest_triangle(body, pose, floor).proximity.status != Status::InvalidInput};
  };
  constexpr std::array<bool, 7> kAll = {true, true, true, true, true, true, true};
  const Matrix3 rotation = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  CHECK(answers({Vector3::Zero(), rotation}) == kAll);
  CHECK(answers({Vector3::Zero(), rotation.cast<float>().cast<double>()}) == kAll);
  Matrix3 sheared = rotation;
  sheared.col(0) += 1e-3 * sheared.col(1);
  const Matrix3 reflection = rotation * Vector3(1, 1, -1).asDiagonal();
  for (const Matrix3& none : {Matrix3(1.1 * rotation), Matrix3(1.0001 * rotation), Matrix3(-rotation), reflection, sheared,
                              Matrix3(Matrix3::Zero()), Matrix3(Matrix3::Constant(1e200))}) {
    CHECK(answers({Vector3::Zero(), none}) == std::array<bool, 7>{});
    const Pose pose{Vector3::Zero(), none};
    CHECK(find_contact_manifold(body, pose, Sphere(1), {}, find_proximity(body, pose, Sphere(1), {})).corner_count == 0);
    CHECK(find_plane_contact_manifold(body, pose, find_plane_proximity(body, pose, z, -0.5)).corner_count == 0);
  }
}

TEST_CASE("a plane's normal without unit length is refused") {
  const Ellipsoid body(Vector3(1, 2, 3));
  for (const double length : {0.0, 0.5, 1 + 1e-5, 2.0, 1e200}) {
    CHECK_THROWS_WITH_AS(find_plane_proximity(body, {}, length * Vector3::UnitZ(), 0),
                         doctest::Contains("length of plane_normal = "), std::invalid_argument);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(find_plane_proximity(body, {}, Vector3(nan, 0, 1), 0).status == Status::InvalidInput);
}

TEST_CASE(
    "a shape that delivers a support function and boundary points, and says no more, is as good as one that is made of both") {
  /// An ellipsoid as short as a program can write one.
  class Newcomer final : public Shape {
   public:
    void evaluate(const Vector3& n, Order order, Jet& jet) const override {
      jet.h = half_axes_.cwiseProduct(n).norm();
      if (order != Order::Value) jet.r = half_axes_.cwiseAbs2().cwiseProduct(n) / jet.h;
    }

   private:
    Vector3 half_axes_{1, 0.8, 0.6};
  };
  const Newcomer body;
  const auto ellipsoid = std::make_shared<Ellipsoid>(Vector3(1, 0.8, 0.6));
  const CallbackShape same = without_hessian(ellipsoid);
  const Pose pose{Vector3(1.2, 0.9, 0.8), Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix()};
  const Proximity out = find_proximity(body, {}, Sphere(1), pose), expected = find_proximity(same, {}, Sphere(1), pose);
  CHECK(out.status == Status::Converged);
  CHECK(out.gap == expected.gap);
  CHECK(out.evaluations == expected.evaluations);
  CHECK(body.mass_properties().volume == relative(ellipsoid->mass_properties().volume).epsilon(1e-8));
}

TEST_CASE("what is not finite is called invalid input") {
  const Superellipsoid shape(Vector3(3, 2, 1), 4, 1.3);
  for (const Solver solver : {Solver::Hybrid, Solver::Newton, Solver::FixedPoint}) {
    for (const double bad : {kNan, kInf, -kInf}) {
      Pose displaced = upright_at({bad, 0, 0}), turned = upright_at({5, 0, 0});
      turned.rotation(1, 2) = bad;
      CHECK(find_proximity(shape, displaced, shape, upright_at({5, 0, 0}), with(solver)).status == Status::InvalidInput);
      CHECK(find_proximity(shape, {}, shape, displaced, with(solver)).status == Status::InvalidInput);
      CHECK(find_proximity(shape, turned, shape, {}, with(solver)).status == Status::InvalidInput);
      CHECK(find_proximity(shape, {}, shape, turned, with(solver)).status == Status::InvalidInput);
    }
    const Proximity out = find_proximity(shape, {}, NotANumber(), upright_at({5, 0, 0}), with(solver));
    CHECK(out.status == Status::InvalidInput);
    CHECK(std::isfinite(out.gap));
    CHECK(out.normal.norm() == 1);
  }
}

TEST_CASE("a body that is known only on one side: an answer or invalid input, and an end of the search") {
  int known = 0;
  for (int k = 0; k < 100; ++k) {
    const KnownBelow body(-0.95 + 0.02 * k);
    const Pose pose2 = upright_at(Vector3{0.3 * std::cos(k), 0.3 * std::sin(k), -0.2});
    const Proximity out = find_proximity(body, {}, Superellipsoid(Vector3(1, 0.7, 0.5), 1.3, 1.4), pose2);
    known += out.status == Status::Converged;
    CHECK((out.status == Status::InvalidInput || (std::isfinite(out.gap) && out.normal.norm() == relative(1))));
  }
  CHECK(known > 0);
}

TEST_CASE("an unusable first normal is no worse than none") {
  const Superellipsoid shape(Vector3(3, 2, 1), 4, 1.3);
  const Proximity cold = find_proximity(shape, {}, shape, upright_at({3, 4, 2}));
  for (const Vector3& bad : {Vector3(0, 0, 0), Vector3(kNan, 0, 1), Vector3(0, kInf, 0), Vector3(0, 0, 2), Vector3(1e-200, 0, 0)}) {
    const Proximity out = find_proximity(shape, {}, shape, upright_at({3, 4, 2}), {}, &bad);
    CHECK(out.gap == cold.gap);
    CHECK(out.evaluations == cold.evaluations);
  }
}

TEST_CASE("two spheres: no evaluation, exact") {
  for (const Vector3& direction : random_normals(20, 31)) {
    for (const double distance : {1e-3, 0.5, 1.75, 2.0, 40.0}) {
      const Proximity out =
          find_proximity(Sphere(1.25), upright_at({1, 2, 3}), Sphere(0.5), upright_at(Vector3(1, 2, 3) + distance * direction));
      const double rounding = 4e-15 * std::max(1.0, distance);
      CHECK(out.status == Status::Converged);
      CHECK(out.evaluations == 0);
      CHECK(std::abs(out.gap - (distance - 1.75)) <= rounding);
      CHECK((out.normal - direction).norm() <= rounding / distance);
      CHECK((out.contact - (Vector3(1, 2, 3) + (0.5 * (1.25 + distance - 0.5)) * direction)).norm() <=
            4 * rounding / std::min(1.0, distance));
    }
  }
}

TEST_CASE("a point in and outside an ellipsoid: its true distance") {
  const Ellipsoid body(Vector3(3, 2, 1));
  // The smallest radius of curvature is 1/3: no deeper than that, the nearest point of the boundary is where the normal says.
  for (const Vector3& n : random_normals(50, 32)) {
    for (const double distance : {-0.3, -0.1, -1e-6, 0.0, 1e-6, 0.1, 5.0, 1e3}) {
      const Vector3 foot = body.point(n);
      const Proximity out = find_proximity(body, {}, Sphere(0), upright_at(foot + distance * n), {.tolerance = 1e-13});
      const bool good = out.status == Status::Converged && std::abs(out.gap - distance) <= out.error + 1e-15 * (3 + distance) &&
                        (out.point1 - foot).norm() <= 1e-5;
      if (!good) FAIL_CHECK("n ", text(n), " distance ", distance, " gap ", out.gap, " status ", static_cast<int>(out.status));
    }
  }
  // From the centre, the shortest translation is through the thinnest side.
  const Proximity centre = find_proximity(body, {}, Sphere(0), {});
  CHECK(centre.status == Status::Converged);
  CHECK(std::abs(centre.gap + 1) <= 1e-9);
  CHECK(std::abs(std::abs(centre.normal.z()) - 1) <= 1e-4);
}

TEST_CASE("two points: the distance") {
  const Proximity out = find_proximity(Sphere(0), {}, Sphere(0), upright_at({3, 4, 0}));
  CHECK(out.status == Status::Converged);
  CHECK(std::abs(out.gap - 5) <= 4e-15);
}

TEST_CASE("a start on a saddle of s is left, upwards") {
  const Ellipsoid body(Vector3(3, 2, 1));
  Pose crosswise;  // x to y, y to z, z to x: half-axes 1, 3, 2 along x, y, z
  crosswise.rotation << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const Vector3 start = sign * Vector3::Unit(axis);
      const Proximity aligned = find_proximity(body, {}, body, {}, {}, &start);
      CHECK(aligned.status == Status::Converged);
      CHECK(std::abs(aligned.gap + 2) <= 1e-9);
      const Proximity crossed = find_proximity(body, {}, body, crosswise, {}, &start);
      CHECK(crossed.status == Status::Converged);
      CHECK(std::abs(crossed.gap + 3) <= 1e-9);  // z: 1 + 2, against 3 + 1 and 2 + 3
    }
  }
}

TEST_CASE("sweeping both bodies by spheres lowers the gap by the radii") {
  for (const ReferencePair& pair : reference_pairs()) {
    if (pair.nominal < 0) continue;
    const Rounded shape1(pair.shape1, 0.25), shape2(pair.shape2, 0.5);
    const Proximity out = find_proximity(shape1, pair.pose1, shape2, pair.pose2);
    // There is still one maximum: the core is apart, and the sweep moves every supporting plane alike.
    const double error = std::abs(out.gap - (pair.gap - 0.75));
    const bool good = out.status == Status::Converged && error <= out.error + 1e-14;
    if (!good) FAIL_CHECK(pair.name, " status ", static_cast<int>(out.status), " error ", error, " reported ", out.error);
  }
}
