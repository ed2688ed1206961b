// Tests that the former content of the stack changes no answer, of contacts or of snGeomProximity.
#include <doctest/doctest.h>

#include "ode/collider_fixture.hpp"
#include "ode/mesh_fixture.hpp"
#include "ode/terrain.hpp"
#include "support/draw.hpp"
#include "support/painted_stack.hpp"
#include "support/traps.hpp"

using namespace supernormal::test;

namespace {

const int kPairs = draws(400);  // for each kind of collider

struct Answer {
  bool is_told = false;
  snProximity proximity{};
  int count = 0;
  std::array<dContactGeom, 8> contacts{};
};

/// The numbers of an answer. is_same_on_every_stack() finds this function by its argument.
Numbers numbers_of(const Answer& answer) {
  const snProximity& p = answer.proximity;
  Numbers numbers = {double(answer.is_told), p.gap, p.error, double(p.evaluations), double(p.converged), double(p.is_global)};
  const auto append = [&](const dReal* v) { numbers.insert(numbers.end(), v, v + 3); };
  for (const dReal* v : {p.normal, p.point1, p.point2}) append(v);
  numbers.push_back(answer.count);
  for (int k = 0; k < answer.count; ++k) {
    const dContactGeom& contact = answer.contacts[static_cast<std::size_t>(k)];
    append(contact.pos);
    append(contact.normal);
    numbers.push_back(contact.depth);
  }
  return numbers;
}

Answer ask(dGeomID g1, dGeomID g2) {
  Answer answer;
  answer.is_told = snGeomProximity(g1, g2, &answer.proximity) == 1;
  answer.count = dCollide(g1, g2, static_cast<int>(answer.contacts.size()), answer.contacts.data(), sizeof(dContactGeom));
  return answer;
}

void check_pair(dGeomID g1, dGeomID g2, const std::string& name) {
  const auto ask_them = [&] { return ask(g1, g2); };
  if (!is_same_on_every_stack(ask_them)) FAIL_CHECK(name);
  const Traps traps(name.c_str());
  ask_on_painted_stack(kSignallingNan, ask_them);
}

}  // namespace

TEST_CASE_FIXTURE(OdeSession,
                  "every kind of collider gives the same digits over any stack, and computes nothing with uninitialized memory") {
  snSetWarmStart(0);  // so results are a pure function of the pair
  Random random(17);
  for (const ColliderKind kind : kColliderKinds) {
    for (int k = 0; k < kPairs; ++k) {
      const Geom body(random_body(random));
      const ColliderGeom collider(kind, random);
      overlap(body, collider, random.uniform(-0.1, 0.3) * size_of(body), random);
      check_pair(body, collider, name_of(kind) + " of pair " + std::to_string(k));
      check_pair(collider, body, name_of(kind) + " first, of pair " + std::to_string(k));
    }
  }
}

TEST_CASE_FIXTURE(OdeSession,
                  "meshes and heightfields give the same digits over any stack, and compute nothing with uninitialized memory") {
  snSetWarmStart(0);
  Random random(18);
  const MeshGeom block(box_mesh({1, 1, 1}));
  const Terrain terrain({}, [](int i, int j) { return 0.1 * ((3 * i + 5 * j) % 4); });
  const Geom ground(terrain.create());
  for (int k = 0; k < kPairs; ++k) {
    const Geom body(random_body(random));
    const std::string name = "of body " + std::to_string(k);
    place(body, random.uniform(1.5, 2.5) * random.direction());
    check_pair(body, block, "block " + name);
    place(body, {random.uniform(-3, 3), random.uniform(0.5, 1.5), random.uniform(-3, 3)});
    check_pair(body, ground, "ground " + name);
  }
}

// The normals of the two ends of the capsule have equal gaps. Both gaps are lower than the support function by rounding only,
// because rotations are rounded by more than coordinates.
TEST_CASE_FIXTURE(OdeSession, "a body of micrometres inside a short capsule gives the same digits over any stack") {
  snSetWarmStart(0);
  const Geom capsule(dCreateCapsule(nullptr, dReal(0.036479867631577401), dReal(0.00056562692823155548)));
  place(capsule, {0, 0, 6.6506547922008764e-06});
  const dQuaternion turn1 = {dReal(-0.44431700654673484), dReal(0.18229252349025157), dReal(0.84731666254391513),
                             dReal(-0.22672958992673589)};
  dGeomSetQuaternion(capsule, turn1);
  const Geom body(
      snCreateEllipsoid(nullptr, dReal(6.6506547922008764e-06), dReal(2.8238125254299433e-06), dReal(2.8464244952701146e-06)));
  const dQuaternion turn2 = {dReal(-0.038095692185832815), dReal(0.78321365262406795), dReal(0.59668091442511373),
                             dReal(0.17057836598161502)};
  dGeomSetQuaternion(body, turn2);
  check_pair(capsule, body, "the capsule");
  check_pair(body, capsule, "the body");
}
