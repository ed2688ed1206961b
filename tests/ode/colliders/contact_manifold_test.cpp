// Several contacts of one pair: their number and places, and that no force jumps when their number changes.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "support/ode_world.hpp"

using namespace supernormal::test;

namespace {

using Contacts = std::vector<dContactGeom>;

/// The load of the contacts on a body of unit weight at rest: the force, and the torque about its centre over its longest
/// half-axis.
struct Load {
  Vec force{};
  Vec torque{};
};

constexpr double kLongest = 0.1;  // m; half-axis of the bricks
const int kPoses = draws(3000);   // on the way of a tilt, before jumps are bisected

/// Settings of the weighing. By default the body hardly moves in the step, and nothing pushes the bodies apart.
struct Weighing {
  int room = 8;        // max_contacts
  double erp = 0;      // fraction of the depth that a step removes
  double step = 1e-6;  // s
  int iterations = 300;
};

/// A body alone with the geom on which it stands, held in one pose after the other.
class Scale {
 public:
  Scale(dGeomID geom, dGeomID under, const Weighing& how = {})
      : geom_(geom), under_(under), how_(how), joints_(dJointGroupCreate(0)) {
    dWorldSetGravity(world_.id(), 0, 0, -1);
    dWorldSetERP(world_.id(), dReal(how.erp));
    dWorldSetQuickStepNumIterations(world_.id(), how.iterations);
    dMass mass;
    REQUIRE(snMassSetTotal(&mass, 1, geom) == 1);
    body_ = world_.add(geom, mass);
    dBodySetGyroscopicMode(body_, 0);
  }
  ~Scale() {
    dGeomSetBody(geom_, nullptr);
    dJointGroupDestroy(joints_);
  }
  Scale(const Scale&) = delete;
  Scale(Scale&&) = delete;
  Scale& operator=(const Scale&) = delete;
  Scale& operator=(Scale&&) = delete;

  Load weigh() {
    const Vec position = to_vec(dBodyGetPosition(body_));
    std::array<dContact, 8> contacts;
    std::array<dJointFeedback, 8> feedback{};
    const int count = dCollide(geom_, under_, how_.room, &contacts[0].geom, sizeof(dContact));
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      contacts[k].surface = {};
      const dJointID joint = dJointCreateContact(world_.id(), joints_, &contacts[k]);
      dJointAttach(joint, body_, nullptr);
      dJointSetFeedback(joint, &feedback[k]);
    }
    dBodySetLinearVel(body_, 0, 0, 0);
    dBodySetAngularVel(body_, 0, 0, 0);
    dRandSetSeed(1);
    dWorldQuickStep(world_.id(), dReal(how_.step));
    dJointGroupEmpty(joints_);
    dBodySetPosition(body_, dReal(position[0]), dReal(position[1]), dReal(position[2]));
    Load load;
    for (const dJointFeedback& of : feedback) {
      load.force = load.force + to_vec(of.f1);
      load.torque = load.torque + (1 / kLongest) * to_vec(of.t1);
    }
    return load;
  }

 private:
  dGeomID geom_, under_;
  Weighing how_;
  World world_;
  dJointGroupID joints_;
  dBodyID body_;
};

/// The allowed change of the load without a jump, as a fraction of the weight. A support point of a body |x|^8 moves by the seventh
/// root of the change of its normal. In single precision two poses differ by at least one rounding, 4e-9 m in the height. It
/// changes a depth of 0.2 mm, and with it the tilts by 2e-6 rad. Over these tilts the load in double precision also changes by
/// 0.034.
constexpr double kJump = kIsSinglePrecision ? 0.04 : 0.02;

double difference(const Load& a, const Load& b) { return std::max(norm(a.force - b.force), norm(a.torque - b.torque)); }

/// The largest jump of the load at(x), x from 0 to 1. Each of the largest changes is bisected until nothing continuous could change
/// as much. The rest is the jump.
template <class LoadAt>
double largest_jump(LoadAt at, int steps) {
  std::vector<std::pair<double, int>> differences;
  Load previous = at(0.0);
  for (int step = 1; step <= steps; ++step) {
    const Load load = at(static_cast<double>(step) / steps);
    differences.emplace_back(difference(load, previous), step);
    previous = load;
  }
  std::sort(differences.rbegin(), differences.rend());
  differences.resize(8);
  double largest = 0;
  for (const auto& [change, step] : differences) {
    double low = (step - 1.0) / steps;
    double high = static_cast<double>(step) / steps;
    Load load_of_low = at(low);
    Load load_of_high = at(high);
    for (int halving = 0; halving < 20; ++halving) {
      const double middle = 0.5 * (low + high);
      const Load load = at(middle);
      const bool is_lower = difference(load, load_of_low) > difference(load, load_of_high);
      (is_lower ? high : low) = middle;
      (is_lower ? load_of_high : load_of_low) = load;
    }
    largest = std::max(largest, difference(load_of_low, load_of_high));
  }
  return largest;
}

/// Tilts by `angle` about a horizontal axis, and puts the body over the plane z = 0 or on top of `under` with the given depth.
void lay(dGeomID body, dGeomID under, double angle, double direction, double depth) {
  dMatrix3 rotation;
  dRFromAxisAndAngle(rotation, dReal(std::cos(direction)), dReal(std::sin(direction)), 0, dReal(angle));
  dGeomSetRotation(body, rotation);
  double height = 10;
  // The body moves along z. This is exact for a plane, and takes a few steps for the flat top of a body.
  for (int k = 0; k < 50; ++k) {
    dGeomSetPosition(body, 0, 0, dReal(height));
    const snProximity proximity = proximity_of(body, under);
    const double excess = double{proximity.gap} + depth;
    if (std::abs(excess) <= 1e-9 * depth) return;
    height += excess / double{proximity.normal[2]};
  }
}

}  // namespace

TEST_CASE_FIXTURE(OdeSession,
                  "no load on a flat body jumps while it tilts or comes in deeper, on a plane and a box, at any max_contacts") {
  const Geom plane(dCreatePlane(nullptr, 0, 0, 1, 0));
  const Geom box(dCreateBox(nullptr, dReal(0.5), dReal(0.5), dReal(0.2)));
  dGeomSetPosition(box, dReal(0.02), dReal(0.01), dReal(-0.1));
  struct Row {
    dGeomID under;
    Weighing how;
    double first, last;  // rad; the tilts, at `depth`
    double depth;        // m
  };
  std::vector<Row> rows = {{plane, {}, -0.02, 0.38, 2e-4}, {box, {}, -0.02, 0.38, 2e-4}};
  for (const int room : {2, 3, 4, 8})
    rows.push_back({plane, {.room = room, .erp = 0.2, .step = 0.01, .iterations = 1000}, -0.1, 0.7, 2e-3});
  for (const Row& row : rows) {
    for (const double exponent : {5.0, 8.0, 60.0}) {
      if (exponent == 5 && row.how.erp > 0) continue;
      CAPTURE(row.how.room);
      CAPTURE(exponent);
      const Geom brick(
          snCreateSuperellipsoid(nullptr, dReal(kLongest), dReal(0.07), dReal(0.05), dReal(exponent), dReal(exponent)));
      Scale scale(brick, row.under, row.how);
      const auto tilted = [&](double x) {
        lay(brick, row.under, row.first + (row.last - row.first) * x, 1.1, row.depth);
        return scale.weigh();
      };
      CHECK(largest_jump(tilted, kPoses) <= kJump);
      const auto deepened = [&](double x) {
        lay(brick, row.under, 0.01, 1.1, 1e-5 * std::pow(1500, x));
        return scale.weigh();
      };
      CHECK(largest_jump(deepened, 500) <= within_rounding(1e-5, 1000));
    }
  }
}

TEST_CASE_FIXTURE(OdeSession,
                  "a face has four contacts at any depth up to 30 % of its half-height, and with a smaller max_contacts as many") {
  const Geom plane(dCreatePlane(nullptr, 0, 0, 1, 0));
  const Geom box(dCreateBox(nullptr, 1, 1, dReal(0.4)));
  const Geom table(snCreateSuperellipsoid(nullptr, dReal(0.5), dReal(0.5), dReal(0.2), 60, 60));
  dGeomSetPosition(box, 0, 0, dReal(-0.2));
  dGeomSetPosition(table, 0, 0, dReal(-0.2));
  for (const dGeomID under : {plane.operator dGeomID(), box.operator dGeomID(), table.operator dGeomID()}) {
    for (const double exponent : {8.0, 12.0, 20.0, 60.0, 200.0}) {
      CAPTURE(exponent);
      const Geom brick(
          snCreateSuperellipsoid(nullptr, dReal(kLongest), dReal(0.07), dReal(0.05), dReal(exponent), dReal(exponent)));
      for (const double depth : {1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 4e-3, 7e-3, 0.01, 0.015}) {
        CAPTURE(depth);
        dGeomSetPosition(brick, 0, 0, dReal(0.05 - depth));
        for (int room = 1; room <= 8; ++room)
          CHECK(collide(brick, under, room).size() == static_cast<std::size_t>(std::min(room, 4)));
      }
    }
  }
}
