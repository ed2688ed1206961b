// Ellipsoids that hit each other without friction or loss.
#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "lab.hpp"

namespace single_bodies {
namespace {

constexpr double kStep = 5e-5;
constexpr int kSide = 4;  // bodies along an edge of the cloud

struct Totals {
  Vector3 momentum = Vector3::Zero();
  Vector3 angular = Vector3::Zero();
  double translation = 0;
  double rotation = 0;
  double energy() const { return translation + rotation; }
};

Totals totals(const std::vector<dBodyID>& bodies) {
  Totals sum;
  for (const dBodyID body : bodies) {
    const Vector3 p = mass_of(body) * velocity(body);
    sum.momentum += p;
    sum.angular += position(body).cross(p) + angular_momentum(body);
    sum.translation += translation_energy(body);
    sum.rotation += rotation_energy(body);
  }
  return sum;
}

/// Adds a cloud of triaxial ellipsoids that fly in all directions, without rotation.
std::vector<dBodyID> add_cloud(Lab& lab, double pitch) {
  std::mt19937_64 engine(3);
  const auto random = [&] { return 2 * static_cast<double>(engine() >> 11U) * 0x1p-53 - 1; };
  std::vector<dBodyID> bodies;
  for (int i = 0; i < kSide * kSide * kSide; ++i) {
    bodies.push_back(lab.add(snCreateEllipsoid(lab.space(), dReal(0.05), dReal(0.035), dReal(0.025)), 1000));
    const Vector3 axis{random(), random(), random()};
    turn(bodies.back(), axis, 3 * random());
    const int row = i / kSide % kSide;
    const int layer = i / (kSide * kSide);
    const Vector3 cell(i % kSide, row, layer);
    set_position(bodies.back(), pitch * (cell - Vector3::Constant(0.5 * (kSide - 1))));
    const Vector3 v{random(), random(), random()};
    set_velocity(bodies.back(), v);
  }
  return bodies;
}

void make_elastic(const Lab& lab) {
  dWorldSetERP(lab.world(), 0);  // only the bounce, without a push out of the overlap
  dWorldSetCFM(lab.world(), 0);
  dWorldSetQuickStepNumIterations(lab.world(), 50);
}

}  // namespace

Results elastic_gas() {
  Lab lab({fx::Restitution{1, 0, {}}}, kStep);
  make_elastic(lab);
  const double wall = 0.3;
  for (const double side : {-1.0, 1.0}) {
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 n = -side * Vector3::Unit(axis);
      dCreatePlane(lab.space(), dReal(n.x()), dReal(n.y()), dReal(n.z()), dReal(-wall));
    }
  }
  const std::vector<dBodyID> cloud = add_cloud(lab, 0.12);
  const Totals start = totals(cloud);
  double rotation_share = 0;
  int samples = 0;
  for (int step = 0; step < 80000; ++step) {
    lab.step();
    if (step < 40000) continue;
    const Totals now = totals(cloud);
    rotation_share += now.rotation / now.energy();
    ++samples;
  }
  Results results = {{"elastic gas of 64 ellipsoids in a box, 4 s", "energy at the end / start",
                      totals(cloud).energy() / start.energy(), 1, "conserved"},
                     {"", "share of rotation in the energy, mean of 2 s", rotation_share / samples, 0.5, "equipartition"}};

  Lab open({fx::Restitution{1, 0, {}}}, kStep);
  make_elastic(open);
  const std::vector<dBodyID> free_cloud = add_cloud(open, 0.12);
  for (const dBodyID body : free_cloud) set_velocity(body, velocity(body) - 8 * position(body));  // inwards
  const Totals before = totals(free_cloud);
  for (int step = 0; step < 20000; ++step) open.step();
  const Totals after = totals(free_cloud);
  const double size = std::sqrt(2 * before.energy() * mass_of(free_cloud.front()) * static_cast<double>(free_cloud.size()));
  results.push_back({"the same falling together in open space, 1 s", "change of momentum / sqrt(2 m E)",
                     (after.momentum - before.momentum).norm() / size, 0, "conserved"});
  results.push_back({"", "change of angular momentum / (0.3 m sqrt(2 m E))", (after.angular - before.angular).norm() / (size * 0.3),
                     0, "conserved"});
  results.push_back({"", "energy at the end / start", after.energy() / before.energy(), 1, "conserved"});
  return results;
}

}  // namespace single_bodies
