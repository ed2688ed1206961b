// A motion planned by OMPL's OpenDE extension, which simulates in ODE. An ellipsoid of ours is pushed over a floor, past a pillar
// of ours, to a goal.
#include <ompl/base/goals/GoalRegion.h>
#include <ompl/control/planners/rrt/RRT.h>
#include <ompl/extensions/ode/OpenDESimpleSetup.h>
#include <supernormal/supernormal.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace {

namespace base = ompl::base;
namespace control = ompl::control;

constexpr double kGoal[] = {2.5, 0};  // m

dGeomID require(dGeomID geom) {
  if (geom == nullptr) throw std::runtime_error(snLastError());
  return geom;
}

/// The world that the planner simulates. It outlives the planner, and ODE is closed after it.
class Floor : public control::OpenDEEnvironment {
 public:
  Floor() {
    world_ = dWorldCreate();
    dWorldSetGravity(world_, 0, 0, -9.81);
    space_ = dSimpleSpaceCreate(nullptr);
    dCreatePlane(space_, 0, 0, 1, 0);
    pillar_ = require(snCreateSuperellipsoid(space_, 0.2, 0.2, 0.5, 2, 20));
    dGeomSetPosition(pillar_, 1.25, 0, 0.5);
    dGeomID pebble = require(snCreateEllipsoid(space_, 0.3, 0.25, 0.2));
    dMass mass;
    if (snMassSetTotal(&mass, 1, pebble) == 0) throw std::runtime_error(snLastError());
    body_ = dBodyCreate(world_);
    dBodySetMass(body_, &mass);
    dGeomSetBody(pebble, body_);
    dBodySetPosition(body_, 0, 0, 0.2);
    collisionSpaces_ = {space_};
    stateBodies_ = {body_};
    stepSize_ = 0.02;
    maxContacts_ = 3;
  }
  ~Floor() override {
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }

  unsigned getControlDimension() const override { return 2; }
  void getControlBounds(std::vector<double>& lower, std::vector<double>& upper) const override {
    lower = {-6, -6};  // N
    upper = {6, 6};
  }
  void applyControl(const double* force) const override { dBodyAddForce(body_, force[0], force[1], 0); }
  /// The body may lie on the floor, but not touch the pillar.
  bool isValidCollision(dGeomID geom1, dGeomID geom2, const dContact&) const override {
    const bool has_body = dGeomGetBody(geom1) != nullptr || dGeomGetBody(geom2) != nullptr;  // the pillar stands on the floor
    return !has_body || (geom1 != pillar_ && geom2 != pillar_);
  }
  void setupContact(dGeomID, dGeomID, dContact& contact) const override {
    contact.surface.mode = dContactApprox1;
    contact.surface.mu = 0.3;
  }

 private:
  dSpaceID space_;
  dGeomID pillar_;
  dBodyID body_;
};

const double* position_of(const base::State* state) {
  return state->as<control::OpenDEStateSpace::StateType>()->getBodyPosition(0);
}

class Goal : public base::GoalRegion {
 public:
  explicit Goal(const base::SpaceInformationPtr& information) : GoalRegion(information) { threshold_ = 0.3; }  // m
  double distanceGoal(const base::State* state) const override {
    const double* position = position_of(state);
    return std::hypot(position[0] - kGoal[0], position[1] - kGoal[1]);
  }
};

void bound(control::OpenDEStateSpace& space) {
  base::RealVectorBounds bounds(3);
  const auto between = [&bounds](double low, double high) {
    bounds.setLow(low);
    bounds.setHigh(high);
    return bounds;
  };
  space.setVolumeBounds(between(-4, 4));
  space.setLinearVelocityBounds(between(-5, 5));
  space.setAngularVelocityBounds(between(-30, 30));
}

bool plan() {
  ompl::RNG::setSeed(1);
  const auto floor = std::make_shared<Floor>();
  control::OpenDESimpleSetup setup{control::OpenDEEnvironmentPtr(floor)};
  bound(*setup.getStateSpace()->as<control::OpenDEStateSpace>());
  setup.setGoal(std::make_shared<Goal>(setup.getSpaceInformation()));
  setup.setPlanner(std::make_shared<control::RRT>(setup.getSpaceInformation()));
  setup.setup();
  snResetStatistics();
  const base::PlannerStatus status = setup.solve(60);
  snStatistics statistics;
  snGetStatistics(&statistics);
  if (status != base::PlannerStatus::EXACT_SOLUTION) {
    std::printf("no exact solution: %s\n", status.asString().c_str());
    return false;
  }
  auto& path = setup.getSolutionPath();
  const double* end = position_of(path.getStates().back());
  std::printf("exact solution: %zu states to (%.2f, %.2f, %.2f) m; %llu queries of ours\n", path.getStateCount(), end[0], end[1],
              end[2], statistics.queries_cold + statistics.queries_warm + statistics.closed_forms);
  return statistics.closed_forms + statistics.queries_cold + statistics.queries_warm > 0;
}

}  // namespace

int main() {
  dInitODE2(0);
  bool is_solved = false;
  try {
    is_solved = plan();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ompl_host: %s\n", error.what());
  }
  snClose();
  dCloseODE();
  return is_solved ? 0 : 1;
}
