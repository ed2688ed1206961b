// Tests that the class is registered once, although other programs open and close ODE.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdarg>
#include <string>
#include <thread>
#include <vector>

#include "ode/terrain.hpp"
#include "support/ode_fixture.hpp"

using namespace supernormal::test;

namespace {

int register_foreign_class() {
  dGeomClass description{};
  description.collider = [](int) -> dColliderFn* { return nullptr; };
  description.aabb = [](dGeomID, dReal aabb[6]) { std::fill(aabb, aabb + 6, dReal(0)); };
  return dCreateGeomClass(&description);
}

void own_debug_handler(int /*number*/, const char* /*message*/, va_list /*arguments*/) {}

bool works() {
  const Geom body(snCreateEllipsoid(nullptr, 1, 1, 1));
  const Geom other(snCreateEllipsoid(nullptr, 1, 1, 1));
  const Geom plane(dCreatePlane(nullptr, 0, 0, 1, dReal(-0.5)));
  dGeomSetPosition(other, dReal(1.5), 0, 0);
  return collide(body, plane).size() == 1 && collide(body, other).size() == 1;
}

/// A ball on a heightfield.
void meet_terrain() {
  dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll));
  const Terrain terrain({}, [](int, int) { return 0.0; });
  const Geom ground(terrain.create()), ball(snCreateEllipsoid(nullptr, 1, 1, 1));
  dGeomSetPosition(ball, 0, dReal(0.9), 0);
  REQUIRE(collide(ball, ground).size() == 1);
}

}  // namespace

TEST_CASE("registration: the first creation registers the class, and snClose removes it") {
  CHECK(snGeomClass() == -1);  // ODE is not yet initialised
  const dGeomID geom = snCreateEllipsoid(nullptr, 1, 1, 1);
  REQUIRE(geom != nullptr);
  CHECK(snGeomClass() >= dFirstUserClass);
  CHECK(dGeomGetClass(geom) == snGeomClass());
  dGeomDestroy(geom);
  snClose();
  CHECK(snGeomClass() == -1);
  snClose();  // twice does no harm
}

TEST_CASE_FIXTURE(OdeSession, "registration: repeated snInit registers once") {
  REQUIRE(snInit() == 1);
  const int number = snGeomClass();
  for (int i = 0; i < 20; ++i) CHECK(snInit() == 1);
  CHECK(snGeomClass() == number);
  CHECK(register_foreign_class() == number + 1);
}

TEST_CASE("registration: dInitODE2 and dCloseODE of another client do not remove the class") {
  SUBCASE("inside our time") {
    REQUIRE(snInit() == 1);
    dInitODE2(0);
    dCloseODE();
    CHECK(works());
    dInitODE();
    dCloseODE();
    CHECK(works());
    snClose();
  }
  SUBCASE("the client that was first closes first") {
    dInitODE2(0);
    REQUIRE(snInit() == 1);
    dCloseODE();
    CHECK(works());
    dInitODE2(0);
    CHECK(works());
    snClose();
    dCloseODE();
  }
}

TEST_CASE("registration: the class can be registered again after snClose") {
  SUBCASE("ODE really closed, and another class has our number now") {
    REQUIRE(works());
    const int before = snGeomClass();
    std::thread(meet_terrain).join();  // it keeps geoms of its own, and gives its share of ODE back
    snClose();
    dInitODE2(0);
    REQUIRE(register_foreign_class() == before);
    CHECK(works());
    CHECK(snGeomClass() == before + 1);
    snClose();
    dCloseODE();
  }
  SUBCASE("ODE kept open by others: the same class again, no other of the four is used up") {
    OdeSession session;
    REQUIRE(works());
    const int before = snGeomClass();
    for (int i = 0; i < 10; ++i) {
      snClose();
      CHECK(snGeomClass() == -1);
      CHECK(works());
      CHECK(snGeomClass() == before);
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "registration: snClose refuses while geoms are alive") {
  const dGeomID geom = snCreateEllipsoid(nullptr, 1, 1, 1);
  snClose();
  CHECK(std::string(snLastError()).find("snClose: live geoms = 1") == 0);
  CHECK(snGeomClass() == dGeomGetClass(geom));
  dGeomDestroy(geom);
  snClose();
  CHECK(snGeomClass() == -1);
}

TEST_CASE("registration: without a free class the call is refused and does not abort") {
  dInitODE2(0);
  for (int i = 0; i < dMaxUserClasses; ++i) register_foreign_class();
  dSetDebugHandler(own_debug_handler);

  CHECK(refused(snInit(), "snInit: ODE has no free geometry class: a process has 4"));
  CHECK(snCreateEllipsoid(nullptr, 1, 1, 1) == nullptr);
  CHECK(snGeomClass() == -1);
  const bool handler_is_back = dGetDebugHandler() == own_debug_handler;
  dSetDebugHandler(nullptr);
  CHECK(handler_is_back);

  dCloseODE();  // our share was returned, so this call really closes ODE
  CHECK(works());
  snClose();
}

TEST_CASE_FIXTURE(OdeSession, "registration: a geom of our class without a body does no harm") {
  REQUIRE(snInit() == 1);
  const Geom empty(dCreateGeom(snGeomClass()));
  const Geom body(snCreateEllipsoid(nullptr, 1, 1, 1));
  const Geom plane(dCreatePlane(nullptr, 0, 0, 1, 1));
  const Geom sphere(dCreateSphere(nullptr, 1));
  for (const dGeomID other : {dGeomID(body), dGeomID(plane), dGeomID(sphere)}) CHECK(collide(empty, other).empty());
  dReal aabb[6];
  dGeomGetAABB(empty, aabb);
  CHECK(aabb[0] == -dInfinity);
  CHECK(aabb[5] == dInfinity);
  CHECK(snGeomSetRounding(empty, 1) == 0);
}

TEST_CASE_FIXTURE(OdeSession, "registration: many threads at once register once") {
  std::array<int, 8> numbers{};
  std::vector<std::thread> threads;
  threads.reserve(numbers.size());
  for (int& number : numbers) {
    threads.emplace_back([&number] {
      snInit();
      number = snGeomClass();
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const int number : numbers) CHECK(number == snGeomClass());
  CHECK(register_foreign_class() == snGeomClass() + 1);
}

TEST_CASE_FIXTURE(OdeSession, "registration: a geom's data are destroyed with the geom, also by its space") {
  const dSpaceID space = dHashSpaceCreate(nullptr);
  for (int i = 0; i < 10; ++i) snCreateSuperellipsoid(space, 1, 1, 1, 3, 3);
  snClose();
  CHECK(snGeomClass() >= 0);  // ten geoms are alive
  dSpaceDestroy(space);
  snClose();
  CHECK(snGeomClass() == -1);
}
