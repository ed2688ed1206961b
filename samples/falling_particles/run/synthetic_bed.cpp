// The synthetic benchmark of a bed.

#include <supernormal/supernormal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <variant>

#include "base/processor_time.hpp"
#include "forecast.hpp"
#include "world/contact_joints.hpp"
#include "world/placement.hpp"
#include "world/world.hpp"

namespace falling_particles {
namespace {

constexpr double kPairsPerGrain = 3.5;  // pairs whose bounding boxes meet, in a bed of mixed grains
constexpr double kRest = 0.1;           // of a step: broad phase, contact joints, monitors
constexpr double kLongestTiming = 0.5;  // s, for each of the two timings

// Way of a grain in a step of a flow, of its smallest half-axis: enough to end searches that start at their last normal. With
// contacts ahead, pairs of drum.toml take 1.03 ms in a step. It is 1.06 ms with half and 1.02 ms with twice of it, and 0.62 ms
// without.
constexpr double kFlow = 0.03;

/// Runs `work` at least three times, and returns the least of its times (s).
template <typename Work>
double time_of(const Work& work) {
  double least = INFINITY;
  const double start = processor_time();
  for (int i = 0; i < 3 || (i < 100 && processor_time() - start < kLongestTiming); ++i) {
    const double before = processor_time();
    work();
    least = std::min(least, processor_time() - before);
  }
  return least;
}

/// The relative numbers of the kinds in the scene, or in the mixtures of its feeders.
std::vector<double> shares_of_kinds(const Scene& scene) {
  std::vector<double> shares;
  for (const GrainCount& entry : scene.kinds) shares.push_back(entry.count);
  if (scene.grains_at_start() > 0) return shares;
  for (const Feeder& feeder : scene.feeders) {
    for (const FedKind& fed : feeder.mixture) shares[fed.kind] += fed.fraction;
  }
  return shares;
}

/// Places grains in a row along x, far apart.
std::vector<Placement> row_of(const Scene& scene, int grains) {
  const std::vector<double> shares = shares_of_kinds(scene);
  double sum = 0;
  for (const double share : shares) sum += share;
  Random random(scene.seed);
  std::vector<double> given(shares.size(), 0);
  std::vector<Placement> row;
  for (int i = 0; i < grains; ++i) {
    std::size_t next = 0;  // the kind that is most below its share
    for (std::size_t kind = 0; kind < shares.size(); ++kind) {
      const auto behind = [&](std::size_t k) { return shares[k] / sum * (i + 1) - given[k]; };
      if (behind(kind) > behind(next)) next = kind;
    }
    ++given[next];
    const double distance = 2.1 * scene.largest_bounding_radius();
    row.push_back({next, {i * distance, 0, 0}, random.rotation(), scene.kinds[next].scale(0)});
  }
  return row;
}

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

/// A contact point halfway between two grains.
dContactGeom contact_of(const Grain& one, const Grain& other) {
  dContactGeom contact{};
  const Point a = one.position();
  const Point b = other.position();
  const double length = distance(a, b);
  for (std::size_t i = 0; i < 3; ++i) {
    contact.pos[i] = (a[i] + b[i]) / 2;
    contact.normal[i] = (a[i] - b[i]) / length;
  }
  contact.depth = 3e-3 * one.smallest_half_axis();  // as in beds of samples/scenes
  contact.g1 = one.geom;
  contact.g2 = other.geom;
  return contact;
}

double time_solver(World& world, double step) {
  const std::vector<Grain>& grains = world.grains();
  ContactJoints joints(world);
  return time_of([&] {
    std::vector<dContactGeom> contacts;
    for (std::size_t i = 0; i < grains.size(); ++i) {
      for (std::size_t k = 1; k <= static_cast<std::size_t>(kContactsPerGrain) && i + k < grains.size(); ++k) {
        contacts.push_back(contact_of(grains[i], grains[i + k]));
      }
    }
    joints.replace(contacts);
    world.effects().apply_forces();
    dWorldQuickStep(world.id(), step);
  });
}

/// m, between the closest geoms of two grains.
double gap_of(const Grain& one, const Grain& other) {
  double gap = INFINITY;
  for (dGeomID a : one.geoms()) {
    for (dGeomID b : other.geoms()) {
      snProximity proximity;
      if (snGeomProximity(a, b, &proximity) == 0) throw std::runtime_error(std::string("snGeomProximity: ") + snLastError());
      gap = std::min<double>(gap, proximity.gap);
    }
  }
  return gap;
}

/// Moves the grain `other` along x until it touches `one`.
void bring_together(const Grain& one, const Grain& other) {
  for (int i = 0; i < 5; ++i) {
    const Point p = other.position();
    dBodySetPosition(other.body, p[0] - gap_of(one, other), p[1], p[2]);
  }
}

/// Moves a grain by `way` (m) along y, and turns it by as much at its surface, with the velocities of a step.
void shift(const Grain& grain, double way, double step) {
  const Point p = grain.position();
  dBodySetPosition(grain.body, p[0], p[1] + way, p[2]);
  const double angle = way / grain.smallest_half_axis();
  const auto [w, x, y, z] = grain.quaternion();
  const Eigen::Quaterniond turned = Eigen::AngleAxisd(angle, Vector3::UnitZ()) * Eigen::Quaterniond(w, x, y, z);
  const dQuaternion q = {turned.w(), turned.x(), turned.y(), turned.z()};
  dBodySetQuaternion(grain.body, q);
  dBodySetLinearVel(grain.body, 0, way / step, 0);
  dBodySetAngularVel(grain.body, 0, 0, angle / step);
}

/// Times the pairs of a bed at rest, or of a flow, whose grains move in each step.
double time_pair(const World& world, bool flows) {
  const std::vector<Grain>& grains = world.grains();
  const std::size_t pairs = std::min<std::size_t>(grains.size() / 2, 100);
  for (std::size_t i = 0; i < pairs; ++i) bring_together(grains[2 * i], grains[2 * i + 1]);
  double way = flows ? kFlow : 0;  // of the smallest half-axis
  const double seconds = time_of([&] {
    way = -way;
    for (std::size_t i = 0; i < pairs; ++i) {
      if (flows) shift(grains[2 * i], way * grains[2 * i].smallest_half_axis(), world.scene().time.step);
      for (dGeomID a : grains[2 * i].geoms()) {
        for (dGeomID b : grains[2 * i + 1].geoms()) {
          std::array<dContactGeom, kContactsPerPair> found;
          dCollide(a, b, kContactsPerPair, found.data(), sizeof(dContactGeom));
        }
      }
    }
  });
  return pairs == 0 ? 0 : seconds / static_cast<double>(pairs);
}

/// Whether grains go on moving: on walls that move, or from feeders.
bool flows(const Scene& scene) { return !scene.feeders.empty() || std::ranges::any_of(scene.walls, &Wall::moves); }

}  // namespace

BedTimes time_bed(const Scene& scene, int grains) {
  Scene still = scene;  // only its grains and effects
  still.container = Box{{1, 1}};
  still.walls.clear();
  still.bonds.clear();
  still.feeders.clear();
  still.periodic = {};
  std::erase_if(still.effects,  // all grains stay awake
                [](const auto& effect) { return std::holds_alternative<supernormal::effects::AutoDisable>(effect); });
  World world(still, row_of(scene, grains));
  BedTimes times;
  times.narrow_phase = kPairsPerGrain * time_pair(world, flows(scene));
  times.solver = time_solver(world, scene.time.step) / grains;
  times.all = (1 + kRest) * (times.solver + times.narrow_phase);
  return times;
}

}  // namespace falling_particles
