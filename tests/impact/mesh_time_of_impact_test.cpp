// Tests of the time of impact with triangles.
#include "supernormal/impact/mesh_time_of_impact.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "random_motions.hpp"
#include "supernormal/contact/mesh_contacts.hpp"
#include "support/mesh_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

TEST_CASE("triangles: at the impact the nearest triangle is within the tolerance, and none is nearer before") {
  TriangleMesh hills = floor_mesh(8, 1);
  for (Vector3& v : hills.vertices) v.z() = 0.4 * std::sin(1.3 * v.x()) * std::cos(0.9 * v.y());
  const std::vector<MeshTriangle> triangles = hills.placed();
  RandomMotions random(11);
  int hits = 0;
  for (int k = 0; k < 40; ++k) {
    CAPTURE(k);
    const auto shape = random.shape();
    Motion motion, mesh;
    motion.pose = {Vector3(random.uniform(-2, 2), random.uniform(-2, 2), 3), random.rotation()};
    motion.velocity = Vector3(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-6, 0));
    motion.angular_velocity = random.uniform(0, 3) * random.direction();
    if (k % 2 == 0) {
      mesh.velocity = random.uniform(0, 2) * random.direction();
      mesh.angular_velocity = random.uniform(0, 0.5) * random.direction();
    }
    const MeshImpact found = find_mesh_time_of_impact(*shape, motion, triangles, mesh, 1);
    REQUIRE(found.impact.status != ImpactStatus::InvalidInput);
    CHECK(found.impact.status != ImpactStatus::NotConverged);
    const auto gap = [&](double t) {
      const Pose pose = pose_at(motion, t), frame = pose_at(mesh, t);
      const Pose seen{frame.rotation.transpose() * (pose.position - frame.position), frame.rotation.transpose() * pose.rotation};
      return find_nearest_triangle(*shape, seen, triangles, {}).proximity.gap;
    };
    for (int sample = 0; sample < 30; ++sample) CHECK(gap(found.impact.time * sample / 30) > -1e-12);
    CHECK((found.triangle >= 0) == found.impact.may_hit());
    if (found.impact.status != ImpactStatus::Hits) continue;
    ++hits;
    CHECK(std::abs(gap(found.impact.time)) <= 2e-9);
  }
  CHECK(hits > 10);
}

TEST_CASE("triangles: at the impact with a closed mesh no contact is deeper than the tolerance") {
  // For an open mesh, a body that touches an edge or a vertex from outside is far below the planes of the faces.
  const std::vector<MeshTriangle> tetrahedron = hull_mesh({{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}, {0, 0, 1}}).placed();
  RandomMotions random(12);
  MeshContacts contacts;
  int hits = 0;
  for (int k = 0; k < 400; ++k) {
    CAPTURE(k);
    const auto shape = random.shape();
    Motion motion;
    motion.pose = {5 * random.direction(), random.rotation()};
    motion.velocity = 0.8 * random.direction() - motion.pose.position;
    const Impact found = find_mesh_time_of_impact(*shape, motion, tetrahedron, {}, 2).impact;
    if (found.status != ImpactStatus::Hits) continue;
    ++hits;
    for (const double dt : {-1e-11, -1e-13, 0.0, 1e-13, 1e-11}) {
      for (const MeshContact& contact : contacts.find(*shape, pose_at(motion, found.time + dt), tetrahedron)) {
        CHECK(contact.proximity.gap > -1e-8);
      }
    }
  }
  CHECK(hits > 200);
}

TEST_CASE("triangles: without triangles bodies are apart") {
  const MeshImpact found = find_mesh_time_of_impact(Sphere(1), {}, {}, {}, 2);
  CHECK(found.impact.status == ImpactStatus::Apart);
  CHECK(found.impact.time == 2);
  CHECK(found.triangle == -1);
}

TEST_CASE("triangles: without triangles, too, arguments out of range are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double horizon : {-1.0, nan, 2e30}) {
    CHECK_THROWS_WITH_AS(find_mesh_time_of_impact(Sphere(1), {}, {}, {}, horizon), doctest::Contains("horizon = "),
                         std::invalid_argument);
  }
  CHECK_THROWS_WITH_AS(find_mesh_time_of_impact(Sphere(1), {}, {}, {}, 1, {.tolerance = 7}), doctest::Contains("tolerance = 7"),
                       std::invalid_argument);
  Motion lost;
  lost.velocity.x() = nan;
  CHECK(find_mesh_time_of_impact(Sphere(1), lost, {}, {}, 1).impact.status == ImpactStatus::InvalidInput);
  CHECK(find_mesh_time_of_impact(Sphere(1), {}, {}, lost, 1).impact.status == ImpactStatus::InvalidInput);
}
