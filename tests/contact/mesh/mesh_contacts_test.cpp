// Contacts of a body with triangles, against contacts with a plane where the surface is flat, and with a solid hull where it is
// one.
#include "supernormal/contact/mesh_contacts.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <numbers>

#include "contact/mesh/mesh_triangle.hpp"
#include "supernormal/contact/body_box.hpp"
#include "supernormal/proximity/plane.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "support/draw.hpp"
#include "support/mesh_samples.hpp"
#include "support/relative.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

// The nearest of all points of the triangle. `kind`: 0 inside, 1 on an edge, 2 a vertex.
Vector3 nearest_point(const MeshTriangle& triangle, const Vector3& point, int& kind) {
  const Vector3 normal = normal_of(triangle);
  const std::array<Vector3, 3>& v = triangle.vertices;
  Vector3 nearest = point - normal * normal.dot(point - v[0]);
  kind = 0;
  bool is_inside = true;
  for (std::size_t k = 0; k < 3; ++k) is_inside = is_inside && normal.cross(v[(k + 1) % 3] - v[k]).dot(nearest - v[k]) >= 0;
  if (is_inside) return nearest;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3 edge = v[(k + 1) % 3] - v[k];
    const double share = std::clamp(edge.dot(point - v[k]) / edge.squaredNorm(), 0.0, 1.0);
    const Vector3 candidate = v[k] + share * edge;
    if ((candidate - point).norm() >= least) continue;
    least = (candidate - point).norm();
    nearest = candidate;
    kind = share > 0 && share < 1 ? 1 : 2;
  }
  return nearest;
}

// Checks that the contact equals the contact with the plane, digit by digit.
void check_is_plane_contact(const std::vector<MeshContact>& contacts, const Proximity& plane) {
  if (plane.gap > 0) {
    CHECK(contacts.empty());
    return;
  }
  REQUIRE(contacts.size() == 1);
  const Proximity& contact = contacts[0].proximity;
  CHECK(contact.gap == plane.gap);
  CHECK(contact.normal == plane.normal);
  CHECK(contact.contact == plane.contact);
  CHECK(contact.point1 == plane.point1);
  CHECK(contact.point2 == plane.point2);
  CHECK(contact.status == Status::Converged);
}

}  // namespace

TEST_CASE("a tessellated floor gives the contact of a plane, with the same digits") {
  Draw draw(1);
  const Vector3 up = Vector3::UnitZ();
  const std::vector<MeshTriangle> coarse = floor_mesh(4, 4).placed();
  const std::vector<MeshTriangle> fine = floor_mesh(24, 0.25).placed();
  for (int i = 0; i < draws(2000); ++i) {
    CAPTURE(i);
    const std::unique_ptr<Shape> body = draw_body(draw);
    Pose pose{draw.in_box({1, 1, 0}), draw.rotation()};
    const double smallest = body->half_extents().minCoeff();
    const double height = find_plane_proximity(*body, pose, up, 0).gap;
    pose.position.z() = draw.uniform(-0.3, 0.05) * smallest - height;
    // The deepest point is exactly above a vertex, and exactly above an edge.
    if (i % 4 == 1) pose = {{0.25 * (i % 3), -0.25 * (i % 5), 0.9 * body->half_extents().z()}, Matrix3::Identity()};
    if (i % 4 == 2) pose = {{draw.uniform(-1, 1), 0.25, 0.9 * body->half_extents().z()}, Matrix3::Identity()};
    const Proximity plane = find_plane_proximity(*body, pose, up, 0);
    check_is_plane_contact(contacts_of(*body, pose, coarse), plane);
    check_is_plane_contact(contacts_of(*body, pose, fine), plane);
  }
}

TEST_CASE("a rotated and tessellated floor far from the origin gives the contact of a plane") {
  Draw draw(2);
  for (int i = 0; i < 200; ++i) {
    CAPTURE(i);
    const Pose floor{draw.in_box({1e4, 1e4, 1e4}), draw.rotation()};
    const std::vector<MeshTriangle> triangles = floor_mesh(12, 0.5).placed(floor);
    const std::unique_ptr<Shape> body = draw_body(draw);
    const Vector3 up = floor.rotation.col(2);
    Pose pose{floor.position + floor.rotation * draw.in_box({1, 1, 0}), draw.rotation()};
    const double smallest = body->half_extents().minCoeff();
    const double height = find_plane_proximity(*body, {Vector3::Zero(), pose.rotation}, up, 0).gap;
    const double depth = draw.uniform(0.001, 0.3) * smallest;
    pose.position -= (depth + height) * up;
    const std::vector<MeshContact> contacts = contacts_of(*body, pose, triangles);
    REQUIRE(contacts.size() == 1);
    CHECK(std::abs(contacts[0].proximity.gap + depth) < 2e-11);  // ten units in the last place of 10 km
    CHECK((contacts[0].proximity.normal + up).norm() < 2e-11);
  }
}

TEST_CASE("a rod deep in a fine floor has its contact, although only triangles in its box are known") {
  const Ellipsoid rod({0.05, 0.05, 1});
  const std::vector<MeshTriangle> floor = floor_mesh(40, 0.1).placed();
  int standing = 0;
  Draw draw(7);
  for (int i = 0; i < 300; ++i) {
    CAPTURE(i);
    Pose pose{draw.in_box({0.1, 0.1, 0}), Eigen::AngleAxisd(draw.uniform(0, 1.5), Vector3::UnitY()).toRotationMatrix()};
    pose.position.z() = -draw.uniform(0.01, 0.9) - find_plane_proximity(rod, pose, Vector3::UnitZ(), 0).gap;
    const BodyBox box = BodyBox::of(rod);
    std::vector<MeshTriangle> near;
    for (const MeshTriangle& triangle : floor) {
      if (box.touches(pose, triangle.vertices)) near.push_back(triangle);
    }
    const Proximity plane = find_plane_proximity(rod, pose, Vector3::UnitZ(), 0);
    if (plane.gap < -2 * rod.support(pose.rotation.transpose() * Vector3::UnitZ())) {
      CHECK(contacts_of(rod, pose, near).empty());  // the whole body is behind the plane
      continue;
    }
    ++standing;
    check_is_plane_contact(contacts_of(rod, pose, near), plane);
  }
  CHECK(standing > 200);
}

// A flat side has nearly the same normal at an edge and at the end of the edge. The contact is at the end once the body reaches
// beyond it.
TEST_CASE(
    "a body nearly parallel to a closed mesh, beyond the end of an edge, has the gap of the solid hull at a place in the mesh") {
  Draw draw(4);
  int overlapping = 0;
  for (int i = 0; i < 1200; ++i) {
    CAPTURE(i);
    const Vector3 half_lengths{draw.uniform(0.1, 1), draw.uniform(0.1, 1), 1};
    const TriangleMesh mesh = box_mesh(half_lengths);
    const Polytope hull(mesh.vertices);
    const double radius = draw.uniform(0.1, 1);
    const double half_length = draw.uniform(0.1, 1);
    const Cylinder cylinder(radius, half_length);
    const Capsule capsule(radius, half_length);
    const Superellipsoid can({radius, radius, half_length}, 2, 100);
    const Shape& body = i % 3 == 0 ? static_cast<const Shape&>(cylinder) : i % 3 == 1 ? static_cast<const Shape&>(capsule) : can;
    const double tilt = std::pow(10.0, draw.uniform(-9, -2));
    const Pose mesh_pose{Vector3::Zero(), Eigen::AngleAxisd(tilt, draw.direction()).toRotationMatrix()};
    const double smallest = std::min(body.half_extents().minCoeff(), hull.half_extents().minCoeff());
    const double wanted = -smallest * std::pow(10.0, draw.uniform(-6, -2));
    const Pose pose = placed_at_gap(wanted, body, Matrix3::Identity(), hull, mesh_pose, draw.direction());
    const Proximity expected = find_proximity(body, pose, hull, mesh_pose);
    if (!(expected.gap < -1e-7 * smallest)) continue;
    ++overlapping;
    const std::vector<MeshContact> contacts = contacts_of(body, pose, mesh.placed(mesh_pose));
    REQUIRE(!contacts.empty());
    const Proximity& deepest = contacts[0].proximity;
    CHECK(std::abs(deepest.gap - expected.gap) < 1e-9 * smallest);
    const Vector3 place = mesh_pose.rotation.transpose() * deepest.contact;
    CHECK(((place.cwiseAbs() - half_lengths).array() < 1e-9 * smallest - deepest.gap).all());
  }
  CHECK(overlapping > 1000);
}

TEST_CASE("a ball on one triangle has the face's normal where it stands, and the distance of its centre beside the border") {
  Draw draw(4);
  int standing[3] = {0, 0, 0};
  int beside[3] = {0, 0, 0};
  for (int i = 0; i < 24000; ++i) {
    CAPTURE(i);
    MeshTriangle triangle;
    for (Vector3& vertex : triangle.vertices) vertex = draw.in_box({1, 1, 1});
    const Vector3 normal = normal_of(triangle);
    const double radius = draw.uniform(0.3, 1);
    const Sphere ball(radius);
    const Vector3 above = (triangle.vertices[0] + triangle.vertices[1] + triangle.vertices[2]) / 3;
    const Pose pose{above + draw.in_box({1.5, 1.5, 1.5}), draw.rotation()};
    const double height = normal.dot(pose.position - above);
    if (!(height > 1e-6)) continue;
    int kind = 0;
    const Vector3 nearest = nearest_point(triangle, pose.position, kind);
    const double gap = (pose.position - nearest).norm() - radius;
    const std::vector<MeshContact> contacts = contacts_of(ball, pose, {&triangle, 1});
    if (gap > 1e-9) {
      CHECK(contacts.empty());
    } else if (gap < -1e-9) {
      const double below = (radius - height) / (2 * radius);  // the depth below the plane, as a fraction of the ball's diameter
      REQUIRE(!contacts.empty());
      if (below > 0.2) REQUIRE(contacts.size() == 1);
      const Proximity& contact = contacts[0].proximity;
      const Vector3 inward = (nearest - pose.position).normalized();
      if (kind > 0 && below < 0.1) {
        ++standing[kind];
        const double aside = std::sqrt((pose.position - nearest).squaredNorm() - height * height);
        CHECK(std::abs(contact.gap - (height - std::sqrt(radius * radius - aside * aside))) < 1e-9);
        for (const MeshContact& each : contacts) CHECK((each.proximity.normal + normal).norm() < 1e-12);
      } else if (kind == 0 || below > 0.2) {
        ++beside[kind];
        CHECK(std::abs(contact.gap - gap) < 1e-9);
        CHECK((contact.normal - inward).norm() < 1e-6);
      } else {
        // In between the normal is between the two.
        CHECK(contact.normal.cross(inward).dot(normal.cross(inward)) <= 1e-9);
        CHECK(contact.normal.dot(inward) >= -normal.dot(inward) - 1e-9);
        continue;
      }
      CHECK((contact.point2 - nearest).norm() < 1e-6);
    }
  }
  for (const int kind : {1, 2}) CHECK(standing[kind] > 20);
  for (const int count : beside) CHECK(count > 20);
}

TEST_CASE("no contact with one triangle pushes behind it, and moving out by the deepest contact ends apart") {
  Draw draw(9);
  int contacts_seen = 0;
  for (int i = 0; i < draws(3000); ++i) {
    CAPTURE(i);
    MeshTriangle triangle;
    for (Vector3& vertex : triangle.vertices) vertex = draw.in_box({0.8, 0.8, 0.8});
    const std::unique_ptr<Shape> body = draw_body(draw);
    Pose pose{draw.in_box({0.8, 0.8, 0.8}), draw.rotation()};
    std::vector<MeshContact> contacts = contacts_of(*body, pose, {&triangle, 1});
    if (contacts.empty()) continue;
    for (const MeshContact& contact : contacts) {
      ++contacts_seen;
      CHECK(contact.proximity.normal.dot(normal_of(triangle)) <= 1e-9);
      CHECK(find_triangle_proximity(*body, pose, triangle.vertices, {}).gap < 1e-9);
    }
    for (int step = 0; step < 10 && !contacts.empty(); ++step) {
      pose.position += 1.001 * contacts[0].proximity.gap * contacts[0].proximity.normal;
      contacts = contacts_of(*body, pose, {&triangle, 1});
    }
    CHECK(find_triangle_proximity(*body, pose, triangle.vertices, {}).gap > -1e-9);
  }
  CHECK(contacts_seen > draws(1000));
}

TEST_CASE("steps, T-junctions and borders make no ghost contacts") {
  const Ellipsoid body({0.5, 0.7, 0.3});
  // A floor of two strips whose vertices do not match, and a body that moves across the seam.
  TriangleMesh floor;
  for (const double x : {-5.0, 0.0}) {
    for (const double y : {-5.0, 5.0}) floor.add({x, y, 0});
  }
  floor.triangles = {{0, 2, 1}, {2, 3, 1}};
  int previous = floor.add({0, -5, 0});
  int previous_far = floor.add({5, -5, 0});
  for (const double y : {-1.3, 0.1, 0.7, 5.0}) {
    const int near = floor.add({0, y, 0});
    const int far = floor.add({5, y, 0});
    floor.triangles.push_back({previous, previous_far, near});
    floor.triangles.push_back({previous_far, far, near});
    previous = near;
    previous_far = far;
  }
  Draw draw(6);
  for (int i = 0; i < 500; ++i) {
    CAPTURE(i);
    Pose pose{draw.in_box({0.3, 1, 0}), draw.rotation()};
    pose.position.z() = -0.02 - find_plane_proximity(body, pose, Vector3::UnitZ(), 0).gap;
    check_is_plane_contact(contacts_of(body, pose, floor.placed()), find_plane_proximity(body, pose, Vector3::UnitZ(), 0));
  }

  // A step down is along x = 0. The body is on the upper floor, beyond the step, and at its edge.
  TriangleMesh step;
  for (const double y : {-5.0, 5.0}) {
    step.add({-5, y, 0});
    step.add({0, y, 0});
    step.add({0, y, -0.1});
    step.add({5, y, -0.1});
  }
  for (int k = 0; k < 3; ++k) {
    step.triangles.push_back({k, k + 1, k + 4});
    step.triangles.push_back({k + 1, k + 5, k + 4});
  }
  const auto at = [&](double x, double z) { return contacts_of(body, {{x, 0, z}, Matrix3::Identity()}, step.placed()); };
  REQUIRE(at(-0.1, 0.29).size() == 1);
  CHECK(at(-0.1, 0.29)[0].proximity.normal == -Vector3::UnitZ());
  REQUIRE(at(0.2, 0.27).size() == 1);
  CHECK(at(0.2, 0.27)[0].proximity.normal.x() < -0.01);
  CHECK(at(0.2, 0.30).empty());
  REQUIRE(at(0.37, 0.19).size() == 2);  // the lower floor and the edge
  CHECK(at(0.37, 0.19)[0].proximity.gap + at(0.37, 0.19)[1].proximity.gap < -0.01);
}

TEST_CASE("creases of 1e-3 rad and steps of 1e-4 of the size are not merged as seams") {
  const Sphere ball(0.5);
  const auto strips = [](const std::vector<Vector3>& profile) {  // a floor along y, from the profile in x and z
    TriangleMesh mesh;
    for (const Vector3& point : profile) {
      for (const double y : {-5.0, 5.0}) mesh.add({point.x(), y, point.z()});
    }
    for (int k = 0; k + 3 < static_cast<int>(mesh.vertices.size()); k += 2) {
      mesh.triangles.push_back({k, k + 2, k + 3});
      mesh.triangles.push_back({k, k + 3, k + 1});
    }
    return mesh.placed();
  };
  const auto at = [&](const std::vector<MeshTriangle>& floor, double x, double depth) {
    return contacts_of(ball, {{x, 0.1, 0.5 - depth}, Matrix3::Identity()}, floor);
  };
  const double rise = 1e-3 * 5;
  const std::vector<MeshTriangle> roof = strips({{-5, 0, -0.5 * rise}, {0, 0, 0}, {5, 0, -0.5 * rise}});
  for (const double x : {-0.1, 0.0, 0.1}) {
    const std::vector<MeshContact> contacts = at(roof, x, 1e-3);
    REQUIRE(contacts.size() == 1);
    const double lean = x == 0 ? 0 : std::copysign(5e-4, -x);
    CHECK(std::abs(contacts[0].proximity.normal.x() - lean) < 1e-9);
  }
  const std::vector<MeshTriangle> valley = strips({{-5, 0, 0.5 * rise}, {0, 0, 0}, {5, 0, 0.5 * rise}});
  const std::vector<MeshContact> both = at(valley, 0, 1e-3);
  REQUIRE(both.size() == 2);
  CHECK(std::abs(both[0].proximity.normal.x() - both[1].proximity.normal.x()) > 0.99e-3);
  // A step of 1e-4 up, on the left: the ball on the lower floor meets its edge.
  const std::vector<MeshTriangle> step = strips({{-5, 0, 1e-4}, {0, 0, 1e-4}, {0, 0, 0}, {5, 0, 0}});
  const std::vector<MeshContact> contacts = at(step, 0.05, 0.01);
  REQUIRE(contacts.size() == 2);
  CHECK((contacts[0].proximity.normal + Vector3::UnitZ()).norm() < 1e-12);
  CHECK(contacts[1].proximity.normal.x() == relative(-0.1).epsilon(0.05));
}

TEST_CASE("a sheet is single-sided: a body beside or behind it has no contact") {
  const Ellipsoid rod({0.1, 0.1, 2});
  const std::vector<MeshTriangle> sheet = floor_mesh(4, 1).placed();
  CHECK(contacts_of(rod, {{0, 0, -2.001}, Matrix3::Identity()}, sheet).empty());
  CHECK(contacts_of(rod, {{0, 0, -1}, Matrix3::Identity()}, sheet).size() == 1);
  // The rod leans against the border, its lower end below the sheet: it touches the sheet from behind.
  const double offset = 0.1 * std::sqrt(2.0);
  const auto leaning = [](double angle) { return Eigen::AngleAxisd(angle, Vector3::UnitY()).toRotationMatrix(); };
  const double eighth = 0.25 * std::numbers::pi;
  CHECK(contacts_of(rod, {{2 + offset + 0.02, 0, 0}, leaning(eighth)}, sheet).empty());
  CHECK(contacts_of(rod, {{2 + offset - 0.02, 0, 0}, leaning(eighth)}, sheet).empty());
  // Its upper end is above the sheet: it leans against the border from in front.
  CHECK(contacts_of(rod, {{2 + offset + 0.02, 0, 0}, leaning(-eighth)}, sheet).empty());
  const std::vector<MeshContact> contacts = contacts_of(rod, {{2 + offset - 0.02, 0, 0}, leaning(-eighth)}, sheet);
  REQUIRE(contacts.size() == 1);
  CHECK(contacts[0].proximity.gap == relative(-0.02 * std::sqrt(0.5)).epsilon(0.01));
  CHECK((contacts[0].proximity.normal - Vector3(-1, 0, -1).normalized()).norm() < 0.01);
}

TEST_CASE("a body in a thin plate gets the shorter separating translation") {
  const Ellipsoid body({1, 1, 1});
  const std::vector<MeshTriangle> plate = box_mesh({20, 20, 0.1}).placed();
  for (const double height : {0.3, -0.2}) {
    const std::vector<MeshContact> contacts = contacts_of(body, {{0.3, 0.2, height}, Matrix3::Identity()}, plate);
    REQUIRE(contacts.size() == 1);
    CHECK(contacts[0].proximity.gap == relative(-1.1 + std::abs(height)));
    CHECK(contacts[0].proximity.normal.z() * height < 0);
  }
}

TEST_CASE("degenerate, repeated and unusable triangles change no contact") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const Ellipsoid body({0.5, 0.7, 0.3});
  const Pose pose{{0.1, 0.2, 0.28}, Matrix3::Identity()};
  const Proximity plane = find_plane_proximity(body, pose, Vector3::UnitZ(), 0);
  std::vector<MeshTriangle> triangles = floor_mesh(8, 0.3).placed();
  const std::vector<MeshTriangle> once = triangles;
  triangles.insert(triangles.end(), once.begin(), once.end());
  check_is_plane_contact(contacts_of(body, pose, triangles), plane);
  const Vector3 a{0.1, 0.2, 0};
  const Vector3 b{0.7, 0.2, 0};
  const std::array<std::array<Vector3, 3>, 8> bad = {{{a, a, a},
                                                      {a, b, a},
                                                      {a, b, 0.5 * (a + b)},
                                                      {a, b, Vector3(nan, 0, 0)},
                                                      {a, b, Vector3(0, infinity, 0)},
                                                      {a, b, Vector3(0, 1e200, 0)},
                                                      {Vector3(nan, nan, nan), a, b},
                                                      {a, b, Vector3(0.4, 0.2 + 1e-14, 0)}}};
  for (const auto& vertices : bad) {
    const MeshTriangle alone{vertices, 7};
    CHECK(contacts_of(body, pose, {&alone, 1}).empty());
    triangles.push_back(alone);
  }
  check_is_plane_contact(contacts_of(body, pose, triangles), plane);
  CHECK(contacts_of(body, pose, {}).empty());
  CHECK(contacts_of(body, {{nan, 0, 0}, Matrix3::Identity()}, once).empty());

  const MeshTriangle one{{Vector3(-1, -1, 0), Vector3(1, -1, 0), Vector3(0, 1, 0)}, 42};
  const std::vector<MeshContact> contacts = contacts_of(body, pose, {&one, 1});
  check_is_plane_contact(contacts, plane);
  CHECK(contacts[0].triangle == 42);
}

TEST_CASE("contacts come deepest first and name their triangle") {
  // A flat body lies on four posts of different heights.
  std::vector<MeshTriangle> triangles;
  const Superellipsoid body({2, 2, 0.5}, 8, 8);
  for (int i = 0; i < 4; ++i) {
    const Vector3 foot{i < 2 ? -0.8 : 0.8, i % 2 == 0 ? -0.8 : 0.8, 0};
    TriangleMesh post = box_mesh({0.1, 0.1, 1 + 0.01 * i});
    for (const MeshTriangle& triangle : post.placed({foot, Matrix3::Identity()})) {
      triangles.push_back(triangle);
      triangles.back().index += 100 * i;
    }
  }
  const std::vector<MeshContact> contacts = contacts_of(body, {{0, 0, 1.49}, Matrix3::Identity()}, triangles);
  REQUIRE(contacts.size() == 4);
  for (int i = 0; i < 4; ++i) {
    CHECK(contacts[static_cast<std::size_t>(i)].triangle / 100 == 3 - i);
    if (i > 0)
      CHECK(contacts[static_cast<std::size_t>(i)].proximity.gap >= contacts[static_cast<std::size_t>(i - 1)].proximity.gap);
  }
}

TEST_CASE("a ball on a ridge whose halves differ by the rounding of floats has one contact") {
  Draw draw(1);
  const Sphere ball(0.3);
  for (int i = 0; i < draws(2000); ++i) {
    CAPTURE(i);
    const Vector3 shift = draw.in_box({1, 1, 0.1});
    const auto vertex = [&](double x, double y) -> Vector3 {
      return shift + Vector3(x, y, -0.3 * std::abs(x)) + draw.in_box(Vector3::Constant(1e-7));
    };
    std::vector<MeshTriangle> ridge;
    for (const double x : {-1.0, 0.0}) {
      ridge.push_back({{vertex(x, -1), vertex(x + 1, -1), vertex(x + 1, 1)}, 0});
      ridge.push_back({{vertex(x, -1), vertex(x + 1, 1), vertex(x, 1)}, 1});
    }
    const Pose pose{shift + Vector3(draw.uniform(-0.02, 0.02), draw.uniform(-0.3, 0.3), 0.29), Matrix3::Identity()};
    CHECK(contacts_of(ball, pose, ridge).size() == 1);
  }
}

TEST_CASE("the contacts do not depend on the unit of length") {
  const auto find = [](unsigned seed, double unit) {
    Draw draw(seed);
    TriangleMesh floor = floor_mesh(8, 0.25);
    for (Vector3& vertex : floor.vertices) vertex = unit * (vertex + Vector3(0, 0, draw.uniform(-0.1, 0.1)));
    const Superellipsoid body(unit * Vector3(draw.uniform(0.2, 0.4), 0.3, 0.2), 2 + seed % 3 * 3, 2 + seed % 4 * 3);
    std::vector<MeshContact> contacts = contacts_of(body, {unit * Vector3(0.02, 0.01, 0.2), draw.rotation()}, floor.placed());
    for (MeshContact& contact : contacts) contact.proximity.gap /= unit;
    return contacts;
  };
  for (unsigned seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    const std::vector<MeshContact> wanted = find(seed, 1);
    for (const double unit : {0x1p-20, 0x1p-10, 0x1p10}) {
      const std::vector<MeshContact> found = find(seed, unit);
      REQUIRE(found.size() == wanted.size());
      for (std::size_t k = 0; k < found.size(); ++k) {
        CHECK(found[k].triangle == wanted[k].triangle);
        CHECK(found[k].proximity.gap == wanted[k].proximity.gap);
        CHECK(found[k].proximity.normal == wanted[k].proximity.normal);
      }
    }
  }
}

TEST_CASE("the contacts of a ball deep in rough ground are where its normal is theirs") {
  Draw draw(3);
  const Sphere ball(1);
  for (int i = 0; i < 200; ++i) {
    CAPTURE(i);
    TriangleMesh ground = floor_mesh(8, 0.7);
    for (Vector3& vertex : ground.vertices) vertex.z() = draw.uniform(0, 0.6);
    const Pose pose{Vector3(draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(0.5, 1.2)), draw.rotation()};
    for (const MeshContact& contact : contacts_of(ball, pose, ground.placed()))
      CHECK((contact.proximity.contact - pose.position - contact.proximity.normal).norm() < 1e-6);
  }
}
