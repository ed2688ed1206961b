// Tests of snCreateCapsule: a capsule as a body of ours beside ODE's own.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>

#include "ode/ode_fixture.hpp"
#include "relative.hpp"

using namespace supernormal::test;

namespace {

constexpr dReal kRadius = 2, kLength = 5;

bool refused_with(const std::string& text) { return std::string(snLastError()).find(text) != std::string::npos; }

}  // namespace

TEST_CASE("capsule: size, mass and depth are those of ODE's") {
  OdeSession session;
  const Geom ours(snCreateCapsule(nullptr, kRadius, kLength));
  REQUIRE(ours != nullptr);
  const Geom odes(dCreateCapsule(nullptr, kRadius, kLength));
  dMatrix3 turn;
  dRFromAxisAndAngle(turn, 1, dReal(0.5), dReal(0.2), dReal(0.7));
  std::array<std::array<dReal, 6>, 2> boxes{};
  for (const auto geom : {static_cast<dGeomID>(ours), static_cast<dGeomID>(odes)}) {
    dGeomSetRotation(geom, turn);
    dGeomGetAABB(geom, boxes[geom == static_cast<dGeomID>(odes) ? 1 : 0].data());
  }
  for (std::size_t i = 0; i < 6; ++i) CHECK(boxes[0][i] == relative(boxes[1][i]).epsilon(1e-6));
  dMass mass, expected;
  REQUIRE(snMassSet(&mass, 3, ours) == 1);
  dMassSetCapsule(&expected, 3, 3, kRadius, kLength);
  CHECK(mass.mass == relative(expected.mass).epsilon(1e-6));
  for (const int i : {0, 5, 10}) CHECK(mass.I[i] == relative(expected.I[i]).epsilon(1e-6));
  for (const dReal x : {dReal(0), dReal(1), dReal(3)}) {
    CHECK(std::abs(snGeomPointDepth(ours, x, 1, 2) - dGeomCapsulePointDepth(odes, x, 1, 2)) < 1e-6);
  }
}

TEST_CASE("capsule: lying on a plane it has a contact at each end") {
  OdeSession session;
  const Geom capsule(snCreateCapsule(nullptr, kRadius, kLength));
  dMatrix3 lying;
  dRFromAxisAndAngle(lying, 0, 1, 0, dReal(1.5707963267948966));
  dGeomSetRotation(capsule, lying);
  dGeomSetPosition(capsule, 0, 0, kRadius - dReal(0.001));  // as deep as what rests; deeper ones are drawn in to one end
  const Geom plane(dCreatePlane(nullptr, 0, 0, 1, 0));
  std::array<dContactGeom, 8> contacts{};
  const int count = dCollide(capsule, plane, 8, contacts.data(), sizeof(dContactGeom));
  REQUIRE(count >= 2);
  double least = 0;
  double most = 0;
  for (int i = 0; i < count; ++i) {
    const dContactGeom& contact = contacts[static_cast<std::size_t>(i)];
    CHECK(contact.depth == relative(0.001).epsilon(1e-3));
    least = std::min<double>(least, contact.pos[0]);
    most = std::max<double>(most, contact.pos[0]);
  }
  CHECK(least == relative(-kLength / 2).epsilon(0.06));
  CHECK(most == relative(kLength / 2).epsilon(0.06));
}

TEST_CASE("capsule: refusals") {
  OdeSession session;
  CHECK(snCreateCapsule(nullptr, 0, 1) == nullptr);
  CHECK(refused_with("snCreateCapsule: radius = 0"));
  CHECK(snCreateCapsule(nullptr, 1, -1) == nullptr);
  CHECK(refused_with("snCreateCapsule: length = -1"));
  const Geom ball(snCreateCapsule(nullptr, 1, 0));
  CHECK(ball != nullptr);
}
