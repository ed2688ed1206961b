// Tests of our bodies and dTriMesh.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "ode/mesh_fixture.hpp"
#include "support/ode_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

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

}  // namespace

TEST_CASE("a floor of triangles gives the contacts of a dPlane, in both orders") {
  OdeSession session;
  Random random(31);
  const MeshGeom floor(floor_arrays(60, 60, 0.125));
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

TEST_CASE("the distance of a mesh is the distance of its nearest triangle, at any distance") {
  OdeSession session;
  Random random(34);
  const MeshGeom block(box_arrays(1, 0.75, 0.5));
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
  MeshArrays two = box_arrays(0.5, 0.5, 0.5);
  const auto count = static_cast<dTriIndex>(two.vertices.size());
  const auto triangles = two.triangles;
  for (std::size_t i = 0; i < count; ++i) two.add(two.vertices[i][0] + 100, two.vertices[i][1] + 3, two.vertices[i][2]);
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

TEST_CASE("a body in a corner of a mesh room has one contact for each wall, and with a smaller max_contacts the deepest ones") {
  OdeSession session;
  const MeshGeom room(box_arrays(3, 4, 5, true));
  const Geom body(snCreateEllipsoid(nullptr, 1, 1, 1));
  place(body, {2.0625, -3.125, 4.25});
  const auto contacts = collide(body, room);
  REQUIRE(contacts.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) CHECK(contacts[i].depth == relative(std::array{0.25, 0.125, 0.0625}[i]));
  CHECK(contacts[0].normal[2] == -1);  // the normal points into the body
  CHECK(contacts[1].normal[1] == 1);
  CHECK(contacts[2].normal[0] == -1);
  for (const int room_for : {1, 2}) {
    const auto fewer = collide(body, room, room_for);
    REQUIRE(fewer.size() == static_cast<std::size_t>(room_for));
    for (std::size_t i = 0; i < fewer.size(); ++i) CHECK(fewer[i].depth == contacts[i].depth);
  }
  // With a stride, the memory between the contacts is unchanged.
  struct Spaced {
    dContactGeom contact;
    std::array<char, 40> between;
  };
  std::array<Spaced, 4> spaced;
  for (Spaced& s : spaced) s.between.fill('x');
  REQUIRE(dCollide(body, room, 4, &spaced[0].contact, sizeof(Spaced)) == 3);
  for (std::size_t i = 0; i < 3; ++i) CHECK(spaced[i].contact.depth == contacts[i].depth);
  for (const Spaced& s : spaced) CHECK(std::all_of(s.between.begin(), s.between.end(), [](char c) { return c == 'x'; }));
}

TEST_CASE("a flat body in a corner of a mesh room has a contact with each wall, and equal shares of the others") {
  OdeSession session;
  const MeshGeom room(box_arrays(3, 4, 5, true));
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

TEST_CASE("a query of a body that looks ahead at a mesh is counted") {
  OdeSession session;
  const MeshGeom floor(floor_arrays(2, 2, 1));
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

namespace {

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

}  // namespace

TEST_CASE("the callbacks of a mesh are called and stay set") {
  OdeSession session;
  const MeshGeom floor(floor_arrays(8, 8, 0.5));
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
    const MeshGeom floor(floor_arrays(8, 8, 0.5));
    const Geom body(snCreateEllipsoid(nullptr, dReal(0.4), dReal(0.4), dReal(0.4)));
    place(body, {2, 2, 0.39});
    CHECK(collide(body, floor).size() == 1);
    place(body, {std::numeric_limits<double>::quiet_NaN(), 2, 0.39});
    CHECK(collide(body, floor).empty());
    snProximity proximity;
    CHECK(snGeomProximity(body, floor, &proximity) == 0);
  }
}
