// Tests of the box around a body.
#include "supernormal/contact/body_box.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "contact/mesh/mesh_triangle.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "support/mesh_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

TEST_CASE("the box of a body selects the triangles at distance 0") {
  Draw draw(61);
  int touching = 0;
  for (int i = 0; i < 5000; ++i) {
    CAPTURE(i);
    const BodyBox box{draw.in_box({0.3, 0.3, 0.3}), {draw.uniform(0.1, 1), draw.uniform(0.1, 1), draw.uniform(0.1, 1)}};
    const Pose pose{draw.in_box({3, 3, 3}), draw.rotation()};
    std::array<Vector3, 3> vertices;
    for (Vector3& vertex : vertices) vertex = pose.position + draw.in_box({1.5, 1.5, 1.5});
    if (i % 10 == 0) vertices[2] = vertices[1];
    const Pose of_box{pose.position + pose.rotation * box.centre, pose.rotation};
    const double gap = find_triangle_proximity(Box(box.half_lengths), of_box, vertices, {}).gap;
    if (std::abs(gap) < 1e-9) continue;
    CHECK(box.touches(pose, vertices) == (gap < 0));
    if (gap < 0) ++touching;
  }
  CHECK(touching > 1000);
  CHECK(touching < 4000);
}

TEST_CASE("the box of a body does not rule out triangles that are not finite") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const BodyBox box{Vector3::Zero(), Vector3::Ones()};
  CHECK(box.touches({}, {Vector3(nan, nan, nan), Vector3(nan, nan, nan), Vector3(nan, nan, nan)}));
}

TEST_CASE("the box of an asymmetric body reaches to both its ends") {
  const std::array<Vector3, 2> points = {Vector3(0.5, -2, 0.25), Vector3(0, 0, 0.75)};
  const BodyBox box = BodyBox::of(Polytope(points));
  CHECK(box.centre == Vector3(0.25, -1, 0.5));
  CHECK(box.half_lengths == Vector3(0.25, 1, 0.25));
  CHECK(box.contains({0, 0, 0.25}, 0));
  CHECK(!box.contains({-0.01, 0, 0.25}, 0));
  CHECK(box.contains({-0.01, 0, 0.25}, 0.02));
}
