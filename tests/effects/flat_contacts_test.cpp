// Forces on a region of contact: where their resultant acts, for any contacts that a collider lists.
#include <doctest/doctest.h>

#include <cmath>
#include <span>

#include "effects/effects_world.hpp"
#include "ode/mesh_fixture.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

constexpr double kPullOff = 2;  // N

/// A point of the plane z = 0.
using Place = std::array<double, 2>;

double distance(const Place& a, const Place& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// Sets up the contacts that dCollide finds between two geoms, and returns their number.
int set_up(fx::Effects& effects, dGeomID g1, dGeomID g2) {
  std::array<dContact, 64> contacts{};
  const int count = dCollide(g1, g2, static_cast<int>(contacts.size()), &contacts[0].geom, sizeof(dContact));
  effects.set_up_contacts(std::span(contacts).first(static_cast<std::size_t>(count)));
  return count;
}

void forget_forces(dBodyID body) {
  dBodySetForce(body, 0, 0, 0);
  dBodySetTorque(body, 0, 0, 0);
}

/// The point, relative to the body's centre, at which the force on the body along z acts.
Place line_of_force(dBodyID body) {
  const dReal* const force = dBodyGetForce(body);
  const dReal* const torque = dBodyGetTorque(body);
  return {-torque[1] / force[2], torque[0] / force[2]};
}

/// A contact of a body with the ground.
dContact contact_at(dGeomID geom, dGeomID ground, const Place& place, double depth) {
  dContact contact{};
  contact.geom.g1 = geom;
  contact.geom.g2 = ground;
  contact.geom.pos[0] = dReal(place[0]);
  contact.geom.pos[1] = dReal(place[1]);
  contact.geom.normal[2] = 1;
  contact.geom.depth = dReal(depth);
  return contact;
}

/// A ball above the ground that sinks at 1 m/s, with contacts of any kind.
class Ball {
 public:
  explicit Ball(const fx::Effect& effect) : scene_({effect}, kLongStep) {
    ground_ = dCreatePlane(scene_.world.space(), 0, 0, 1, 0);
    body_ = scene_.add_ball(kBallRadius, 1000, {0, 0, kBallRadius});
    dBodySetLinearVel(body_, 0, 0, -1);
  }
  dContact contact(const Place& place, double depth) const { return contact_at(dBodyGetFirstGeom(body_), ground_, place, depth); }

  Place adhesion(std::vector<dContact> contacts) {
    forget_forces(body_);
    scene_.effects.set_up_contacts(contacts);
    CHECK(double{dBodyGetForce(body_)[2]} == relative(-kPullOff).epsilon(within_rounding(1e-12)));
    return line_of_force(body_);
  }
  /// ODE's row for a contact has the force motionN / soft_cfm, here half of the damper's.
  Place damper(std::vector<dContact> contacts) {
    scene_.effects.set_up_contacts(contacts);
    double sum = 0;
    Place moment = {0, 0};
    for (const dContact& contact : contacts) {
      const double force = contact.surface.motionN / contact.surface.soft_cfm;
      CHECK(force >= 0);
      sum += force;
      moment = {moment[0] + force * contact.geom.pos[0], moment[1] + force * contact.geom.pos[1]};
    }
    return {moment[0] / sum, moment[1] / sum};
  }

 private:
  OdeSession session_;
  EffectsWorld scene_;
  dGeomID ground_;
  dBodyID body_;
};

}  // namespace

TEST_CASE("adhesion acts in the middle of a flat contact, at any tilt within the depth, with any collider") {
  EffectsWorld scene({fx::Adhesion{kPullOff, {}}}, kLongStep);
  const dSpaceID space = scene.world.space();
  const std::array grounds = {dCreatePlane(space, 0, 0, 1, 0), dCreateBox(space, 1, 1, 1),
                              snCreateSuperellipsoid(space, dReal(0.5), dReal(0.5), dReal(0.5), 100, 100)};
  for (const std::size_t k : {1U, 2U}) dGeomSetPosition(grounds.at(k), 0, 0, dReal(-0.5));
  const std::array geoms = {snCreateSuperellipsoid(space, dReal(0.05), dReal(0.035), dReal(0.025), 8, 8),
                            snCreateSuperellipsoid(space, dReal(0.05), dReal(0.035), dReal(0.025), 20, 20),
                            snCreateSuperellipsoid(space, dReal(0.05), dReal(0.035), dReal(0.025), 60, 60),
                            dCreateBox(space, dReal(0.1), dReal(0.07), dReal(0.05))};
  for (const dGeomID geom : geoms) {
    dMass mass;
    dMassSetBox(&mass, 1000, dReal(0.1), dReal(0.07), dReal(0.05));
    const dBodyID body = scene.world.add(geom, mass);
    for (const dGeomID ground : grounds) {
      for (const double tilt : {0.0, 1e-7, 1e-6, 1e-5, 1e-4}) {
        CAPTURE(dGeomGetClass(geom));
        CAPTURE(dGeomGetClass(ground));
        CAPTURE(tilt);
        dBodySetPosition(body, 0, 0, dReal(0.025 - 1e-5));
        turn(body, {0.6, 0.8, 0}, tilt);
        forget_forces(body);
        REQUIRE(set_up(scene.effects, geom, ground) > 2);
        CHECK(double{dBodyGetForce(body)[2]} == relative(-kPullOff).epsilon(within_rounding(1e-3)));
        CHECK(distance(line_of_force(body), {0, 0}) < 0.01 * 0.035);
      }
    }
  }
}

TEST_CASE("adhesion of a body that stands on an edge acts at the edge") {
  OnPlane scene({fx::Adhesion{kPullOff, {}}}, kLongStep);
  const dGeomID ground = dSpaceGetGeom(scene.world.space(), 0);
  for (const dGeomID geom : {snCreateSuperellipsoid(scene.world.space(), dReal(0.02), dReal(0.02), dReal(0.02), 60, 60),
                             dCreateBox(scene.world.space(), dReal(0.04), dReal(0.04), dReal(0.04))}) {
    dMass mass;
    dMassSetBox(&mass, 1000, dReal(0.04), dReal(0.04), dReal(0.04));
    const dBodyID body = scene.world.add(geom, mass);
    turn(body, {0, 1, 0}, 30 * kDegree);
    // From the centre of a square to its lowest vertex.
    const double low = 0.02 * (std::cos(30 * kDegree) + std::sin(30 * kDegree));
    const double beside = 0.02 * (std::cos(30 * kDegree) - std::sin(30 * kDegree));
    dBodySetPosition(body, 0, 0, dReal(low - 5e-4));
    REQUIRE(set_up(scene.effects, geom, ground) > 0);
    CHECK(distance(line_of_force(body), {beside, 0}) < 5e-4);
  }
}

TEST_CASE("a force on a region acts at the centre of a rectangle, with any further contacts, order and depths") {
  const std::array<Place, 4> corners = {{{-0.01, -0.02}, {0.05, -0.02}, {0.05, 0.03}, {-0.01, 0.03}}};
  Random random(5);
  Ball sticky(fx::Adhesion{kPullOff, {}});
  Ball damped(fx::Compliance{1e-9, 7, {}});
  for (int draw = 0; draw < 200; ++draw) {
    std::vector<dContact> contacts;
    const auto depth = [&] { return random.uniform(0, 1) < 0.3 ? 0 : std::pow(10, random.uniform(-12, -3)); };
    for (const Place& corner : corners) {
      for (int k = random.uniform(0, 1) < 0.2 ? 2 : 1; k > 0; --k) contacts.push_back(sticky.contact(corner, depth()));
    }
    for (int k = static_cast<int>(random.uniform(0, 4)); k > 0; --k) {
      contacts.push_back(sticky.contact({random.uniform(-0.01, 0.05), random.uniform(-0.02, 0.03)}, depth()));
    }
    for (std::size_t k = contacts.size(); k-- > 1;) {
      std::swap(contacts[k], contacts[static_cast<std::size_t>(random.uniform(0, static_cast<double>(k + 1)))]);
    }
    CHECK(distance(sticky.adhesion(contacts), {0.02, 0.005}) < within_rounding(1e-12, 0.1));
    for (dContact& contact : contacts) contact = damped.contact({contact.geom.pos[0], contact.geom.pos[1]}, contact.geom.depth);
    CHECK(distance(damped.damper(contacts), {0.02, 0.005}) < within_rounding(1e-9, 0.1));
  }
}

TEST_CASE("the middle of a region: an edge, a point, and points equal up to rounding") {
  Ball ball(fx::Adhesion{kPullOff, {}});
  const auto middle = [&](const std::vector<Place>& places) {
    std::vector<dContact> contacts;
    contacts.reserve(places.size());
    for (const Place& place : places) contacts.push_back(ball.contact(place, 1e-5));
    return ball.adhesion(contacts);
  };
  const double tolerance = within_rounding(1e-12, 0.1);
  CHECK(distance(middle({{0.03, 0.01}}), {0.03, 0.01}) < tolerance);
  CHECK(distance(middle({{0.03, 0.01}, {0.03, 0.01}, {0.03, 0.01}}), {0.03, 0.01}) < tolerance);
  CHECK(distance(middle({{-0.01, -0.02}, {0.03, 0.06}}), {0.01, 0.02}) < tolerance);
  CHECK(distance(middle({{-0.01, -0.02}, {0.03, 0.06}, {0.02, 0.04}, {0.03, 0.06}}), {0.01, 0.02}) < tolerance);
  CHECK(distance(middle({{0, 0}, {0.04, 1e-17}, {0.04, -1e-17}, {0.01, 1e-17}}), {0.02, 0}) < tolerance);
}

TEST_CASE("the middle of a region moves by at most 4/pi times the contacts, also when they become one or leave the border") {
  Random random(11);
  Ball ball(fx::Adhesion{kPullOff, {}});
  for (int draw = 0; draw < 2000; ++draw) {
    const double way = std::pow(10, random.uniform(-9, -2));
    const double width = std::pow(10, random.uniform(-8, -1));  // across the line of the contacts
    std::vector<dContact> before, after;
    for (int k = 1 + static_cast<int>(random.uniform(0, 6)); k > 0; --k) {
      const Place place = {random.uniform(-0.05, 0.05), random.uniform(-1, 1) * width};
      const double angle = random.uniform(0, 2 * std::numbers::pi);
      before.push_back(ball.contact(place, random.uniform(0, 1e-4)));
      after.push_back(ball.contact({place[0] + way * std::cos(angle), place[1] + way * std::sin(angle)}, random.uniform(0, 1e-4)));
    }
    const double most = 4 / std::numbers::pi * way * (1 + 1e-9) + within_rounding(1e-13, 0.1);
    CHECK(distance(ball.adhesion(before), ball.adhesion(after)) <= most);
  }
}

TEST_CASE("each slope of a mesh sticks once, at any number of triangles and order of contacts") {
  EffectsWorld scene({fx::Adhesion{kPullOff, {}}}, kLongStep);
  const Vec right = {0.6, 0, 0.8}, left = {-0.8, 0, 0.6};  // up each slope, and the normal of the other one
  // A valley along y between two slopes at a right angle, made of squares cut in two.
  TriangleMesh slopes = sheet_mesh(16, 8, 0.03, -8);
  for (supernormal::Vector3& v : slopes.vertices) {
    const Vec at = std::abs(v.x()) * (v.x() > 0 ? right : left);
    v = {at[0], v.y() - 0.11, at[2]};
  }
  const MeshGeom valley(slopes, scene.world.space());
  const dGeomID brick = snCreateSuperellipsoid(scene.world.space(), dReal(0.05), dReal(0.05), dReal(0.05), 60, 60);
  const dGeomID box = dCreateBox(scene.world.space(), dReal(0.1), dReal(0.1), dReal(0.1));
  dMass mass;
  dMassSetBox(&mass, 1000, dReal(0.1), dReal(0.1), dReal(0.1));
  const double deep = 0.0499;
  // ODE's own box is cut by each triangle. The normals differ by the rounding of vertices to single precision.
  for (const dGeomID geom : {brick, box}) {
    const dBodyID body = scene.world.add(geom, mass);
    turn(body, {0, 1, 0}, -std::atan2(0.8, 0.6));
    const Vec up_the_slope = 0.1513 * right + deep * left;
    dBodySetPosition(body, dReal(up_the_slope[0]), dReal(0.0037), dReal(up_the_slope[2]));
    REQUIRE(set_up(scene.effects, geom, valley) > 3);
    CHECK(norm(to_vec(dBodyGetForce(body)) + kPullOff * left) < 1e-4 * kPullOff);
  }
  const dBodyID body = dGeomGetBody(brick);
  const Vec in_the_valley = deep * (right + left);
  dBodySetPosition(body, dReal(in_the_valley[0]), 0, dReal(in_the_valley[2]));
  forget_forces(body);
  REQUIRE(set_up(scene.effects, brick, valley) > 4);
  CHECK(norm(to_vec(dBodyGetForce(body)) + kPullOff * (right + left)) < 1e-4 * kPullOff);
}
