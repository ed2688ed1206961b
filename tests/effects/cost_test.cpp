// Tests that an effect that is not listed has no cost: no rows, no visits, no changed digit.
#include <doctest/doctest.h>

#include <Eigen/QR>

#include "effects/effects_world.hpp"

using namespace supernormal::test;

namespace {

/// The rank of the wrenches of a contact about its point, over many states of motion. It equals the number of live rows.
int live_rows(const std::vector<fx::Effect>& list) {
  std::vector<fx::Effect> with_gravity = list;
  with_gravity.emplace_back(earth());
  OnPlane scene(with_gravity, kLongStep);
  const dBodyID ball = scene.add_ball(0.05, 1000, {0, 0, 0});
  Random random(9);
  Eigen::MatrixXd wrenches(6, 60);
  for (int i = 0; i < wrenches.cols(); ++i) {
    dBodySetPosition(ball, 0, 0, dReal(0.0499));
    turn(ball, {0, 0, 1}, 0);  // a direction fixed to the body rotates with it
    const Vec v = random.direction();
    const Vec w = 20.0 * random.direction();
    dBodySetLinearVel(ball, dReal(v[0]), dReal(v[1]), dReal(-0.1));
    dBodySetAngularVel(ball, dReal(w[0]), dReal(w[1]), dReal(w[2]));
    scene.step();
    REQUIRE(scene.loads.size() == 1);
    const Load& load = scene.loads.front();
    for (int k = 0; k < 3; ++k) {
      wrenches(k, i) = load.force[static_cast<std::size_t>(k)];
      wrenches(3 + k, i) = load.torque[static_cast<std::size_t>(k)] / 0.05;
    }
  }
  return static_cast<int>(Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(wrenches).setThreshold(1e-6).rank());
}

unsigned long long rows_of(const fx::Effects& effects) {
  unsigned long long rows = 0;
  for (const fx::Cost& cost : effects.costs()) rows += cost.rows;
  return rows;
}

/// Lets a few bodies fall on one another and returns their velocities at the end.
std::vector<double> tumble(const std::vector<fx::Effect>& list, const std::function<fx::Material(dGeomID)>& material_of) {
  OnPlane scene(list, kLongStep);
  scene.material_of = material_of;
  std::vector<dBodyID> bodies;
  Random random(4);
  for (int i = 0; i < 4; ++i) {
    const dGeomID geom = snCreateSuperellipsoid(scene.world.space(), dReal(0.1), dReal(0.08), dReal(0.05), dReal(2 + i), 3);
    random.turn(geom);
    bodies.push_back(scene.add(geom, 1000, {0.03 * i, 0, 0.15 + 0.15 * i}));
  }
  scene.run_until(0.6);
  std::vector<double> digits;
  for (const dBodyID body : bodies) {
    for (const Vec& v : {to_vec(dBodyGetLinearVel(body)), to_vec(dBodyGetAngularVel(body)), to_vec(dBodyGetPosition(body))}) {
      digits.insert(digits.end(), v.begin(), v.end());
    }
  }
  return digits;
}

}  // namespace

TEST_CASE("a contact has the rows of the listed effects and no more") {
  const fx::Friction friction{0.5, {}};
  CHECK(live_rows({}) == 1);
  CHECK(live_rows({fx::Restitution{0.5, 0, {}}}) == 1);
  CHECK(live_rows({fx::Compliance{1e5, 10, {}}}) == 1);
  CHECK(live_rows({fx::Hertz{1e7, 0.3, 0.8, {}}}) == 1);
  CHECK(live_rows({fx::Adhesion{1, {}}}) == 1);
  CHECK(live_rows({friction}) == 3);
  CHECK(live_rows({fx::AnisotropicFriction{0.5, 0.2, {1, 0, 0}, {}}}) == 3);
  CHECK(live_rows({fx::AnisotropicFriction{0.5, 0, {1, 0, 0}, {}}}) == 2);
  CHECK(live_rows({friction, fx::RollingResistance{0, 0.005, {}}}) == 4);
  CHECK(live_rows({friction, fx::RollingResistance{0.005, 0, {}}}) == 5);
  CHECK(live_rows({friction, fx::RollingResistance{0.005, 0.005, {}}}) == 6);
}

TEST_CASE("without rolling resistance no contact requests rolling rows, and the counted rows are the requested ones") {
  fx::Effects smooth({fx::Friction{0.5, fx::MaterialSelector::of(1)}}, kLongStep);
  OdeSession session;
  Geom plane(dCreatePlane(nullptr, 0, 0, 1, 0));
  Geom ball(snCreateEllipsoid(nullptr, 1, 1, 1));
  place(ball, {0, 0, 0.99});
  std::array<dContact, 1> contact{};
  REQUIRE(dCollide(ball, plane, 1, &contact[0].geom, sizeof(dContact)) == 1);
  CHECK(smooth.set_up_contacts(contact, 0, 1) == 1);
  CHECK(contact[0].surface.mode == 0);
  CHECK(contact[0].surface.mu == 0);
  CHECK(smooth.set_up_contacts(contact, 1, 1) == 1);
  CHECK((contact[0].surface.mode & dContactRolling) == 0);
  CHECK(contact[0].surface.mu > 0);
  CHECK(rows_of(smooth) == 1 + 3);
}

TEST_CASE_FIXTURE(OdeSession, "contacts for a stepper keep their gaps and the whole circle of friction") {
  Geom plane(dCreatePlane(nullptr, 0, 0, 1, 0));
  Geom ball(snCreateEllipsoid(nullptr, 1, 1, 1));
  std::array<dContact, 1> contact{};
  const auto set_up = [&](const fx::Effect& friction) {
    contact[0].geom = {{}, {0, 0, 1}, dReal(-0.01), ball, plane, -1, -1};
    fx::Effects effects({friction}, kLongStep, fx::Solver::Stepper);
    CHECK(effects.set_up_contacts(contact) == 1);
    CHECK(contact[0].geom.depth == dReal(-0.01));
    CHECK((contact[0].surface.mode & dContactMotionN) == 0);
    CHECK(rows_of(effects) == 1 + 2);
    return contact[0].surface.mu;
  };
  CHECK(set_up(fx::Friction{0.25, {}}) == dReal(0.25));
  CHECK((contact[0].surface.mode & dContactFDir1) == 0);
  CHECK(set_up(fx::AnisotropicFriction{0.5, 0.2, {0, 1, 0}, {}}) == dReal(0.5));
  CHECK(contact[0].surface.mu2 == dReal(0.2));
  CHECK(contact[0].fdir1[1] == 1);
}

TEST_CASE("a list without forces visits no body and stores none") {
  EffectsWorld scene({earth(), fx::Friction{0.5, {}}, fx::Damping{1, 1}, fx::SurfaceLayer{1e-4}}, kLongStep);
  CHECK_FALSE(scene.effects.visits_bodies());
  scene.effects.add_body(nullptr);  // it is not read
  for (const fx::Cost& cost : scene.effects.costs()) CHECK(cost.bodies == 0);
  EffectsWorld dragged({fx::QuadraticDrag{1.2, 0.5}}, kLongStep);
  CHECK(dragged.effects.visits_bodies());
  dragged.add_ball(0.1, 1000, {0, 0, 0});
  const dBodyID asleep = dragged.add_ball(0.1, 1000, {5, 0, 0});
  dBodyDisable(asleep);
  dragged.step();
  CHECK(dragged.effects.costs().back().bodies == 1);
}

TEST_CASE("trajectories are the same to the bit with an effect that applies to no contact") {
  const std::vector<fx::Effect> plain = {earth(), fx::Friction{0.5, {}}, fx::Restitution{0.3, 0.1, {}}};
  std::vector<fx::Effect> more = plain;
  more.emplace_back(fx::RollingResistance{0.01, 0.01, fx::MaterialSelector::of(7)});
  more.emplace_back(fx::Adhesion{3, fx::MaterialSelector::between(7, 8)});
  const auto all_zero = [](dGeomID) { return 0; };
  const std::vector<double> digits = tumble(plain, all_zero);
  CHECK(digits == tumble(plain, all_zero));
  CHECK(digits == tumble(more, all_zero));
  CHECK(digits != tumble(more, [](dGeomID) { return 7; }));
}
