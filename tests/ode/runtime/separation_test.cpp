// Pairs that cannot have met are not asked. The contacts are the same, bit for bit, as with a query of every pair.
#include "supernormal/proximity/separation.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "ode/collider_fixture.hpp"
#include "ode/colliders/contact.hpp"
#include "ode/colliders/solve_pair.hpp"
#include "ode/runtime/warm_start.hpp"
#include "support/draw.hpp"

using namespace supernormal;
using namespace supernormal::ode;
using namespace supernormal::test;

namespace {

// A pair of bodies with extents around `size` (m) on a random walk. It is asked with and without the memory of its gap.
class Walk {
 public:
  Walk(Random& random, double size) : random_(random), size_(size), one_(draw(random, size)), other_(draw(random, size)) {
    random.turn(one_);
    random.turn(other_);
    place(other_, size * random.log_uniform(0.3, 2.2) * random.direction());
  }

  void step(double share) {
    const double pull = random_.uniform(0, 1) < 0.5 ? -1.0 : 1.0;  // towards body 1, or away from it
    const Vec between = to_vec(dGeomGetPosition(other_)) - to_vec(dGeomGetPosition(one_));
    move(other_, (pull * share * random_.uniform(0, 1)) * between + (share * size_) * random_.direction());
    for (const dGeomID geom : {dGeomID(one_), dGeomID(other_)}) turn_by(geom, share, random_.direction());
  }

  // The same entry as in the table, but for the gap.
  std::vector<dContactGeom> ask_always() {
    const BodyPair pair(one_, other_);
    LastNormal last;
    std::vector<dContactGeom> contacts(8);
    const ContactManifold manifold = pair.solve(remembered_, QueryKind::Contacts, last);
    contacts.resize(static_cast<std::size_t>(write_contacts(manifold, {one_, other_, 8, contacts.data(), sizeof(dContactGeom)})));
    remembered_ = last.entry();
    remembered_.gap = 0;
    return contacts;
  }

  std::vector<dContactGeom> ask() const { return collide(one_, other_); }
  void set_solver(snSolver solver) {
    for (const dGeomID geom : {dGeomID(one_), dGeomID(other_)}) REQUIRE(snGeomSetSolver(geom, solver, dReal(1e-9), 100) == 1);
  }

 private:
  static dGeomID draw(Random& random, double size) {
    const auto axis = [&] { return dReal(size * random.log_uniform(0.1, 1)); };
    const dReal a = axis(), b = axis(), c = axis();
    const auto exponent = [&] { return dReal(1 + random.log_uniform(0.02, 200)); };
    const double kind = random.uniform(0, 4);
    if (kind < 1) return snCreateEllipsoid(nullptr, a, b, c);
    const dReal delta = exponent(), epsilon = exponent();
    if (kind < 2) return snCreateSuperovoid(nullptr, a, b, c, dReal(2.5), 2, dReal(0.2), dReal(-0.1));
    const dGeomID geom = snCreateSuperellipsoid(nullptr, a, b, c, delta, epsilon);
    if (kind > 3) snGeomSetRounding(geom, dReal(0.1 * size));
    return geom;
  }

  Random& random_;
  double size_;
  Geom one_, other_;
  CachedNormal remembered_;
};

}  // namespace

TEST_CASE_FIXTURE(OdeSession,
                  "pairs that cannot have met: the contacts of a query, bit for bit, for every size, motion and solver") {
  Random random(91);
  unsigned long long skipped = 0, asked = 0, touched = 0;
  for (const snSolver solver : {SN_SOLVER_HYBRID, SN_SOLVER_NEWTON, SN_SOLVER_FIXED_POINT}) {
    CAPTURE(solver);
    for (const double size : {1e-3, 0.1, 10.0}) {
      CAPTURE(size);
      for (const double share : {0.0, 1e-4, 1e-3, 1e-2, 0.1}) {
        CAPTURE(share);
        for (int i = 0; i < draws(30); ++i) {
          CAPTURE(i);
          Walk walk(random, size);
          walk.set_solver(solver);
          for (int step = 0; step < 40; ++step) {
            CAPTURE(step);
            const auto always = walk.ask_always();
            snResetStatistics();
            const auto contacts = walk.ask();
            REQUIRE(contacts.size() == always.size());
            REQUIRE(same_bits(contacts, always));
            const bool is_skipped = statistics().queries_warm == 1 && statistics().evaluations_warm == 0;
            skipped += is_skipped ? 1 : 0;
            asked += is_skipped ? 0 : 1;
            touched += contacts.empty() ? 0 : 1;
            walk.step(share);
          }
        }
      }
    }
  }
  CAPTURE(asked);
  CHECK(skipped > draws(20000));
  CHECK(touched > draws(5000));
}

TEST_CASE("pairs that cannot have met: the bound holds for every motion, and is the gap itself without a motion") {
  Random random(92);
  const auto vector = [](const Vec& v) { return Vector3(v[0], v[1], v[2]); };
  // Body 2 is a ball of radius 1 about a point at the distance 0.5 from its origin, so that it touches its bounding sphere.
  const Vector3 centre2(0.3, 0, 0.4);
  const auto s = [&](const Vector3& n, const Vector3& offset, const Vector3& m) {
    return n.dot(offset) - 1 - (1 - m.dot(centre2));
  };
  for (int i = 0; i < 1000; ++i) {
    const Vector3 n = vector(random.direction()), offset = 3 * vector(random.direction()), m = vector(random.direction());
    const Separation then{n, s(n, offset, m), offset, m};
    CHECK(least_gap_after(then, offset, m, 1, 1.5) == doctest::Approx(then.gap).epsilon(1e-13));
    const Vector3 later = offset + 0.3 * vector(random.direction()), turned = vector(random.direction());
    CHECK(least_gap_after(then, later, turned, 1, 1.5) <= s(n, later, turned));
  }
}

TEST_CASE_FIXTURE(OdeSession, "pairs that cannot have met: a user's shape may grow without notice, and is asked every time") {
  dReal axes[3] = {1, 1, 1};
  const snShape shape = {ellipsoid_support, ellipsoid_point, nullptr, axes, nullptr};
  const Geom one(snCreateConvex(nullptr, &shape)), other(snCreateEllipsoid(nullptr, 1, 1, 1));
  place(other, {3, 0, 0});
  CHECK(collide(one, other).empty());
  CHECK(collide(one, other).empty());
  axes[0] = dReal(2.1);
  CHECK(collide(one, other).size() == 1);
}

// The gap of balls is known at the line of their centres only, and so is what may be remembered of it.
TEST_CASE_FIXTURE(OdeSession, "balls that pass one another and then meet: no contact is missed") {
  const Geom one(snCreateEllipsoid(nullptr, 1, 1, 1)), other(snCreateEllipsoid(nullptr, 1, 1, 1));
  for (const double angle : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}) {
    place(other, {2.3 * std::cos(angle), 2.3 * std::sin(angle), 0});
    CHECK(collide(one, other).empty());
  }
  for (int step = 0; step < 15; ++step) {
    const double distance = 2.23 - 0.05 * step;
    place(other, {distance * std::cos(1.0), distance * std::sin(1.0), 0});
    const double depth = 2 - distance;
    const std::vector<dContactGeom> contacts = collide(one, other);
    CHECK(contacts.size() == (depth > 0 ? 1 : 0));
    if (!contacts.empty()) CHECK(double{contacts[0].depth} == doctest::Approx(depth).epsilon(1e-6));
  }
}
