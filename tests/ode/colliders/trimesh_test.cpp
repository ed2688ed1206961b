// Tests of our bodies and dTriMesh.
#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <numbers>

#include "ode/mesh_fixture.hpp"
#include "ode/terrain.hpp"
#include "support/draw.hpp"
#include "support/ode_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;
using namespace supernormal;

namespace {

void check_same_but_for_side(const std::vector<dContactGeom>& contacts, const std::vector<dContactGeom>& reference) {
  REQUIRE(contacts.size() == reference.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    CHECK(contacts[i].depth == reference[i].depth);
    CHECK(to_vec(contacts[i].normal) == to_vec(reference[i].normal));
    // The manifold points of a wide overlap are found about the deepest point, whose last digits differ.
    CHECK(norm(to_vec(contacts[i].pos) - to_vec(reference[i].pos)) <= (contacts[i].depth > 0 ? 0 : 1e-12));
  }
}

// Sides 1 and 2 are ours and the mesh's. ODE swaps the contacts of a call in the other order.
void check_swapped(const std::vector<dContactGeom>& one, const std::vector<dContactGeom>& other) {
  REQUIRE(one.size() == other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    CHECK(one[i].g1 == other[i].g2);
    CHECK(one[i].g2 == other[i].g1);
    CHECK(one[i].side1 == other[i].side2);
    CHECK(one[i].side2 == other[i].side1);
    CHECK(one[i].depth == other[i].depth);
    CHECK(to_vec(one[i].normal) == -1.0 * to_vec(other[i].normal));
  }
}

struct Told {
  std::vector<int> indices;
  dGeomID by = nullptr;
};
Told told;

void tell(dGeomID /*mesh*/, dGeomID geom, const int* indices, int count) {
  told.indices.assign(indices, indices + count);
  told.by = geom;
}

int wants_even(dGeomID /*mesh*/, dGeomID /*geom*/, int index) { return index % 2 == 0 ? 1 : 0; }

/// A closed ring of flat faces: convex outside, with saddles inside.
TriangleMesh ring_mesh(double ring_radius, double tube_radius, int around, int about) {
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < about; ++j) {
      const double u = 2 * std::numbers::pi * i / around;
      const double v = 2 * std::numbers::pi * j / about;
      const double r = ring_radius + tube_radius * std::cos(v);
      mesh.add({r * std::cos(u), r * std::sin(u), tube_radius * std::sin(v)});
    }
  }
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < about; ++j) {
      const auto at = [&](int k, int l) { return (k % around) * about + l % about; };
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

/// A closed block with a step in its top, 2 x 1 x 1 without a quarter. It has convex and concave edges.
TriangleMesh step_mesh() {
  TriangleMesh mesh;
  const std::array<std::array<double, 2>, 6> outline = {{{-1, -0.5}, {1, -0.5}, {1, 0}, {0, 0}, {0, 0.5}, {-1, 0.5}}};
  for (const double y : {-0.5, 0.5}) {
    for (const auto& [x, z] : outline) mesh.add({x, y, z});
  }
  for (int k = 0; k < 6; ++k) {
    const int next = (k + 1) % 6;
    mesh.triangles.push_back({k, next, next + 6});
    mesh.triangles.push_back({k, next + 6, k + 6});
  }
  // Each side consists of two convex pieces.
  const std::array<std::array<int, 3>, 4> side = {{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}};
  for (const auto& [a, b, c] : side) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a + 6, b + 6, c + 6});
  }
  for (auto& [a, b, c] : mesh.triangles) std::swap(b, c);
  return mesh;
}

const std::array<TriangleMesh, 3>& hollow_meshes() {
  static const std::array<TriangleMesh, 3> meshes = {ring_mesh(1, 0.4, 12, 8), ring_mesh(1, 0.3, 40, 20), step_mesh()};
  return meshes;
}

constexpr int kCells = 40;

/// Triangles over a square about a place, with the height at each vertex.
TriangleMesh sheet(const Vec& middle, double cell, const std::function<double(double x, double y)>& height) {
  TriangleMesh mesh = sheet_mesh(kCells, kCells, 1);
  for (Vector3& vertex : mesh.vertices) {
    const double x = middle[0] + cell * (vertex.x() - 0.5 * kCells), y = middle[1] + cell * (vertex.y() - 0.5 * kCells);
    vertex = {x, y, height(x, y)};
  }
  return mesh;
}

/// How far a vertex at this distance from the origin of its mesh may be rounded, m.
double rounding_at(double distance) { return 0.5 * std::numeric_limits<float>::epsilon() * distance; }

/// Checks bodies of 0.1 m on a floor of cells within a slope: the contacts have the number, the normals and the depth of those with
/// the plane.
void check_is_plane(dGeomID floor, dGeomID plane, const Vec& middle, double cell, double rounding) {
  dVector4 level;
  dGeomPlaneGetParams(plane, level);
  const Vec up = to_vec(level);
  Random random(5);
  World world;
  for (int i = 0; i < 12; ++i) {
    CAPTURE(i);
    const dReal exponent = i % 3 == 0 ? 2 : 20;
    const Geom geom(snCreateSuperellipsoid(nullptr, dReal(0.1), dReal(0.07), dReal(0.05), exponent, exponent));
    const dBodyID body = world.add(geom, 1000);
    dMatrix3 turn;
    dRFromZAxis(turn, dReal(up[0]), dReal(up[1]), dReal(up[2]));
    dBodySetRotation(body, turn);
    if (i % 3 != 1) random.turn(geom);
    place(geom, middle + 0.2 * random.direction() + up);
    for (int k = 0; k < 2; ++k) {
      snProximity now;
      snGeomProximity(geom, plane, &now);
      const double depth = k == 0 ? 0 : std::max(random.log_uniform(1e-5, 1e-3), 8 * rounding);
      move(geom, -(now.gap + depth) * up);
    }
    dBodySetLinearVel(body, 1, 0, dReal(-up[0] / up[2] - 0.05));
    for (const double time : {0.0, 0.005}) {
      CAPTURE(time);
      snGeomSetLookAhead(geom, dReal(time));
      const auto found = collide(geom, floor), wanted = collide(geom, plane);
      REQUIRE(found.size() == wanted.size());
      REQUIRE(!found.empty());
      CHECK(std::abs(double{found[0].depth} - double{wanted[0].depth}) < 2 * rounding);
      for (const dContactGeom& contact : found) CHECK(norm(to_vec(contact.normal) - up) < 4 * rounding / std::max(cell, 0.1));
    }
  }
}

}  // namespace

TEST_CASE_FIXTURE(OdeSession, "a floor of triangles gives the contacts of a dPlane, in both orders") {
  Random random(31);
  const MeshGeom floor(sheet_mesh(60, 60, 0.125));
  const Geom plane(dCreatePlane(nullptr, 0, 0, 1, 0));
  std::size_t contacts = 0;
  for (int i = 0; i < 2000; ++i) {
    CAPTURE(i);
    const Geom body(i % 3 == 0 ? snCreateSuperellipsoid(nullptr, 1, dReal(0.6), dReal(0.4), i % 2 == 0 ? 200 : dReal(1.02), 8)
                               : random_body(random));
    random.turn(body);
    const bool is_on_vertex = i % 5 == 0;
    place(body, is_on_vertex ? Vec{3.75, 3.5, 0} : Vec{random.uniform(2.5, 5), random.uniform(2.5, 5), 0});
    if (is_on_vertex) {
      const dQuaternion upright = {1, 0, 0, 0};
      dGeomSetQuaternion(body, upright);
    }
    const snProximity lowest = proximity_of(body, plane);
    move(body, {0, 0, random.uniform(-0.12, 0.02) - lowest.gap});
    const auto on_floor = collide(body, floor);
    check_same_but_for_side(on_floor, collide(body, plane));
    check_swapped(on_floor, collide(floor, body));
    contacts += on_floor.size();
    for (const dContactGeom& contact : on_floor) {
      CHECK(contact.side1 == -1);
      CHECK(contact.side2 >= 0);
      CHECK(contact.side2 < 7200);
    }
    const snProximity of_plane = proximity_of(body, plane), of_floor = proximity_of(body, floor);
    CHECK(std::abs(of_plane.gap - of_floor.gap) < 1e-9);
  }
  CHECK(contacts > 1500);
}

TEST_CASE_FIXTURE(OdeSession, "the distance of a mesh is the distance of its nearest triangle, at any distance") {
  Random random(34);
  const MeshGeom block(box_mesh({1, 0.75, 0.5}));
  for (int i = 0; i < 300; ++i) {
    CAPTURE(i);
    const double radius = random.uniform(0.1, 0.6);
    const Geom ball(snCreateEllipsoid(nullptr, dReal(radius), dReal(radius), dReal(radius)));
    const Vec where = std::pow(10.0, random.uniform(0.3, 4)) * random.direction();
    place(ball, where);
    const Vec nearest = {std::clamp(where[0], -1.0, 1.0), std::clamp(where[1], -0.75, 0.75), std::clamp(where[2], -0.5, 0.5)};
    const snProximity one = proximity_of(ball, block), other = proximity_of(block, ball);
    CHECK(std::abs(one.gap - (norm(where - nearest) - radius)) < within_rounding(1e-9, norm(where)));
    CHECK(norm(to_vec(one.point2) - nearest) < 1e-4);
    CHECK(one.gap == other.gap);
    CHECK(to_vec(one.normal) == -1.0 * to_vec(other.normal));
    CHECK(to_vec(one.point1) == to_vec(other.point2));
  }
  // The body is between two distant blocks of one mesh. The nearer block is not in the first searched box.
  TriangleMesh two = box_mesh({0.5, 0.5, 0.5});
  const int count = static_cast<int>(two.vertices.size());
  const auto triangles = two.triangles;
  for (std::size_t i = 0; i < 8; ++i) two.add(two.vertices[i] + Vector3(100, 3, 0));
  for (const auto& t : triangles) two.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
  const MeshGeom blocks(two);
  const Geom body(snCreateEllipsoid(nullptr, 1, dReal(0.5), dReal(0.25)));
  for (const double x : {20.0, 40.0, 49.0, 51.0, 80.0}) {
    CAPTURE(x);
    place(body, {x, 0, 0});
    const snProximity proximity = proximity_of(body, blocks);
    const double to_first = x - 1.5;
    if (x < 50) {
      CHECK(proximity.gap == relative(to_first).epsilon(1e-9));
    } else {
      CHECK(proximity.gap < to_first);
      CHECK(proximity.gap > 98.5 - x);
      CHECK(proximity.point2[0] == relative(99.5));
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "a body in a corner of a mesh room has one contact for each wall, the deepest first") {
  const MeshGeom room(box_mesh({3, 4, 5}, true));
  const Geom body(snCreateEllipsoid(nullptr, 1, 1, 1));
  place(body, {2.0625, -3.125, 4.25});
  const auto contacts = collide(body, room);
  REQUIRE(contacts.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) CHECK(contacts[i].depth == relative(std::array{0.25, 0.125, 0.0625}[i]));
  CHECK(contacts[0].normal[2] == -1);  // the normal points into the body
  CHECK(contacts[1].normal[1] == 1);
  CHECK(contacts[2].normal[0] == -1);
}

TEST_CASE_FIXTURE(OdeSession,
                  "a flat body in a corner of a mesh room has a contact with each wall, and equal shares of the others") {
  const MeshGeom room(box_mesh({3, 4, 5}, true));
  const Geom body(snCreateSuperellipsoid(nullptr, dReal(0.3), dReal(0.2), dReal(0.25), 40, 40));
  place(body, {3 - 0.295, 4 - 0.195, 5 - 0.245});
  for (int most = 1; most <= 12; ++most) {
    CAPTURE(most);
    std::array<int, 3> of_wall{};
    const auto contacts = collide(body, room, most);
    for (const dContactGeom& contact : contacts) {
      for (std::size_t axis = 0; axis < 3; ++axis) of_wall[axis] += std::abs(contact.normal[axis]) > dReal(0.9) ? 1 : 0;
    }
    CHECK(3 - std::count(of_wall.begin(), of_wall.end(), 0) == std::min(most, 3));
    if (most < 3) continue;
    const auto [least, largest] = std::minmax_element(of_wall.begin(), of_wall.end());
    CHECK(*largest - *least <= 1);
    CHECK(contacts.size() == static_cast<std::size_t>(most));
  }
}

TEST_CASE_FIXTURE(OdeSession, "a query of a body that looks ahead at a mesh is counted") {
  const MeshGeom floor(sheet_mesh(2, 2, 1));
  const dWorldID world = dWorldCreate();
  {
    const Geom ball(snCreateEllipsoid(nullptr, dReal(0.1), dReal(0.1), dReal(0.08)));
    const dBodyID body = dBodyCreate(world);
    dGeomSetBody(ball, body);
    dBodySetPosition(body, dReal(0.8), dReal(1.1), dReal(0.2));
    dBodySetLinearVel(body, 0, 0, -20);
    snGeomSetLookAhead(ball, dReal(0.01));
    snResetStatistics();
    CHECK(collide(ball, floor, 4).size() == 1);
    snStatistics statistics;
    snGetStatistics(&statistics);
    CHECK(statistics.queries_cold + statistics.queries_warm >= 1);
    CHECK(statistics.evaluations_cold + statistics.evaluations_warm >= 1);
    CHECK(statistics.contacts == 1);
  }
  dWorldDestroy(world);
}

TEST_CASE_FIXTURE(OdeSession, "the callbacks of a mesh are called and stay set") {
  const MeshGeom floor(sheet_mesh(8, 8, 0.5));
  const Geom body(snCreateEllipsoid(nullptr, dReal(0.4), dReal(0.4), dReal(0.4)));
  dGeomTriMeshSetCallback(floor, wants_even);
  dGeomTriMeshSetArrayCallback(floor, tell);
  dGeomTriMeshEnableTC(floor, dBoxClass, 1);
  std::size_t even = 0;
  for (int i = 0; i < 100; ++i) {
    told = {};
    place(body, {1.5 + 0.01 * i, 1.7, 0.39});
    const auto contacts = collide(body, floor);
    CHECK(told.by == dGeomID(body));
    CHECK(told.indices.size() >= 2);
    for (const dContactGeom& contact : contacts) {
      CHECK(contact.side2 % 2 == 0);
      CHECK(std::find(told.indices.begin(), told.indices.end(), contact.side2) != told.indices.end());
      ++even;
    }
    CHECK((dGeomTriMeshGetCallback(floor) == wants_even));
    CHECK((dGeomTriMeshGetArrayCallback(floor) == tell));
    CHECK(dGeomTriMeshIsTCEnabled(floor, dBoxClass) == 1);
  }
  CHECK(even > 20);
  // A query of the distance is not a collision, so no callback is called.
  told = {};
  CHECK(proximity_of(body, floor).converged == 1);
  CHECK(told.by == nullptr);
}

TEST_CASE("meshes collide after ODE was closed and opened again, and ignore bodies that are not finite") {
  for (int round = 0; round < 2; ++round) {
    OdeSession session;
    const MeshGeom floor(sheet_mesh(8, 8, 0.5));
    const Geom body(snCreateEllipsoid(nullptr, dReal(0.4), dReal(0.4), dReal(0.4)));
    place(body, {2, 2, 0.39});
    CHECK(collide(body, floor).size() == 1);
    place(body, {std::numeric_limits<double>::quiet_NaN(), 2, 0.39});
    CHECK(collide(body, floor).empty());
    snProximity proximity;
    CHECK(snGeomProximity(body, floor, &proximity) == 0);
  }
}

TEST_CASE_FIXTURE(
    OdeSession,
    "the gap of a body and a mesh with hollows is minus the depth of the deepest contact, and a gap that is not positive has a "
    "contact") {
  Random random(82);
  std::size_t contact_count = 0;
  for (const TriangleMesh& arrays : hollow_meshes()) {
    const MeshGeom mesh(arrays);
    for (int i = 0; i < draws(1000); ++i) {
      CAPTURE(i);
      const auto half_axis = [&] { return dReal(random.uniform(0.1, 0.6)); };
      const auto exponent = [&] { return dReal(1 + 0.02 * std::pow(1e4, random.uniform(0, 1))); };
      const std::array<dReal, 5> size = {half_axis(), half_axis(), half_axis(), exponent(), exponent()};
      const Geom body(snCreateSuperellipsoid(nullptr, size[0], size[1], size[2], size[3], size[4]));
      place(body, random.uniform(0.2, 2) * random.direction());
      random.turn(body);
      const auto contacts = collide(body, mesh, 64);
      const snProximity one = proximity_of(body, mesh), other = proximity_of(mesh, body);
      CHECK(one.gap == other.gap);
      CHECK(to_vec(one.normal) == -1.0 * to_vec(other.normal));
      contact_count += contacts.size();
      if (std::abs(one.gap) > 1e-9) CHECK(contacts.empty() == (one.gap > 0));
      if (contacts.empty()) continue;
      CHECK(double{contacts[0].depth} == -one.gap);
      CHECK(norm(to_vec(contacts[0].normal) + to_vec(one.normal)) < 1e-15);
      for (const dContactGeom& contact : contacts) CHECK(contact.depth <= contacts[0].depth);
    }
  }
  CHECK(contact_count > draws(750));
}

TEST_CASE_FIXTURE(OdeSession, "a slope of rounded vertices has the contacts of a plane" * doctest::skip(kIsSinglePrecision)) {
  for (const double slope : {0.05, 1.0}) {
    for (const double away : {0.0, 1000.0}) {
      for (const double cell : {0.02, 1.0}) {
        CAPTURE(slope);
        CAPTURE(away);
        CAPTURE(cell);
        const auto height = [slope](double x, double y) { return slope * (x + 0.3 * y); };
        const Geom plane(dCreatePlane(nullptr, dReal(-slope), dReal(-0.3 * slope), 1, 0));
        const Vec middle = {away, away, height(away, away)};
        const double half = 0.5 * kCells * cell;
        const double rounding = rounding_at(norm(middle) + 2 * half);
        check_is_plane(MeshGeom(sheet(middle, cell, height)), plane, middle, cell, rounding);
        // The x of a heightfield is the world's, its y is up, its z is -y of the world. `away` raises it here.
        const Terrain terrain(
            {.columns = kCells + 1, .rows = kCells + 1, .width = 2 * half, .depth = 2 * half, .source = Source::Single},
            [&](int i, int j) { return height(away + i * cell - half, half - j * cell); });
        const Geom field(terrain.create(true));
        dMatrix3 turn;
        dRFromAxisAndAngle(turn, 1, 0, 0, dReal(0.5 * 3.14159265358979323846));
        dGeomSetRotation(field, turn);
        place(field, {away, 0, 0});
        check_is_plane(field, plane, {away, 0, slope * away}, cell, rounding);
      }
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "two slopes of rounded vertices that meet at 1e-3 rad are no plane") {
  const Vec up = (1 / std::sqrt(1.09)) * Vec{0, -0.3, 1}, middle = {10, 10, 3};
  const MeshGeom valley(sheet(middle, 0.1, [](double x, double y) { return 0.3 * y + 5e-4 * std::abs(x - 10); }));
  const Geom ball(snCreateEllipsoid(nullptr, 10, 10, 10));
  place(ball, middle + (10 - 1e-3) * up);
  CHECK(collide(ball, valley).size() == 2);
}
