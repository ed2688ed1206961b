// Geoms that pass slowly through each other. The contacts of successive steps belong together.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "support/ode_fixture.hpp"

using namespace supernormal::test;

namespace {

constexpr int kSteps = 2000;
constexpr double kReach = 2;    // m; the path before and behind
constexpr double kTurn = 0.5;   // rad, over the whole path
constexpr double kBound = 1.2;  // m; no point of the moving geom is farther from its centre

struct Passage {
  int overlaps = 0;  // steps
  int switches = 0;  // from one separating translation to another
  int returns = 0;   // to a translation that was left
};

/// Moves `moving` through `still`. For one separating translation no depth changes by more than the motion. For another translation
/// the depth may be smaller at once.
Passage pass_through(dGeomID still, dGeomID moving) {
  const Vec direction = {2. / 3, -1. / 3, 2. / 3};
  const double motion = 2 * kReach / kSteps + kTurn / kSteps * kBound;
  Passage passage;
  std::vector<Vec> left;
  std::vector<dContactGeom> before;
  for (int step = 0; step <= kSteps; ++step) {
    const double way = 2.0 * step / kSteps - 1;
    place(moving, kReach * way * direction + Vec{0.01, 0.02, 0});
    dMatrix3 R;
    dRFromAxisAndAngle(R, 1, 2, 2, dReal(0.5 * kTurn * way));
    dGeomSetRotation(moving, R);
    const std::vector<dContactGeom> now = collide(still, moving);
    if (!now.empty() && !before.empty()) {
      ++passage.overlaps;
      for (const dContactGeom& contact : now) REQUIRE(to_vec(contact.normal) == to_vec(now[0].normal));
      const double change = now[0].depth - before[0].depth;
      if (std::abs(change) > motion * (1 + 1e-6)) {
        ++passage.switches;
        REQUIRE(change < 0);
        passage.returns += static_cast<int>(
            std::count_if(left.begin(), left.end(), [&](const Vec& normal) { return dot(normal, to_vec(now[0].normal)) > 0.97; }));
        left.push_back(to_vec(before[0].normal));
      }
    }
    before = now;
  }
  return passage;
}

}  // namespace

TEST_CASE("geoms that pass slowly through one another keep their translation until another is clearly shorter, and do not return") {
  const OdeSession session;
  for (int k = 0; k < 3; ++k) {
    const Geom still(k == 0   ? snCreateSuperellipsoid(nullptr, 1, dReal(0.7), dReal(0.5), 12, 20)
                     : k == 1 ? snCreateSuperellipsoid(nullptr, dReal(0.8), dReal(0.6), dReal(0.5), dReal(1.2), dReal(1.2))
                              : snCreateEllipsoid(nullptr, 2, dReal(0.3), dReal(0.2)));
    for (int collider = 0; collider < 4; ++collider) {
      const Geom moving(collider == 0   ? snCreateSuperellipsoid(nullptr, dReal(0.7), dReal(0.6), dReal(0.5), 8, 8)
                        : collider == 1 ? dCreateBox(nullptr, dReal(1.4), dReal(1.2), 1)
                        : collider == 2 ? dCreateCylinder(nullptr, dReal(0.5), dReal(1.6))
                                        : dCreateCapsule(nullptr, dReal(0.4), dReal(1.2)));
      const Passage passage = pass_through(still, moving);
      CAPTURE(k);
      CAPTURE(collider);
      CHECK(passage.overlaps > 200);
      CHECK(passage.switches <= 4);
      CHECK(passage.returns == 0);
    }
  }
}
