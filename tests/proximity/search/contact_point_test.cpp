// Tests of the point at which a contact acts: halfway in depth, and at the sharper body's point.
#include "proximity/search/contact_point.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/callback_shape.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/reference_pairs.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

Pose at(const Vector3& position) { return {position, Matrix3::Identity()}; }

}  // namespace

TEST_CASE("the contact does not depend on the order of the bodies") {
  for (const ReferencePair& pair : reference_pairs()) {
    // Both have one evaluation with the same normal, so that only the choice of the point differs.
    GapFunction gap(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2),
        swapped(*pair.shape2, pair.pose2, *pair.shape1, pair.pose1);
    GapJet jet, swapped_jet;
    const Vector3 n = pair.normal.normalized();
    gap.evaluate(n, Order::Hessian, jet);
    swapped.evaluate(-(pair.pose2.rotation.transpose() * n), Order::Hessian, swapped_jet);
    const double tolerance = 1e-9 * pair.unit;
    const Vector3 contact = contact_point(gap, jet, StoppingRule(gap, tolerance, 1000));
    const Vector3 seen_from_body2 = contact_point(swapped, swapped_jet, StoppingRule(swapped, tolerance, 1000));
    const Vector3 from_body2 = pair.pose2.position + pair.pose2.rotation * seen_from_body2;
    // A boundary point of a flat face is known to no digit, but lies on the face: it has little weight.
    const double difference = (contact - from_body2).norm();
    if (pair.is_well && !(difference <= 1e-6 * pair.unit)) FAIL_CHECK(pair.name, " contacts differ by ", difference);
    const double height = std::abs(n.dot(contact - from_body2));
    if (!(height <= 1e-12)) FAIL_CHECK(pair.name, " heights differ by ", height);
  }
}

TEST_CASE("the contact lies halfway between the two supporting planes, or between them where that is beside a body") {
  int moved = 0;
  for (const ReferencePair& pair : reference_pairs()) {
    const Proximity out = find_proximity(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2);
    const double above1 = out.normal.dot(out.contact - out.point1);
    const double size = pair.surface1.half_axes().maxCoeff() + pair.surface2.half_axes().maxCoeff();
    if (std::abs(above1 - 0.5 * out.gap) <= 1e-14 * size) continue;
    ++moved;
    const double depth = std::max(-out.gap, 0.0);
    if (!(above1 <= 1e-7 * size && above1 >= -depth - 1e-7 * size)) FAIL_CHECK(pair.name, " height ", above1, " of ", out.gap);
  }
  CHECK(moved <= 10);  // of 1600, octahedral ones
}

TEST_CASE("the contact lies halfway beside the edge of a nearly polyhedral body, which the least tilt of the normal leaves") {
  const Superellipsoid body(Vector3(0.84, 0.54, 0.92), 1.0334, 104.5);
  const Box box(Vector3(1, 1, 1));
  for (const Vector3& direction : random_normals(3000, 82)) {
    const Vector3 n = (Vector3(0.8, -0.36, -0.48) + 0.1 * direction).normalized();
    const Pose pose{body.point(n) - box.point(-n) + 1e-9 * n.cross(direction), Matrix3::Identity()};
    GapFunction gap(body, Pose{}, box, pose);
    GapJet jet;
    gap.evaluate(n, Order::Hessian, jet);
    const double above_middle = n.dot(contact_point(gap, jet, StoppingRule(gap, 1e-9, 1000)) - jet.jet1.r) - 0.5 * n.dot(jet.d);
    if (!(std::abs(above_middle) <= 1e-15)) FAIL_CHECK("n ", n.transpose(), " height ", above_middle);
  }
}

TEST_CASE("two spheres: the middle of the overlap") {
  for (const Vector3& n : random_normals(20, 81)) {
    for (const double distance : {2.9, 3.0, 3.1}) {
      const Proximity out = find_proximity(Sphere(1), at({5, 6, 7}), Sphere(2), at(Vector3(5, 6, 7) + distance * n));
      const Vector3 middle = Vector3(5, 6, 7) + 0.5 * (1 + distance - 2) * n;
      CHECK((out.contact - middle).norm() <= 1e-14);
    }
  }
}

TEST_CASE("a flat face and a sharp vertex: at the vertex") {
  // The vertex of an octahedron, off the middle of the face of a box, pushed in by 0.01.
  const Superellipsoid box(Vector3(3, 2, 1), 100, 100), corner(Vector3::Constant(1), 1.05, 1.05);
  for (const Vector3& place : {Vector3(0, 0, 0), Vector3(1, 0.5, 0), Vector3(-2, -1.2, 0)}) {
    const Vector3 centre = place + Vector3(0, 0, 1 + 1 - 0.01);
    const Vector3 tip = centre - Vector3(0, 0, 1);
    for (const bool box_first : {true, false}) {
      const Proximity out = box_first ? find_proximity(box, {}, corner, at(centre)) : find_proximity(corner, at(centre), box, {});
      CHECK(out.status == Status::Converged);
      CHECK(std::abs(out.gap + 0.01) <= 1e-15);
      CHECK_MESSAGE((out.contact - (tip + Vector3(0, 0, 0.005))).norm() <= 1e-14, text(out.contact));
    }
  }
}

TEST_CASE("without radii of curvature: between the witness points, nearer to the sharper body's") {
  const auto ellipsoid = std::make_shared<Ellipsoid>(Vector3(3, 2, 1));
  const CallbackShape plain([=](const Vector3& n) { return ellipsoid->support(n); },
                            [=](const Vector3& n) { return ellipsoid->point(n); });
  const Ellipsoid sharper(Vector3(0.3, 0.2, 0.1));
  GapFunction gap(plain, {}, sharper, at({2.4, 1.8, 0.6}));
  GapJet jet;
  gap.evaluate(Vector3(2, 1.8, 0.7).normalized(), Order::Point, jet);
  const Vector3 across = jet.d - jet.s * jet.n;
  const Vector3 expected = jet.jet1.r + 0.5 * jet.s * jet.n + 10.0 / 11 * across;
  CHECK((contact_between(gap, jet) - expected).norm() <= 1e-7);
}
