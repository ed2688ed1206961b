// snGeomDerivatives, snGeomGapGradient, snGeomClearance and snGeomIsFartherThan with every collider, beside differences of
// snGeomProximity. The core's own tests compare more pairs, with more digits.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "ode/collider_fixture.hpp"
#include "ode/mesh_fixture.hpp"

using namespace supernormal::test;

namespace {

constexpr dReal kNotANumber = std::numeric_limits<dReal>::quiet_NaN();

snDerivatives derivatives_of(dGeomID g1, dGeomID g2) {
  const snProximity at = proximity_of(g1, g2);
  snDerivatives found;
  CAPTURE(std::string(snLastError()));
  REQUIRE(snGeomDerivatives(g1, g2, &at, &found) == 1);
  return found;
}

/// The gradient alone has the digits of all derivatives.
void check_gradient_alone(dGeomID g1, dGeomID g2, const snProximity& at) {
  snDerivatives all;
  REQUIRE(snGeomDerivatives(g1, g2, &at, &all) == 1);
  dReal gradient[12];
  REQUIRE(snGeomGapGradient(g1, g2, &at, gradient) == 1);
  CHECK(std::equal(gradient, gradient + 12, all.gap));
}

Vec part(const std::array<double, 12>& twist, std::size_t first) { return {twist[first], twist[first + 1], twist[first + 2]}; }

/// A geom moved by a twist, until the end of the scope.
class Moved {
 public:
  Moved(dGeomID geom, const Vec& v, const Vec& w) : geom_(geom), is_plane_(dGeomGetClass(geom) == dPlaneClass) {
    const double angle = norm(w);
    const Vec axis = angle > 0 ? (1 / angle) * w : Vec{0, 0, 1};
    if (is_plane_) {
      dGeomPlaneGetParams(geom, plane_);
      dMatrix3 turn;
      dRFromAxisAndAngle(turn, dReal(axis[0]), dReal(axis[1]), dReal(axis[2]), dReal(angle));
      dVector3 n;
      dMultiply0_331(n, turn, plane_);
      dGeomPlaneSetParams(geom, n[0], n[1], n[2], dReal(plane_[3] + dot(to_vec(n), v)));
      return;
    }
    std::copy(dGeomGetPosition(geom), dGeomGetPosition(geom) + 3, position_);
    std::copy(dGeomGetRotation(geom), dGeomGetRotation(geom) + 12, rotation_);
    move(geom, v);
    turn_by(geom, angle, axis);
  }
  ~Moved() {
    if (is_plane_) {
      dGeomPlaneSetParams(geom_, plane_[0], plane_[1], plane_[2], plane_[3]);
      return;
    }
    dGeomSetPosition(geom_, position_[0], position_[1], position_[2]);
    dGeomSetRotation(geom_, rotation_);
  }
  Moved(const Moved&) = delete;
  Moved(Moved&&) = delete;
  Moved& operator=(const Moved&) = delete;
  Moved& operator=(Moved&&) = delete;

 private:
  dGeomID geom_;
  bool is_plane_;
  dVector4 plane_{};
  dVector3 position_{};
  dMatrix3 rotation_{};
};

dGeomID random_ellipsoid(Random& random) {
  const dGeomID geom =
      snCreateEllipsoid(nullptr, dReal(random.uniform(0.5, 1.5)), dReal(random.uniform(0.5, 1.5)), dReal(random.uniform(0.5, 1.5)));
  random.turn(geom);
  snGeomSetSolver(geom, SN_SOLVER_HYBRID, dReal(1e-14), 1000);
  return geom;
}

/// Compares with differences of the answers at moved geoms.
void check_differences(dGeomID g1, dGeomID g2, const snDerivatives& found) {
  const double h = 1e-4;
  const auto at = [&](const std::array<double, 12>& twist, double step) {
    const Moved one(g1, step * part(twist, 0), step * part(twist, 3)), two(g2, step * part(twist, 6), step * part(twist, 9));
    return proximity_of(g1, g2);
  };
  for (std::size_t j = 0; j < 12; ++j) {
    std::array<double, 12> twist{};
    twist[j] = 1;
    const snProximity ahead = at(twist, h), behind = at(twist, -h);
    CAPTURE(j);
    CHECK(std::abs((ahead.gap - behind.gap) / (2 * h) - found.gap[j]) <= 2e-7);
    const auto check = [&](const dReal* before, const dReal* after, const dReal(&rows)[3][12]) {
      for (std::size_t i = 0; i < 3; ++i) CHECK(std::abs((after[i] - before[i]) / (2 * h) - rows[i][j]) <= 3e-5);
    };
    check(behind.normal, ahead.normal, found.normal);
    check(behind.point1, ahead.point1, found.point1);
    check(behind.point2, ahead.point2, found.point2);
  }
  const std::array<double, 12> along = {0.3, -0.2, 0.4, 0.1, 0.3, -0.5, -0.2, 0.2, 0.1, 0.4, -0.3, 0.2};
  double second = 0;
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = 0; j < 12; ++j) second += along[i] * found.gap_hessian[i][j] * along[j];
  }
  if (dGeomGetClass(g1) == dPlaneClass || dGeomGetClass(g2) == dPlaneClass) {
    const double step = 1e-3;  // the gap is exact
    const double middle = proximity_of(g1, g2).gap;
    CHECK(std::abs((at(along, step).gap - 2 * middle + at(along, -step).gap) / (step * step) - second) <= 1e-5);
    return;
  }
  // The twists along one direction commute, so the gradient's derivative is the second derivative of the gap.
  const auto slope = [&](double step) {
    const Moved one(g1, step * part(along, 0), step * part(along, 3)), two(g2, step * part(along, 6), step * part(along, 9));
    const snDerivatives there = derivatives_of(g1, g2);
    double sum = 0;
    for (std::size_t j = 0; j < 12; ++j) sum += along[j] * there.gap[j];
    return sum;
  };
  CHECK(std::abs((slope(h) - slope(-h)) / (2 * h) - second) <= within_rounding(1e-6, 1000));
}

}  // namespace

TEST_CASE_FIXTURE(OdeSession,
                  "derivatives of geoms: with every collider they are the derivatives of snGeomProximity, in either order") {
  snSetWarmStart(0);
  Random random(31);
  int compared = 0;
  for (int k = 0; k < 12; ++k) {
    const Geom ours(random_ellipsoid(random));
    for (const ColliderKind kind : kColliderKinds) {
      const ColliderGeom collider(kind, random);
      if (kind == ColliderKind::Body) snGeomSetSolver(collider, SN_SOLVER_HYBRID, dReal(1e-14), 1000);
      if (kind != ColliderKind::Plane) place(collider, {1, -2, 0.5});
      place(ours, Vec{1, -2, 0.5} + 6.0 * random.direction());
      if (kind == ColliderKind::Plane) place(ours, 3.0 * random.direction());
      const snProximity apart = proximity_of(ours, collider);
      move(ours, (apart.gap - 0.4) * to_vec(apart.normal));
      const std::string name = name_of(kind);
      CAPTURE(name);
      CAPTURE(k);
      for (const bool is_swapped : {false, true}) {
        const dGeomID g1 = is_swapped ? dGeomID(collider) : dGeomID(ours), g2 = is_swapped ? dGeomID(ours) : dGeomID(collider);
        const snDerivatives found = derivatives_of(g1, g2);
        if (found.has_normal == 0) continue;
        ++compared;
        CHECK(found.has_gap == 1);
        CHECK(found.has_points == 1);
        CHECK(found.evaluations <= 32);
        const snProximity at = proximity_of(g1, g2);
        check_gradient_alone(g1, g2, at);
        if (!kIsSinglePrecision) check_differences(g1, g2, found);
      }
    }
  }
  CHECK(compared > 140);
}

TEST_CASE_FIXTURE(OdeSession, "derivatives of geoms: a ray, and the parameters of both geoms by name") {
  snSetWarmStart(0);
  const Geom ours(snCreateSuperellipsoid(nullptr, 1, dReal(0.7), dReal(0.5), dReal(2.5), 2));
  snGeomSetSolver(ours, SN_SOLVER_HYBRID, dReal(1e-14), 1000);
  snGeomSetRounding(ours, dReal(0.1));
  const Geom ray(dCreateRay(nullptr, 3));
  dGeomRaySet(ray, dReal(-1.5), dReal(0.4), dReal(1.5), 1, dReal(0.2), 0);
  if (!kIsSinglePrecision) {
    const snDerivatives found = derivatives_of(ours, ray);
    CHECK(found.status == SN_DERIVATIVES_ACTIVE_SET);
    CHECK(found.parameters2 == 0);
    const snProximity at = proximity_of(ours, ray);
    for (std::size_t j = 0; j < 3; ++j) CHECK(std::abs(found.gap[6 + j] - at.normal[j]) < 1e-6);
  }
  const Geom can(dCreateCylinder(nullptr, dReal(0.5), 1));
  place(can, {2, 1, 1});
  const snDerivatives found = derivatives_of(can, ours);
  REQUIRE(found.parameters1 == 2);
  CHECK(std::strcmp(found.parameter1[0].name, "radius") == 0);
  CHECK(std::strcmp(found.parameter1[1].name, "half_length") == 0);
  REQUIRE(found.parameters2 == 6);
  const char* const names[] = {"a", "b", "c", "delta", "epsilon", "radius"};
  for (int k = 0; k < 6; ++k) CHECK(std::strcmp(found.parameter2[k].name, names[k]) == 0);
  CHECK(std::abs(found.parameter2[5].value + 1) < within_rounding(1e-12));
  // The gap with another half-axis.
  const auto h = dReal(1e-3);
  const auto gap_with = [&](dReal a) {
    snGeomSuperellipsoidSetParams(ours, a, dReal(0.7), dReal(0.5), dReal(2.5), 2);
    return double{proximity_of(can, ours).gap};
  };
  CHECK(std::abs((gap_with(1 + h) - gap_with(1 - h)) / (2 * double{h}) - found.parameter2[0].value) < within_rounding(1e-5, 1000));
}

TEST_CASE_FIXTURE(OdeSession, "derivatives of geoms: a face on a plane says what is not defined, a mesh has a gradient alone") {
  const Geom brick(snCreateSuperellipsoid(nullptr, 1, 1, 1, 20, 20));
  const Geom plane(dCreatePlane(nullptr, 0, 0, 1, -2));
  const snDerivatives found = derivatives_of(brick, plane);
  CHECK(found.status == SN_DERIVATIVES_FREE_ON_FACE);
  CHECK(found.has_gap == 0);
  CHECK(found.has_normal == 0);
  for (const auto& row : found.gap_hessian) {
    for (const dReal number : row) CHECK(number == 0);
  }
  CHECK(found.gap[2] == 1);

  const MeshGeom floor(sheet_mesh(20, 20, 0.5));
  const Geom ball(snCreateEllipsoid(nullptr, dReal(0.5), dReal(0.4), dReal(0.3)));
  place(ball, {dReal(3.2), dReal(4.1), 1});
  const snProximity at = proximity_of(floor, ball);
  dReal gradient[12];
  REQUIRE(snGeomGapGradient(floor, ball, &at, gradient) == 1);
  CHECK(std::abs(gradient[8] - 1) < within_rounding(1e-9));
  CHECK(std::abs(gradient[2] + 1) < within_rounding(1e-9));
  // The point below the ball, from the mesh's origin.
  CHECK(std::abs(gradient[3] + 4.1) < within_rounding(1e-6, 10));
  CHECK(std::abs(gradient[4] - 3.2) < within_rounding(1e-6, 10));
  snDerivatives none;
  CHECK(refused(snGeomDerivatives(floor, ball, &at, &none), "snGeomDerivatives: g1 is a dTriMesh, but must be"));
  CHECK(snGeomIsFartherThan(floor, ball, dReal(0.6), nullptr) == 1);
  CHECK(snGeomIsFartherThan(ball, floor, dReal(0.8), nullptr) == 0);
}

TEST_CASE_FIXTURE(OdeSession,
                  "clearance of geoms: with every collider the bound holds, and the distance decides, in either order") {
  Random random(32);
  int evaluations = 0, questions = 0;
  for (int k = 0; k < 100; ++k) {
    const Geom ours(random_body(random));
    for (const ColliderKind kind : kColliderKinds) {
      const ColliderGeom collider(kind, random);
      place(ours, 6.0 * random.direction());
      const snProximity apart = proximity_of(ours, collider);
      move(ours, (apart.gap - random.uniform(-0.2, 2)) * to_vec(apart.normal));
      const std::string name = name_of(kind);
      CAPTURE(name);
      CAPTURE(k);
      for (const bool is_swapped : {false, true}) {
        const dGeomID g1 = is_swapped ? dGeomID(collider) : dGeomID(ours), g2 = is_swapped ? dGeomID(ours) : dGeomID(collider);
        const snProximity answer = proximity_of(g1, g2);
        const double slack = within_rounding(1e-8, 10);
        snClearance bound;
        for (const int budget : {1, 2, 3}) {
          REQUIRE(snGeomClearance(g1, g2, dInfinity, budget, &bound) == 1);
          CHECK(bound.lower_bound <= answer.gap + slack);
          CHECK((bound.evaluations <= budget || kind == ColliderKind::Plane));
          CHECK(std::abs(norm(to_vec(bound.normal)) - 1) < within_rounding(1e-12));
        }
        if (answer.gap < 0.05) continue;
        CHECK(dot(to_vec(bound.normal), to_vec(answer.normal)) > 0.3);
        REQUIRE(snGeomClearance(g1, g2, answer.gap / 2, 3, &bound) == 1);
        evaluations += bound.evaluations;
        ++questions;
        dVector3 normal = {0, 0, 0, 0};
        CHECK(snGeomIsFartherThan(g1, g2, answer.gap / 2, normal) == 1);
        CHECK(snGeomIsFartherThan(g1, g2, answer.gap * dReal(0.99), normal) == 1);
        const Vec proof = to_vec(normal);
        CHECK(snGeomIsFartherThan(g1, g2, answer.gap * dReal(0.99), normal) == 1);
        CHECK(norm(to_vec(normal) - proof) < within_rounding(1e-14));
        CHECK(snGeomIsFartherThan(g1, g2, answer.gap * dReal(1.01), normal) == 0);
        CHECK(snGeomIsFartherThan(g1, g2, answer.gap * dReal(1.01), nullptr) == 0);
      }
    }
  }
  CHECK(questions > 1000);
  CHECK(evaluations < 2 * questions);
}

TEST_CASE_FIXTURE(OdeSession, "derivatives and clearance of geoms: bad input is refused with its name") {
  const Geom ours(snCreateEllipsoid(nullptr, 1, 1, 1)), other(snCreateEllipsoid(nullptr, 1, 2, 1));
  const Geom sphere(dCreateSphere(nullptr, 1)), box(dCreateBox(nullptr, 1, 1, 1));
  place(other, {4, 0, 0});
  const snProximity at = proximity_of(ours, other);
  snProximity broken = at;
  broken.normal[0] = kNotANumber;
  snProximity no_gap = at;
  no_gap.gap = kNotANumber;
  snProximity empty = at;
  for (dReal& number : empty.normal) number = 0;
  snDerivatives derivatives;
  derivatives.evaluations = 77;
  snClearance clearance;
  clearance.evaluations = 77;
  dReal gradient[12] = {77};

  CHECK(refused(snGeomDerivatives(ours, other, nullptr, &derivatives), "snGeomDerivatives: at = NULL"));
  CHECK(refused(snGeomDerivatives(ours, other, &at, nullptr), "snGeomDerivatives: out = NULL"));
  CHECK(refused(snGeomDerivatives(ours, ours, &at, &derivatives), "the same geom"));
  CHECK(refused(snGeomDerivatives(ours, other, &broken, &derivatives), "at->normal = (nan, "));
  CHECK(refused(snGeomDerivatives(ours, other, &empty, &derivatives), "at->normal has the length 0, but must have 1"));
  CHECK(refused(snGeomDerivatives(ours, other, &no_gap, &derivatives), "at->gap = nan m is not finite"));
  CHECK(refused(snGeomDerivatives(sphere, box, &at, &derivatives), "must be a body made by snCreate"));
  const Geom space(reinterpret_cast<dGeomID>(dSimpleSpaceCreate(nullptr)));
  CHECK(refused(snGeomDerivatives(ours, space, &at, &derivatives), "g2 is a space, but must be a body made by snCreate"));

  CHECK(refused(snGeomGapGradient(ours, space, &at, gradient), "snGeomGapGradient: g2 is a space, but must be"));
  const Geom without_body(dCreateGeom(snGeomClass()));
  CHECK(refused(snGeomGapGradient(ours, without_body, &at, gradient),
                "g2 is a geom of this library's class, but must be a body made by snCreate"));
  CHECK(refused(snGeomGapGradient(ours, other, nullptr, gradient), "snGeomGapGradient: at = NULL"));
  CHECK(refused(snGeomGapGradient(ours, other, &at, nullptr), "gradient = NULL"));
  CHECK(refused(snGeomGapGradient(sphere, box, &at, gradient), "must be a body made by snCreate"));
  CHECK(refused(snGeomGapGradient(ours, other, &broken, gradient), "at->normal = (nan, "));

  CHECK(refused(snGeomClearance(ours, other, kNotANumber, 3, &clearance), "snGeomClearance: enough = nan m"));
  for (const int budget : {0, 4}) {
    CHECK(refused(snGeomClearance(ours, other, 1, budget, &clearance),
                  "max_evaluations = " + std::to_string(budget) + " is outside [1, 3]"));
  }
  CHECK(refused(snGeomClearance(ours, other, 1, 3, nullptr), "out = NULL"));
  CHECK(refused(snGeomClearance(ours, space, 1, 3, &clearance), "one of ODE's own geoms"));

  dVector3 normal = {kNotANumber, 0, 0, 0};
  CHECK(refused(snGeomIsFartherThan(ours, other, -100, normal), "snGeomIsFartherThan: normal = (nan, "));
  CHECK(refused(snGeomIsFartherThan(ours, other, kNotANumber, nullptr), "distance = nan m is not finite"));
  CHECK(refused(snGeomIsFartherThan(ours, nullptr, 1, nullptr), "g2 = NULL"));

  dGeomSetPosition(other, kNotANumber, 0, 0);
  CHECK(refused(snGeomDerivatives(ours, other, &at, &derivatives), "pose"));
  CHECK(refused(snGeomGapGradient(ours, other, &at, gradient), "pose"));
  CHECK(refused(snGeomClearance(ours, other, 1, 3, &clearance), "pose"));
  CHECK(refused(snGeomIsFartherThan(ours, other, -100, nullptr), "pose"));
  dGeomSetPosition(other, 0, 0, 3);
  const dMatrix3 turned = {kNotANumber, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  dGeomSetRotation(other, turned);
  CHECK(refused(snGeomDerivatives(ours, other, &at, &derivatives), "is not finite: rotation = ((nan, "));
  CHECK(derivatives.evaluations == 77);
  CHECK(clearance.evaluations == 77);
  CHECK(gradient[0] == 77);
}
