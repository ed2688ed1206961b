// Tests that invalid parameters are refused with the parameter, its value and the range, and that nothing changes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <thread>

#include "ode/collider_fixture.hpp"
#include "supernormal/shapes/shape.hpp"
#include "support/ode_fixture.hpp"

using namespace supernormal::test;
using supernormal::Matrix3;

namespace {

constexpr dReal kNan = std::numeric_limits<dReal>::quiet_NaN();
constexpr dReal kInf = std::numeric_limits<dReal>::infinity();

/// Checks that a call returned 0 or NULL, and the text of the error.
template <typename Result>
void check_refused(Result result, const std::string& function, const std::string& value, const std::string& range) {
  const std::string text = snLastError();
  CAPTURE(text);
  CHECK(result == Result{});
  CHECK(text.find(function + ": ") == 0);
  CHECK(text.find(value) != std::string::npos);
  CHECK(text.find(range) != std::string::npos);
}

struct Parameters {
  dReal a = 0, b = 0, c = 0, delta = 0, epsilon = 0;
  explicit Parameters(dGeomID geom) { REQUIRE(snGeomSuperellipsoidGetParams(geom, &a, &b, &c, &delta, &epsilon) == 1); }
  bool operator==(const Parameters&) const = default;
};

void rotate(dGeomID geom, const Matrix3& R) {
  dMatrix3 rows{};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rows[4 * row + column] = dReal(R(row, column));
  }
  dGeomSetRotation(geom, rows);
}

void check_refused(dGeomID g1, dGeomID g2, const std::string& who) {
  CAPTURE(who);
  snProximity answer;
  CHECK(snGeomProximity(g1, g2, &answer) == 0);
  const std::string text = snLastError();
  CAPTURE(text);
  CHECK(text.find("the rotation of " + who + " is [") != std::string::npos);
  CHECK(text.find("right-handed") != std::string::npos);
  CHECK(collide(g1, g2).empty());
  CHECK(std::string(snLastError()).find("dCollide: the rotation of " + who) == 0);
}

}  // namespace

TEST_CASE_FIXTURE(OdeSession, "refusals: half-axes and exponents at creation") {
  struct Case {
    dReal a, b, c, delta, epsilon;
    const char *value, *range;
  };
  const Case cases[] = {{-1, 1, 1, 2, 2, "half-axis a = -1 m", "[1e-30, 1e+30] m"},
                        {1, 0, 1, 2, 2, "half-axis b = 0 m", "[1e-30, 1e+30] m"},
                        {1, 1, kInf, 2, 2, "half-axis c = inf m", "[1e-30, 1e+30] m"},
                        {1, kNan, 1, 2, 2, "half-axis b = nan m", "[1e-30, 1e+30] m"},
                        {1, 1, 1, 1, 2, "delta = 1", "[1.01, 1000]"},
                        {1, 1, 1, 2, 1001, "epsilon = 1001", "[1.01, 1000]"},
                        {1, 1, 1, kNan, 2, "delta = nan", "[1.01, 1000]"},
                        {1, 1, 1, 2, -kInf, "epsilon = -inf", "[1.01, 1000]"}};
  for (const Case& c : cases) {
    check_refused(snCreateSuperellipsoid(nullptr, c.a, c.b, c.c, c.delta, c.epsilon), "snCreateSuperellipsoid", c.value, c.range);
  }
  check_refused(snCreateEllipsoid(nullptr, 1, 1, -2), "snCreateEllipsoid", "half-axis c = -2 m", "[1e-30, 1e+30] m");
  check_refused(snCreateCapsule(nullptr, 0, 1), "snCreateCapsule", "radius = 0", "");
  check_refused(snCreateCapsule(nullptr, 1, -1), "snCreateCapsule", "length = -1", "");
  check_refused(snCreateSuperovoid(nullptr, 1, -1, 1, 2, 3, 0, 0), "snCreateSuperovoid", "half-axis b = -1 m", "");
  check_refused(snCreateSuperovoid(nullptr, 1, 1, 1, 2, 3, dReal(0.25), dReal(0.5)), "snCreateSuperovoid",
                "taper_x = 0.25 and taper_y = 0.5 differ, but with epsilon = 3", "");
  snClose();
  CHECK(snGeomClass() == -1);  // no refused geom is alive
}

TEST_CASE_FIXTURE(OdeSession, "refusals: a geom in place of a space") {
  const Geom sphere(dCreateSphere(nullptr, 1)), body(snCreateEllipsoid(nullptr, 1, 2, 3));
  const auto space_of = [](dGeomID geom) { return reinterpret_cast<dSpaceID>(geom); };
  check_refused(snCreateEllipsoid(space_of(sphere), 1, 2, 3), "snCreateEllipsoid", "space is a dSphere", "must be a space");
  check_refused(snGeomCopy(space_of(body), body), "snGeomCopy", "space is a geom of this library's class", "must be a space");
  const snBatchID batch = snBatchCreate(1);
  CHECK(snBatchCollide(batch, space_of(body), 1, nullptr, nullptr, [](void*, dGeomID, dGeomID, const dContactGeom*, int) {}) == -1);
  check_refused(0, "snBatchCollide", "space is", "must be a space");
  snBatchDestroy(batch);
}

TEST_CASE_FIXTURE(OdeSession, "refusals: a refused change leaves the geom unchanged") {
  const Geom geom(snCreateSuperellipsoid(nullptr, 1, 2, 3, 4, 5));
  REQUIRE(snGeomSetRounding(geom, dReal(0.25)) == 1);
  const Parameters before(geom);
  dReal box_before[6], box_after[6];
  dGeomGetAABB(geom, box_before);

  check_refused(snGeomSuperellipsoidSetParams(geom, 1, 1, kNan, 2, 2), "snGeomSuperellipsoidSetParams", "half-axis c = nan m",
                "[1e-30, 1e+30] m");
  check_refused(snGeomSuperellipsoidSetParams(geom, 1, 1, 1, dReal(0.5), 2), "snGeomSuperellipsoidSetParams", "delta = 0.5",
                "[1.01, 1000]");
  for (const dReal radius : {dReal(-0.5), kInf, kNan}) {
    check_refused(snGeomSetRounding(geom, radius), "snGeomSetRounding", "radius = ", "[0, 1e+30] m");
  }
  CHECK(Parameters(geom) == before);
  const Geom egg(snCreateSuperovoid(nullptr, 1, 1, 2, 2, 2, dReal(-0.25), dReal(0.25)));
  check_refused(snGeomSuperovoidSetParams(egg, 1, 1, 2, 2, 2, dReal(0.75), 0), "snGeomSuperovoidSetParams", "taper_x = 0.75",
                "[-0.70710678118");
  dReal taper_x = 0, other = 0;
  check_refused(snGeomSuperovoidGetParams(egg, &other, &other, &other, &other, &other, &other, nullptr),
                "snGeomSuperovoidGetParams", "taper_y = NULL", "");
  REQUIRE(snGeomSuperovoidGetParams(egg, &other, &other, &other, &other, &other, &taper_x, &other) == 1);
  CHECK(taper_x == dReal(-0.25));
  dGeomSetPosition(geom, 0, 0, 0);  // so that ODE computes the box again
  dGeomGetAABB(geom, box_after);
  for (int i = 0; i < 6; ++i) CHECK(box_before[i] == box_after[i]);
}

TEST_CASE_FIXTURE(OdeSession, "refusals: geoms of another class or of another kind of body") {
  const Geom sphere(dCreateSphere(nullptr, 1));
  dMass mass;
  dReal value = 7;
  for (const dGeomID wrong : {dGeomID(nullptr), dGeomID(sphere)}) {
    const std::string what = wrong == nullptr ? "geom = 0" : "geom is a dSphere";
    check_refused(snGeomSuperellipsoidSetParams(wrong, 1, 1, 1, 2, 2), "snGeomSuperellipsoidSetParams", what,
                  "must be a body made by snCreate");
    check_refused(snGeomSuperellipsoidGetParams(wrong, &value, &value, &value, &value, &value), "snGeomSuperellipsoidGetParams",
                  what, "must be");
    check_refused(snGeomSetRounding(wrong, 1), "snGeomSetRounding", what, "must be");
    check_refused(!std::isnan(snGeomPointDepth(wrong, 0, 0, 0)), "snGeomPointDepth", what, "must be");
    check_refused(snMassSet(&mass, 1, wrong), "snMassSet", what, "must be");
    check_refused(snMassSetTotal(&mass, 1, wrong), "snMassSetTotal", what, "must be");
    check_refused(snGeomSetSolver(wrong, SN_SOLVER_HYBRID, dReal(1e-9), 10), "snGeomSetSolver", what, "must be");
  }
  const Geom egg(snCreateSuperovoid(nullptr, 3, 2, 1, 2, 2, 0, 0)), ellipsoid(snCreateEllipsoid(nullptr, 3, 2, 1));
  const snShape shape = {[](const void*, const dReal*) { return dReal(1); },
                         [](const void*, const dReal* n, dReal* point) { std::copy_n(n, 3, point); }, nullptr, nullptr, nullptr};
  const Geom user(snCreateConvex(nullptr, &shape));
  check_refused(snGeomSuperovoidSetParams(ellipsoid, 1, 1, 1, 2, 2, 0, 0), "snGeomSuperovoidSetParams", "geom is a superellipsoid",
                "must be a superovoid");
  check_refused(snGeomSuperellipsoidSetParams(egg, 1, 1, 1, 2, 2), "snGeomSuperellipsoidSetParams", "geom is a superovoid",
                "must be an ellipsoid or a superellipsoid");
  check_refused(snGeomSuperellipsoidSetParams(user, 1, 1, 1, 2, 2), "snGeomSuperellipsoidSetParams", "user-defined body", "");
  check_refused(snGeomSuperellipsoidGetParams(user, &value, &value, &value, &value, &value), "snGeomSuperellipsoidGetParams",
                "user-defined body", "");
  CHECK(value == 7);
}

TEST_CASE_FIXTURE(OdeSession, "refusals: solver settings") {
  const Geom geom(snCreateEllipsoid(nullptr, 1, 1, 1));
  const auto check_both = [&](snSolver solver, dReal tolerance, int limit, const char* value, const char* range) {
    check_refused(snGeomSetSolver(geom, solver, tolerance, limit), "snGeomSetSolver", value, range);
    check_refused(snSetDefaultSolver(solver, tolerance, limit), "snSetDefaultSolver", value, range);
  };
  check_both(SN_SOLVER_HYBRID, 0, 10, "tolerance = 0", "[1e-15, 1]");
  check_both(SN_SOLVER_HYBRID, 2, 10, "tolerance = 2", "[1e-15, 1]");
  check_both(SN_SOLVER_HYBRID, kNan, 10, "tolerance = nan", "[1e-15, 1]");
  check_both(SN_SOLVER_HYBRID, dReal(1e-9), 0, "max_evaluations = 0", "[1, 1000000]");
  check_both(SN_SOLVER_HYBRID, dReal(1e-9), 1000001, "max_evaluations = 1000001", "[1, 1000000]");
  // C passes any int, unchecked.
  for (const int number : {3, 7, -1, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
    check_both(static_cast<snSolver>(number), dReal(1e-9), 10, ("solver = " + std::to_string(number) + " ").c_str(),
               "SN_SOLVER_FIXED_POINT (2)");
  }
}

TEST_CASE_FIXTURE(OdeSession, "refusals: mass, support, point and proximity") {
  const Geom geom(snCreateEllipsoid(nullptr, 1, 1, 1));
  const Geom other(snCreateEllipsoid(nullptr, 1, 1, 1));
  dMass mass;
  dMassSetSphereTotal(&mass, 3, 1);
  for (const dReal bad : {dReal(0), dReal(-1), kInf, kNan}) {
    check_refused(snMassSet(&mass, bad, geom), "snMassSet", "density = ", "(0, inf) kg/m^3");
    check_refused(snMassSetTotal(&mass, bad, geom), "snMassSetTotal", "total_mass = ", "(0, inf) kg");
  }
  const dReal largest = std::numeric_limits<dReal>::max();
  check_refused(snMassSet(&mass, largest, geom), "snMassSet", "mass = inf kg", "too heavy a body");  // it has 4.19 m^3
  CHECK(mass.mass == 3);
  check_refused(snMassSet(nullptr, 1, geom), "snMassSet", "mass = NULL", "must point");

  dVector3 point = {7, 7, 7, 7};
  const dVector3 zero = {0, 0, 0, 0};
  check_refused(snGeomSupport(geom, zero, point), "snGeomSupport", "direction = (0, 0, 0)", "must have a length");
  const dVector3 broken = {1, kNan, 0, 0};
  check_refused(snGeomSupport(geom, broken, point), "snGeomSupport", "direction = (1, nan, 0)", "not finite");
  CHECK(point[0] == 7);

  const dVector3 up = {0, 0, 1, 0};
  dGeomSetPosition(geom, kNan, 0, 0);
  check_refused(snGeomSupport(geom, up, point), "snGeomSupport", "the pose of geom", "not finite");
  CHECK(point[0] == 7);
  dGeomSetPosition(geom, 0, 0, 0);

  check_refused(!std::isnan(snGeomPointDepth(geom, 0, kInf, 0)), "snGeomPointDepth", "y = inf m", "[-1e+150, 1e+150] m");
  if (largest > 1e150) {
    check_refused(!std::isnan(snGeomPointDepth(geom, 0, 0, dReal(-1e300))), "snGeomPointDepth", "z = -1e+300 m",
                  "[-1e+150, 1e+150] m");
    dGeomSetPosition(geom, dReal(1e300), 0, 0);
    check_refused(!std::isnan(snGeomPointDepth(geom, 0, 0, 0)), "snGeomPointDepth", "the pose of geom", "within 1e+150 m");
    dGeomSetPosition(geom, 0, 0, 0);
  }

  snProximity answer;
  answer.gap = 7;
  check_refused(snGeomProximity(geom, geom, &answer), "snGeomProximity", "the same geom", "must be two");
  check_refused(snGeomProximity(geom, nullptr, &answer), "snGeomProximity", "g2 = NULL", "must point");
  check_refused(snGeomProximity(geom, other, nullptr), "snGeomProximity", "out = NULL", "must point");
  const Geom sphere(dCreateSphere(nullptr, 1));
  const Geom plane(dCreatePlane(nullptr, 0, 0, 1, 0));
  check_refused(snGeomProximity(sphere, plane, &answer), "snGeomProximity", "g1 is a dSphere and g2 is a dPlane",
                "one of them must be a body made by snCreate");
  dGeomSetPosition(other, kNan, 0, 0);
  check_refused(snGeomProximity(geom, other, &answer), "snGeomProximity", "the pose of g2 (a geom of this library's class)",
                "not finite");
  check_refused(snGeomProximity(other, geom, &answer), "snGeomProximity", "the pose of g1 (a geom of this library's class)",
                "not finite");
  check_refused(snGeomProximity(sphere, other, &answer), "snGeomProximity", "the pose of g2 (", "not finite");
  CHECK(answer.gap == 7);
}

TEST_CASE_FIXTURE(OdeSession, "refusals: each thread has its own text of the last error") {
  CHECK(snCreateEllipsoid(nullptr, -1, 1, 1) == nullptr);
  std::string before, after;
  std::thread([&] {
    before = snLastError();
    snCreateEllipsoid(nullptr, 1, -1, 1);
    after = snLastError();
  }).join();
  CHECK(before.empty());
  CHECK(after.find("half-axis b") != std::string::npos);
  CHECK(std::string(snLastError()).find("half-axis a") != std::string::npos);
}

TEST_CASE_FIXTURE(OdeSession, "a matrix that is not near a rotation is refused by name, and gives no contact and no NaN") {
  Matrix3 shear = Matrix3::Identity(), mirror = Matrix3::Identity();
  shear(0, 1) = 0.05;
  mirror(2, 2) = -1;
  const Matrix3 huge = Matrix3::Constant(double{std::numeric_limits<dReal>::max()});
  for (const Matrix3& wrong : {Matrix3(1.02 * Matrix3::Identity()), shear, mirror, Matrix3(Matrix3::Zero()), huge}) {
    const Geom body(snCreateSuperellipsoid(nullptr, 1, dReal(0.8), dReal(0.6), 3, 4));
    const Geom other(snCreateEllipsoid(nullptr, 1, 1, 1));
    rotate(body, wrong);
    check_refused(body, other, "a geom of this library's class");
    check_refused(other, body, "a geom of this library's class");
    CHECK(std::isnan(snGeomPointDepth(body, 0, 0, 0)));
    CHECK(std::string(snLastError()).find("snGeomPointDepth: the rotation of ") == 0);
    const dVector3 up = {0, 0, 1, 0};
    dVector3 point = {7, 7, 7, 7};
    CHECK(snGeomSupport(body, up, point) == 0);
    CHECK(point[0] == 7);
    dReal aabb[6];
    dGeomGetAABB(body, aabb);
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(aabb[2 * axis] == -dInfinity);
      CHECK(aabb[2 * axis + 1] == dInfinity);
    }
  }
  const Geom body(snCreateEllipsoid(nullptr, 1, 1, 1));
  const Geom box(dCreateBox(nullptr, 1, 1, 1));
  rotate(box, shear);
  check_refused(body, box, "a dBox");
  check_refused(box, body, "a dBox");
}

TEST_CASE_FIXTURE(OdeSession, "a rotation with three decimals is accepted") {
  const Geom body(snCreateEllipsoid(nullptr, 1, 1, 1));
  Matrix3 typed;
  typed << 0.866, -0.5, 0, 0.5, 0.866, 0, 0, 0, 1;
  rotate(body, typed);
  const double depth = snGeomPointDepth(body, dReal(0.3), dReal(0.4), 0);
  CHECK(depth == doctest::Approx(0.5).epsilon(1e-6));
}
