// A scene of grains in one form, stepped and timed.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "common/ode_geom.hpp"
#include "common/stopwatch.hpp"
#include "supernormal/supernormal.h"
#include "world/placement.hpp"
#include "world/stepper.hpp"
#include "world/world.hpp"

namespace scene_cost {

enum class SpaceKind { Hash, QuadTree, SweepAndPrune, Simple };
inline constexpr std::array kSpaceKinds = {SpaceKind::Hash, SpaceKind::QuadTree, SpaceKind::SweepAndPrune, SpaceKind::Simple};
const char* name_of(SpaceKind kind);

struct PhaseCosts {
  common::Stopwatch broad, narrow, joints, solver;
  int steps = 0;
  unsigned long long pairs = 0, contacts = 0;
  unsigned long long refused = 0;  ///< contacts without a unit normal, on which dJointAttach would abort (libccd)

  double seconds() const { return broad.seconds() + narrow.seconds() + joints.seconds() + solver.seconds(); }
};

/// Positions and velocities of the grains.
struct Snapshot {
  std::vector<falling_particles::Placement> placements;
  std::vector<std::array<double, 6>> velocities;  ///< m/s, rad/s
};

class GrainWorld {
 public:
  /// The scene must outlive this object. In every form the grains have the masses of the smooth ones.
  GrainWorld(const falling_particles::Scene& scene, const Snapshot& start, const common::GrainForm& form,
             SpaceKind space = SpaceKind::Hash);
  ~GrainWorld();
  GrainWorld(const GrainWorld&) = delete;
  GrainWorld& operator=(const GrainWorld&) = delete;

  void step();

  const PhaseCosts& costs() const { return costs_; }
  void forget_costs() { costs_ = {}; }

  Snapshot snapshot() const;

  /// The bodies, to measure energies. Their smooth geoms do not collide.
  const falling_particles::World& world() const { return world_; }

 private:
  void add_geoms(const common::GrainForm& form);
  void set_velocities(const Snapshot& start);
  void set_space_cells(SpaceKind kind);
  void collide_one_by_one();
  void collide_batch();
  static int name_pair(void* self, dGeomID g1, dGeomID g2);
  void make_joints();

  const falling_particles::Scene& scene_;
  std::vector<std::size_t> kinds_;
  falling_particles::World world_;
  dSpaceID space_;
  std::vector<common::OdeGeom> geoms_;
  falling_particles::ContactJoints joints_;
  snBatchID batch_;  // null: one pair after the other
  std::vector<std::pair<dGeomID, dGeomID>> pairs_;
  std::vector<dContactGeom> contacts_;
  PhaseCosts costs_;
};

}  // namespace scene_cost
