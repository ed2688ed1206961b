// Tests of the time of impact against closed forms, invariants and a slow search.
#include "supernormal/impact/time_of_impact.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "random_motions.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "support/draw.hpp"
#include "support/traps.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

Motion moving(const Vector3& position, const Vector3& velocity, const Vector3& angular_velocity = Vector3::Zero()) {
  return {.pose = {position, Matrix3::Identity()}, .velocity = velocity, .angular_velocity = angular_velocity};
}

/// The first t in [0, horizon] at which `gap` is 0, by steps in which it cannot reach 0. The result is the horizon if there is
/// none.
double first_zero(const auto& gap, double fastest, double horizon) {
  double t = 0;
  for (double g = gap(t); g > 1e-15 && t < horizon; g = gap(t)) t += std::max(g / fastest, 1e-16);
  return std::min(t, horizon);
}

}  // namespace

TEST_CASE("pose_at: the centre moves in a straight line, and the body rotates about it") {
  Motion motion = moving({1, 2, 3}, {0.5, 0, 0}, {0, 0, 2});
  motion.centre = {1, 0, 0};
  const Pose pose = pose_at(motion, 0.75);
  CHECK((pose.rotation * Vector3::UnitX() - Vector3(std::cos(1.5), std::sin(1.5), 0)).norm() < 1e-15);
  CHECK((pose.rotation * motion.centre + pose.position - Vector3(2.375, 2, 3)).norm() < 1e-15);
  CHECK(pose_at(motion, 0).position == motion.pose.position);
}

TEST_CASE("balls: the time of impact is the root of a quadratic equation, or there is none") {
  RandomMotions random(1);
  int hits = 0, misses = 0;
  for (int k = 0; k < 3000; ++k) {
    const double r1 = random.uniform(0.1, 2), r2 = random.uniform(0.1, 2);
    const Vector3 c = (r1 + r2) * random.uniform(1.001, 5) * random.direction();
    const Vector3 v = random.uniform(0, 10) * random.direction();
    const Motion one = moving({5, 6, 7}, {3, 2, 1}, 100 * random.direction());
    const Motion other = moving(Vector3(5, 6, 7) + c, Vector3(3, 2, 1) + v, 100 * random.direction());
    const Impact impact = find_time_of_impact(Sphere(r1), one, Sphere(r2), other, 1);
    // |c + t v| = r1 + r2.
    const double A = v.squaredNorm(), B = c.dot(v), C = c.squaredNorm() - (r1 + r2) * (r1 + r2);
    const double discriminant = B * B - A * C;
    const double t = discriminant > 0 && B < 0 ? C / (-B + std::sqrt(discriminant)) : 2;
    if (std::abs(discriminant) < 1e-6 || std::abs(t - 1) < 1e-6) continue;
    if (t > 1) {
      ++misses;
      CHECK(impact.status == ImpactStatus::Apart);
      CHECK(impact.time == 1);
      CHECK(impact.proximity.gap > 0);
      CHECK(impact.proximity.gap <= (c + v).norm() - r1 - r2 + 1e-12);
      continue;
    }
    ++hits;
    REQUIRE(impact.status == ImpactStatus::Hits);
    const Vector3 n = (c + t * v).normalized();
    CHECK(impact.time <= t + 1e-14);
    CHECK((t - impact.time) * -n.dot(v) <= 1.1e-9 * std::min(r1, r2));
    CHECK((impact.proximity.normal - n).norm() < 5e-5);
    CHECK((impact.proximity.point1 - (one.pose.position + impact.time * one.velocity + r1 * impact.proximity.normal)).norm() <
          1e-12);
  }
  CHECK(hits > 100);
  CHECK(misses > 1000);
}

TEST_CASE("a rotating needle that falls on a plane hits at the time of the closed form, up to 1000 rad/s") {
  RandomMotions random(2);
  int hits = 0;
  for (int k = 0; k < 600; ++k) {
    const double length = random.uniform(0.2, 2), radius = random.uniform(0.01, 0.1), omega = std::pow(10, random.uniform(-1, 3));
    const double height = (length + radius) * random.uniform(0.1, 2), fall = random.uniform(-0.5, 3), phase = random.uniform(0, 6);
    Motion motion = moving({1, 2, height}, {3, 4, -fall}, {0, omega, 0});
    motion.pose.rotation = Eigen::AngleAxisd(phase, Vector3::UnitY()).toRotationMatrix();
    const auto capsule = [&](double t) { return height - fall * t - radius - length * std::abs(std::cos(phase + omega * t)); };
    const auto ellipsoid = [&](double t) {
      return height - fall * t - std::hypot(length * std::cos(phase + omega * t), radius * std::sin(phase + omega * t));
    };
    const double horizon = std::min(1.0, 20 / omega), fastest = std::abs(fall) + omega * length;
    const auto check = [&](const Impact& impact, auto gap, double rounding) {
      if (gap(0) < 0) {
        CHECK(impact.status == ImpactStatus::Overlapping);
        return;
      }
      const double t = first_zero(gap, fastest, horizon);
      if (gap(t) > 1e-9) {
        CHECK(impact.status == ImpactStatus::Apart);
        return;
      }
      ++hits;
      REQUIRE(impact.status == ImpactStatus::Hits);
      CHECK(gap(impact.time) >= -1e-14);
      CHECK(gap(impact.time) <= 1e-9 * radius + rounding);
      CHECK(impact.time <= t + 1e-15);
      CHECK(first_zero([&](double s) { return gap(s) - 1.1e-9 * radius - rounding; }, fastest, horizon) <= impact.time);
    };
    const Capsule needle(radius, length);
    const Ellipsoid spindle(Vector3(radius, radius, length));
    check(find_plane_time_of_impact(needle, motion, Vector3::UnitZ(), 0, horizon), capsule, 1e-12);
    check(find_plane_time_of_impact(spindle, motion, Vector3::UnitZ(), 0, horizon), ellipsoid, 1e-12);
    // Between two bodies, a wide box acts as a plane.
    const Motion floor = moving({0, 0, -50}, Vector3::Zero());
    check(find_time_of_impact(needle, motion, Box(Vector3(1000, 1000, 50)), floor, horizon), capsule, 5e-11);
    check(find_time_of_impact(Box(Vector3(1000, 1000, 50)), floor, spindle, motion, horizon), ellipsoid, 5e-11);
  }
  CHECK(hits > 1000);
}

TEST_CASE("bodies that touch at the start hit at once, unless they separate") {
  const Sphere ball(0.5);
  const Box brick(Vector3(0.5, 0.4, 0.3));
  const Ellipsoid oval(Vector3(0.5, 0.4, 0.3));
  const Box floor(Vector3(10, 10, 1));
  const Motion below = moving({0, 0, -1}, Vector3::Zero());
  for (const double gap : {0.0, 1e-10, -1e-10}) {
    CAPTURE(gap);
    for (const double speed : {-100.0, -1.0, -1e-3, 0.0}) {
      CHECK(find_time_of_impact(floor, below, ball, moving({0, 0, 0.5 + gap}, {3, 0, speed}), 1).time == 0);
      CHECK(find_time_of_impact(floor, below, ball, moving({0, 0, 0.5 + gap}, {3, 0, speed}), 1).status == ImpactStatus::Hits);
      CHECK(find_time_of_impact(floor, below, brick, moving({0, 0, 0.3 + gap}, {3, 0, speed}), 1).status == ImpactStatus::Hits);
      CHECK(find_time_of_impact(floor, below, brick, moving({0, 0, 0.3 + gap}, {3, 0, speed}, {0, 1, 0}), 1).status ==
            ImpactStatus::Hits);
    }
    for (const double speed : {1e-3, 1.0, 100.0}) {
      CAPTURE(speed);
      for (const Vector3& spin : {Vector3(0, 0, 0), Vector3(0, 0, 20), Vector3(0, 6, 0)}) {
        CHECK(find_time_of_impact(floor, below, ball, moving({0, 0, 0.5 + gap}, {3, 0, speed}, spin), 1).status ==
              ImpactStatus::Apart);
      }
      CHECK(find_time_of_impact(floor, below, brick, moving({0, 0, 0.3 + gap}, {3, 0, speed}), 1).status == ImpactStatus::Apart);
      CHECK(find_time_of_impact(floor, below, brick, moving({0, 0, 0.3 + gap}, {3, 0, speed}, {0, 0, 9}), 1).status ==
            ImpactStatus::Apart);
      // The brick rises more slowly than its edge comes down.
      const Impact edge = find_time_of_impact(floor, below, brick, moving({0, 0, 0.3 + gap}, {0, 0, speed}, {0, 3 * speed, 0}), 1);
      CHECK(edge.status == ImpactStatus::Hits);
      CHECK(edge.time == 0);
      CHECK(find_plane_time_of_impact(oval, moving({0, 0, 0.3 + gap}, {3, 0, speed}), Vector3::UnitZ(), 0, 1).status ==
            ImpactStatus::Apart);
    }
    // It separates and comes back with its other end.
    const Impact back = find_time_of_impact(floor, below, oval, moving({0, 0, 0.3 + gap}, {0, 0, 0.02}, {0, 1, 0}), 3);
    CHECK(back.status == ImpactStatus::Hits);
    CHECK((back.time == 0 || back.time > 0.07));
  }
  // Vertex on vertex: every normal of an octant is a common normal.
  const Box cube(Vector3(0.5, 0.5, 0.5));
  for (const Vector3& way : {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(1, 1, 1), Vector3(0.1, 1, -0.05)}) {
    CHECK(find_time_of_impact(cube, {}, cube, moving({1, 1, 1}, way), 1).status == ImpactStatus::Apart);
  }
  CHECK(find_time_of_impact(cube, {}, cube, moving({1, 1, 1}, {-1, -1, -1}), 1).status == ImpactStatus::Hits);
}

TEST_CASE("a deep overlap at the start is reported as such") {
  const Impact impact = find_time_of_impact(Sphere(1), {}, Ellipsoid(Vector3(1, 2, 3)), moving({0.5, 0, 0}, {10, 0, 0}), 1);
  CHECK(impact.status == ImpactStatus::Overlapping);
  CHECK(impact.time == 0);
  CHECK(impact.apart_until == 0);
  CHECK(impact.proximity.gap < 0);
  CHECK(impact.may_hit());
}

TEST_CASE("fly-bys with a clearance of a thousandth of the size pass, and with an overlap of as much hit") {
  RandomMotions random(4);
  for (int k = 0; k < 400; ++k) {
    CAPTURE(k);
    MovingPair pair = random.draw(kMotionKinds[0], 1);
    // In straight lines past each other: the normal at the nearest point is perpendicular to the motion.
    const Vector3 n = random.direction();
    const Vector3 v = std::pow(10, random.uniform(0, 3)) * n.unitOrthogonal();
    const double sign = k % 2 == 0 ? 1 : -1;
    Motion& motion1 = pair.one.motion;
    Motion& motion2 = pair.other.motion;
    const Vector3 point1 = motion1.pose.rotation * pair.one.shape->point(motion1.pose.rotation.transpose() * n);
    const Vector3 point2 = motion2.pose.rotation * pair.other.shape->point(-(motion2.pose.rotation.transpose() * n));
    const double clearance = sign * 1e-3 * pair.unit;
    const double time = 10 / v.norm();
    motion2.pose.position = point1 - point2 + clearance * n - time * v;
    motion1.velocity = Vector3::Zero();
    motion2.velocity = v;
    pair.horizon = 2 * time;
    const Impact impact = find_impact(pair);
    CHECK(impact.status == (sign > 0 ? ImpactStatus::Apart : ImpactStatus::Hits));
    CHECK(impact.evaluations < 400);
  }
}

TEST_CASE("a body that rolls or spins beside a wall takes a few evaluations") {
  const Box wall(Vector3(10, 10, 1));
  const Motion below = moving({0, 0, -1}, Vector3::Zero());
  const auto evaluations = [&](const Shape& shape, double height, const Vector3& spin, const Matrix3& rotation) {
    Motion motion = moving({0, 0, height + 1e-6}, {1, 0, 0}, spin);
    motion.pose.rotation = rotation;
    const Impact impact = find_time_of_impact(shape, motion, wall, below, 0.01);
    CHECK(impact.status == ImpactStatus::Apart);
    return impact.evaluations;
  };
  const Matrix3 lying = Eigen::AngleAxisd(std::numbers::pi / 2, Vector3::UnitX()).toRotationMatrix();
  const Matrix3 upright = Matrix3::Identity();
  CHECK(evaluations(Sphere(0.5), 0.5, {0, 1000, 0}, upright) <= 12);
  CHECK(evaluations(Cylinder(0.5, 1), 0.5, {0, 1000, 0}, lying) <= 20);
  CHECK(evaluations(Cylinder(0.5, 1), 1, {0, 0, 1000}, upright) <= 20);
  CHECK(evaluations(Capsule(0.5, 1), 0.5, {0, 1000, 0}, lying) <= 12);
  CHECK(evaluations(Superellipsoid(Vector3(0.5, 0.5, 0.1), 2, 8), 0.5, {0, 1000, 0}, lying) <= 12);
  CHECK(evaluations(Box(Vector3(0.5, 0.4, 0.3)), 0.3, {0, 0, 1000}, upright) <= 20);
  CHECK(evaluations(Rounded(std::make_shared<Ellipsoid>(Vector3(0.3, 0.3, 0.2)), 0.1), 0.4, {0, 1000, 0}, lying) <= 12);
}

TEST_CASE("the impact is the same when bodies are swapped, moved together or scaled, or time is scaled") {
  RandomMotions random(5);
  for (const MotionKind& kind : kMotionKinds) {
    for (int k = 0; k < 60; ++k) {
      const std::string name = std::string(kind.name) + " " + std::to_string(k);
      CAPTURE(name);
      const MovingPair pair = random.draw(kind, std::pow(10, random.uniform(-3, 0.3)));
      const Impact impact = find_impact(pair);
      if (impact.status == ImpactStatus::NotConverged) continue;
      const auto same = [&](const Impact& other, double length, double time) {
        if (other.status == ImpactStatus::NotConverged) return;
        CHECK(other.status == impact.status);
        if (impact.status != ImpactStatus::Hits) return;
        // At each impact the gap is within the tolerance, and no gap was before.
        const Real between = std::max(gap_at(pair, other.time / time), gap_at(pair, impact.time));
        CHECK(between <= 1.01e-9 * pair.unit);
        CHECK(other.proximity.gap <= 1.01e-9 * pair.unit * length);
      };
      MovingPair swapped = pair;
      std::swap(swapped.one, swapped.other);
      same(find_impact(swapped), 1, 1);

      MovingPair moved = pair;
      const Matrix3 rotation = random.rotation();
      const Vector3 place = 100 * random.direction(), drift = 10 * random.direction();
      for (Motion* motion : {&moved.one.motion, &moved.other.motion}) {
        motion->pose = {rotation * motion->pose.position + place, rotation * motion->pose.rotation};
        motion->velocity = rotation * motion->velocity + drift;
        motion->angular_velocity = rotation * motion->angular_velocity;
      }
      same(find_impact(moved), 1, 1);

      MovingPair slower = pair;
      for (Motion* motion : {&slower.one.motion, &slower.other.motion}) {
        motion->velocity /= 1024;
        motion->angular_velocity /= 1024;
      }
      slower.horizon *= 1024;
      const Impact later = find_impact(slower);
      CHECK(later.status == impact.status);
      CHECK(later.time == doctest::Approx(1024 * impact.time).epsilon(1e-12));
      CHECK(later.evaluations == impact.evaluations);
    }
  }
}

TEST_CASE("the long double bodies of the slow search agree with the support functions") {
  RandomMotions random(8);
  for (int k = 0; k < 2000; ++k) {
    const std::shared_ptr<const Shape> shape = random.shape();
    const Vector3 n = random.direction();
    CHECK(std::abs(long_body_of(*shape)->point(n.cast<Real>()).dot(n.cast<Real>()) - shape->support(n)) < 4e-15);
  }
}

TEST_CASE("random pairs: no impact is missed, late or early by a slow search") {
  for (const MotionKind& kind : kMotionKinds) {
    RandomMotions random(6);
    long evaluations = 0;
    int hits = 0, not_converged = 0, most = 0;
    const int pairs = draws(400);
    for (int k = 0; k < pairs; ++k) {
      const std::string name = std::string(kind.name) + " " + std::to_string(k);
      CAPTURE(name);
      const MovingPair pair = random.draw(kind, std::pow(10, random.uniform(-6, 0.3)));
      const Impact impact = trapped("an impact", [&] { return find_impact(pair); });
      const Verdict verdict = judge(pair, impact);
      CHECK(verdict.overlap_before <= verdict.rounding);
      CHECK(verdict.gap <= verdict.tolerance + verdict.rounding);
      CHECK(verdict.gap >= -verdict.rounding);
      CHECK(verdict.earlier <= 0);
      if (impact.status == ImpactStatus::Hits) ++hits;
      if (impact.status == ImpactStatus::NotConverged) ++not_converged;
      evaluations += impact.evaluations;
      most = std::max(most, impact.evaluations);
    }
    CHECK(not_converged <= pairs / 100);
    CHECK(hits > pairs / 10);
    MESSAGE(std::string(kind.name), ": evaluations ", static_cast<double>(evaluations) / pairs, " on average, at most ", most,
            "; hits ", hits, ", not converged ", not_converged);
  }
}

TEST_CASE("a horizon far beyond the impact costs no digits, and far beyond a fly-by few evaluations") {
  const Box wall(Vector3(0.5, 0.5, 0.5));
  const Ellipsoid oval(Vector3(1, 0.8, 0.6));
  for (const Vector3& spin : {Vector3(0, 0, 0), Vector3(0.3, 0.5, 0.2)}) {
    const Motion towards = moving({10, 0, 0}, {-1, 0, 0}, spin);
    const Motion beside = moving({10, 0, 0}, {-1, 0.9, 0}, spin);
    const Motion away = moving({10, 0, 0}, {1, 0, 0}, spin);
    const Impact near = find_time_of_impact(oval, towards, wall, {}, 10);
    const Impact near_plane = find_plane_time_of_impact(oval, towards, Vector3::UnitX(), 0, 10);
    REQUIRE(near.status == ImpactStatus::Hits);
    REQUIRE(near_plane.status == ImpactStatus::Hits);
    CHECK(near_plane.evaluations == (spin.isZero(0) ? 2 : 5));
    for (const double horizon : {1e3, 1e6, 1e9, 1e12, 1e15, 1e20, 1e30}) {
      CAPTURE(horizon);
      const Impact far = find_time_of_impact(oval, towards, wall, {}, horizon);
      CHECK(far.status == ImpactStatus::Hits);
      CHECK(std::abs(far.time - near.time) < 2e-10);
      const Impact far_plane = find_plane_time_of_impact(oval, towards, Vector3::UnitX(), 0, horizon);
      CHECK(far_plane.status == ImpactStatus::Hits);
      CHECK(std::abs(far_plane.time - near_plane.time) < 2e-10);
      const Impact past = find_time_of_impact(oval, beside, wall, {}, horizon);
      CHECK(past.status == ImpactStatus::Apart);
      CHECK(past.time == horizon);
      CHECK(past.proximity.gap > 0);
      CHECK(past.evaluations < 300);
      CHECK(find_plane_time_of_impact(oval, away, Vector3::UnitX(), 0, horizon).status == ImpactStatus::Apart);
    }
  }
  // A body that rotates in its place, by 0.2 rad.
  const Motion slow = moving({0, 0, 1.2}, {0, 0, 0}, {0, 1e-3, 0});
  const Box long_box(Vector3(2, 0.5, 0.5));
  const double first = find_time_of_impact(long_box, slow, wall, {}, 1000).time;
  CHECK(first > 100);
  for (const double horizon : {1e9, 1e15, 1e25}) {
    CHECK(std::abs(find_time_of_impact(long_box, slow, wall, {}, horizon).time - first) < 1e-6);
  }
}

TEST_CASE("time of impact: arguments out of range are refused, and motions that are not finite return InvalidInput") {
  const Sphere ball(1);
  const Motion there = moving({5, 0, 0}, {-1, 0, 0});
  CHECK_THROWS_AS(find_time_of_impact(ball, {}, ball, there, -1), std::invalid_argument);
  CHECK_THROWS_AS(find_time_of_impact(ball, {}, ball, there, std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  CHECK_THROWS_AS(find_plane_time_of_impact(ball, {}, Vector3::UnitX(), 0, std::numeric_limits<double>::infinity()),
                  std::invalid_argument);
  CHECK_THROWS_AS(find_time_of_impact(ball, {}, ball, there, 1, {.tolerance = 2}), std::invalid_argument);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e80}) {
    const Traps traps("an impact out of range");
    CHECK(find_time_of_impact(ball, {}, ball, moving({5, 0, 0}, {bad, 0, 0}), 1).status == ImpactStatus::InvalidInput);
    CHECK(find_time_of_impact(ball, {}, ball, moving({5, 0, 0}, {0, 0, 0}, {0, bad, 0}), 1).status == ImpactStatus::InvalidInput);
    CHECK(find_time_of_impact(ball, moving({bad, 0, 0}, {0, 0, 0}), ball, {}, 1).status == ImpactStatus::InvalidInput);
    CHECK(find_plane_time_of_impact(ball, {}, Vector3::UnitX(), bad, 1).status == ImpactStatus::InvalidInput);
  }
  // Just before the horizon, at it and just after it.
  for (const double gap : {-1e-10, 1e-10, 4e-10, 6e-10, 1e-8}) {
    CAPTURE(gap);
    const Impact impact = find_time_of_impact(ball, {}, ball, there, 3 - gap);
    CHECK(impact.status == (gap < 5e-10 ? ImpactStatus::Hits : ImpactStatus::Apart));
    const Impact turning = find_time_of_impact(ball, {}, ball, moving({5, 0, 0}, {-1, 0, 0}, {0, 0, 5}), 3 - gap);
    CHECK(turning.status == impact.status);
  }
  // Around the horizon, and with horizon 0.
  CHECK(find_time_of_impact(ball, {}, ball, there, 3.0001).status == ImpactStatus::Hits);
  CHECK(find_time_of_impact(ball, {}, ball, there, 2.9999).status == ImpactStatus::Apart);
  CHECK(find_time_of_impact(ball, {}, ball, there, 0).status == ImpactStatus::Apart);
  CHECK(find_time_of_impact(ball, {}, ball, moving({2, 0, 0}, {-1, 0, 0}), 0).status == ImpactStatus::Hits);
}

TEST_CASE("time of impact: a plane's normal without unit length is refused") {
  const Sphere ball(1);
  const Motion there = moving({5, 0, 0}, {-1, 0, 0});
  for (const double length : {0.0, 1e-200, 0.5, 1 + 1e-5, 2.0, 1e200}) {
    CHECK_THROWS_WITH_AS(find_plane_time_of_impact(ball, there, length * Vector3::UnitX(), 0, 10),
                         doctest::Contains("length of plane_normal = "), std::invalid_argument);
  }
  CHECK(find_plane_time_of_impact(ball, there, (1 + 1e-7) * Vector3::UnitX(), 0, 10).status == ImpactStatus::Hits);
}

TEST_CASE("points meet when they are at one place") {
  const Sphere point(0);
  CHECK(find_time_of_impact(point, {}, point, {}, 1).status == ImpactStatus::Hits);
  CHECK(find_time_of_impact(point, {}, point, moving({0, 0, 0}, {1, 0, 0}), 1).may_hit());
  const Impact straight = find_time_of_impact(point, {}, point, moving({3, 0, 0}, {-1, 0, 0}), 10);
  CHECK(straight.status == ImpactStatus::Hits);
  CHECK(std::abs(straight.time - 3) < 1e-13);
  CHECK(find_time_of_impact(point, {}, point, moving({3, 1e-3, 0}, {-1, 0, 0}), 10).status == ImpactStatus::Apart);
}

TEST_CASE("balls that spin meet when they would without spin, to the same digits") {
  for (const double radius : {1e-3, 1.0, 1e7}) {
    for (const double spin : {1.0, 1e3, 1e6}) {
      CAPTURE(radius);
      CAPTURE(spin);
      const Motion here = moving({0, 0, 0}, {0, 0, 0}, {0, spin, 0});
      for (const double speed : {-1e-6, 1e-6, 1.0, 1e3}) {
        CAPTURE(speed);
        const double gap = 1e-4 * radius;
        const Motion there = moving({radius + 0.1 + gap, 0, 0}, {-speed, 0, 0}, {0, 0, -spin});
        const Impact impact = find_time_of_impact(Sphere(radius), here, Sphere(0.1), there, 1e12);
        CHECK(impact.status == (speed > 0 ? ImpactStatus::Hits : ImpactStatus::Apart));
        if (speed > 0) CHECK(std::abs(impact.time * speed - gap) < 1e-9 * std::min(radius, 0.1) + 1e-13 * radius);
      }
    }
  }
}

TEST_CASE("a body that spins beside a wall, farther away than it reaches, takes a few evaluations at any speed") {
  const Superellipsoid brick(Vector3(1, 0.8, 0.6), 8, 8);
  const Box wall(Vector3(50, 50, 1));
  const double reach = Vector3(1, 0.8, 0.6).norm();
  for (const double spin : {10.0, 1e6, 1e12}) {
    CAPTURE(spin);
    const Motion beside = moving({7, 3, 1 + reach + 0.1}, {20, 0, 0}, {0.6 * spin, 0.8 * spin, 0});
    const Impact apart = find_time_of_impact(brick, beside, wall, {}, 1);
    CHECK(apart.status == ImpactStatus::Apart);
    CHECK(apart.evaluations < 200);
    CHECK(find_plane_time_of_impact(brick, beside, Vector3::UnitZ(), 1, 1).status == ImpactStatus::Apart);
    // Until the ball about it touches the wall, there is no impact. Rounding grows with the paths of its points.
    const Motion falling = moving({7, 3, 1 + reach + 0.1}, {20, 0, -1}, {0.6 * spin, 0.8 * spin, 0});
    CHECK(find_time_of_impact(brick, falling, wall, {}, 1).apart_until >= 0.1 - 1e-9 - 1e-14 * spin);
  }
}
