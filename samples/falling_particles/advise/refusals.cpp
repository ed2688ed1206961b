#include "refusals.hpp"

#include <ode/ode.h>
#include <supernormal/supernormal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/input_error.hpp"
#include "common/interval.hpp"
#include "doubts.hpp"
#include "observe/energy.hpp"
#include "observe/region.hpp"
#include "world/placement.hpp"

namespace falling_particles {
namespace {

/// Refuses grains of the lattice that start inside a part.
void refuse_start_in_parts(const World& world) {
  const Scene& scene = world.scene();
  std::vector<std::pair<dGeomID, dGeomID>> pairs;
  world.name_wall_pairs(&pairs, [](void* data, dGeomID g1, dGeomID g2) {
    static_cast<std::vector<std::pair<dGeomID, dGeomID>>*>(data)->emplace_back(g1, g2);
  });
  for (const auto& [geom, wall] : pairs) {
    const Wall* part = world.walls().wall_of(wall);
    if (part == nullptr || !part->is_part()) continue;
    snProximity proximity;
    if (snGeomProximity(geom, wall, &proximity) == 0) throw std::runtime_error(std::string("snGeomProximity: ") + snLastError());
    const Grain& grain = *grain_of(geom);
    constexpr double kRounding = 1e-6;  // of the smallest half-axis
    if (!(proximity.gap < -kRounding * grain.smallest_half_axis())) continue;
    const auto [x, y, z] = grain.position();
    throw InputError(scene.called + ": grain " + std::to_string(world.index_of(grain)) + " (" + grain.kind->name + ") starts at [" +
                     rounded(x, 6) + ", " + rounded(y, 6) + ", " + rounded(z, 6) + "] m, " + rounded(-proximity.gap) +
                     " m deep in " + part->called() + "; allowed: walls that leave the start of the grains free");
  }
}

/// The largest relative stiffness of bonds for each iteration of the solver (Bonds::stiffness). bonds.md has the measurement.
constexpr double kStiffnessPerIteration = 10;

[[noreturn]] void refuse_bond(const Scene& scene, const std::string& text) { throw InputError(scene.called + ": " + text); }

/// The line of the rule's file that gives the bond its radius; 0 if none does.
unsigned line_of_radius(const Bond& bond, const BondRule& rule) {
  const auto pair = std::ranges::find_if(rule.pairs, [&](const BondedPair& named) {
    return named.second == bond.second && (rule.wall || named.first == bond.first) && named.radius;
  });
  return pair == rule.pairs.end() ? 0 : pair->line;
}

/// m, the deepest overlap of a free wall with other walls at the start. Beside a state it is the one of grains, or of a thin wall.
double allowed_depth(const Wall& wall, const Scene& scene) {
  constexpr double kTouching = 1e-6;  // of the wall's size: the rounding of a mesh, whose vertices are single precision
  const double touching = kTouching * bounding_radius(wall.shape);
  if (!scene.start) return touching;
  return std::max(touching, scene.start->overlap * std::min(scene.smallest_half_axis(), thinnest(wall.shape) / 2));
}

double deepest_between(dGeomID g1, dGeomID g2) {
  constexpr int kMost = 64;
  std::array<dContactGeom, kMost> found;
  const int count = dCollide(g1, g2, kMost, found.data(), sizeof(dContactGeom));
  double deepest = 0;
  for (int i = 0; i < count; ++i) deepest = std::max<double>(deepest, found[static_cast<std::size_t>(i)].depth);
  return deepest;
}

/// Refuses a free wall that overlaps another one, beside a state by more than StartState::overlap. Both would be pushed apart.
void refuse_bad_flights(const World& world) {
  const Scene& scene = world.scene();
  const std::vector<dGeomID>& geoms = world.walls().geoms();
  for (std::size_t i = 0; i < geoms.size(); ++i) {
    const Wall& wall = scene.walls[i];
    if (!wall.flight) continue;
    const double allowed = allowed_depth(wall, scene);
    for (std::size_t k = 0; k < geoms.size(); ++k) {
      const double depth = k == i ? 0 : deepest_between(geoms[i], geoms[k]);
      if (depth <= allowed) continue;
      throw InputError(scene.called + ": part \"" + wall.name + "\", which is free, is " + rounded(depth) + " m deep in " +
                       scene.walls[k].called() + " at the start; allowed: " +
                       (scene.start ? "up to " + rounded(allowed) + " m, from start.overlap of the smallest half-axis"
                                    : "a start apart from all other walls, or a section [start], whose start.overlap allows more"));
    }
  }
}

/// Refuses grains of a state that overlap one another or walls by more than StartState::overlap, or are outside the container.
void refuse_bad_state(const World& world) {
  const Scene& scene = world.scene();
  const StartState& start = *scene.start;
  const auto line_of = [&](const Grain& grain) { return start.grains[world.index_of(grain)].line; };
  const auto name_of = [&](dGeomID geom) {
    if (const Wall* wall = world.walls().wall_of(geom)) return wall->called();
    return "the " + grain_of(geom)->kind->name + " of line " + std::to_string(line_of(*grain_of(geom)));
  };
  if (world.cell() != nullptr) world.cell()->place_images();
  const Overlap overlap = measure_overlap(world);
  if (overlap.relative_to_pair > start.overlap) {
    const bool is_wall_first = grain_of(overlap.worst[0]) == nullptr;
    const Grain& grain = *grain_of(overlap.worst[is_wall_first ? 1 : 0]);
    throw InputError(start.file.string(), line_of(grain),
                     "the " + grain.kind->name + " is " + rounded(overlap.worst_depth) + " m deep in " +
                         name_of(overlap.worst[is_wall_first ? 0 : 1]) + ", " + rounded(overlap.relative_to_pair) +
                         " of the smallest half-axis; allowed: up to " + shortest(start.overlap) + ", start.overlap");
  }
  for (const Grain& grain : world.present()) {
    if (is_inside(scene, grain.position())) continue;
    const auto [x, y, z] = grain.position();
    throw InputError(start.file.string(), line_of(grain),
                     "the " + grain.kind->name + " is at [" + shortest(x) + ", " + shortest(y) + ", " + shortest(z) +
                         "] m, outside the container, a " + kind_of(scene.container) + "; allowed: inside");
  }
}

/// Refuses a section [[bond]] that bonds nothing, or whose bonds are too stiff.
void refuse_bad_bonds(const World& world) {
  const Scene& scene = world.scene();
  const Bonds& bonds = *world.bonds();
  for (std::size_t rule = 0; rule < scene.bonds.size(); ++rule) {
    if (std::ranges::any_of(bonds.all(), [rule](const Bond& bond) { return bond.rule == rule; })) continue;
    const BondRule& unused = scene.bonds[rule];
    refuse_bond(scene, "bond \"" + unused.name + "\" bonds nothing: no " + (unused.wall ? "grain and part" : "two grains") +
                           " of the start are closer than bond.touching = " + shortest(*unused.touching) +
                           " of the smallest half-axis, or other bonds have them; allowed: a start with such pairs");
  }
  refuse_stiff_bonds(world, scene.solver.iterations);
}

/// s, from when on two walls that no drive moves have no space between them; empty if they always have.
std::optional<double> meeting_of(const FacingWalls& pair, const Scene& scene) {
  constexpr double kMost = 1e5;  // poses, which take 0.1 s
  const Wall& first = wall_named(pair[0], scene.walls);
  const Wall& second = wall_named(pair[1], scene.walls);
  if (first.drive || second.drive || (first.motions.empty() && second.motions.empty())) return std::nullopt;
  const double interval = std::max(scene.time.step, scene.time.duration / kMost);
  for (int i = 0; i * interval < scene.time.duration; ++i) {
    const double time = i * interval;
    const auto faces = facing_faces(first.shape, pose_at(first.start, first.motions, time), second.shape,
                                    pose_at(second.start, second.motions, time));
    if (!faces || faces->distance() <= 0) return time;
  }
  return std::nullopt;
}

/// Refuses two walls, between which a servo acts, that meet by their motions.
void refuse_meetings(const Scene& scene) {
  for (const Wall& wall : scene.walls) {
    if (!wall.drive || !wall.drive->servo) continue;
    for (const FacingWalls& pair : wall.drive->servo->between) {
      const std::optional<double> time = meeting_of(pair, scene);
      if (!time) continue;
      throw InputError(scene.called + ": the servo of " + wall.called() + " acts between \"" + pair[0] + "\" and \"" + pair[1] +
                       "\", which by their motions do not face each other, or have met, after " + rounded(*time) +
                       " s; allowed: motions whose until keeps them apart, or " + wall.key() + ".drive.area");
    }
  }
}

}  // namespace

void refuse_stiff_bonds(const World& world, int iterations) {
  const Scene& scene = world.scene();
  const auto [relative, grain, index] = world.bonds()->stiffness();
  const double allowed = kStiffnessPerIteration * iterations;
  if (relative <= allowed) return;
  const Bond& bond = world.bonds()->all()[index];
  const BondRule& rule = scene.bonds[bond.rule];
  std::string enough = "bond.modulus up to " + rounded(rule.modulus * allowed / relative) +
                       " Pa, a smaller radius, or time.step up to " + rounded(scene.time.step * std::sqrt(allowed / relative)) +
                       " s";
  const double most = std::ceil(relative / kStiffnessPerIteration);
  if (most <= Solver::kMostIterations) enough += ", or solver.iterations from " + shortest(most) + " on";
  const std::string text = "bond \"" + rule.name + "\" is too stiff for grain " + std::to_string(grain) + " (" +
                           world.grains()[grain].kind->name + "): bond.modulus is " + shortest(rule.modulus) +
                           " Pa, and its radius " + rounded(bond.radius) + " m; allowed: " + enough;
  if (const unsigned line = line_of_radius(bond, rule); line > 0) throw InputError(rule.file.string(), line, text);
  refuse_bond(scene, text);
}

void refuse_bad_start(const Scene& scene) {
  refuse_meetings(scene);
  if (!scene.start && scene.bonds.empty() && scene.parts().empty()) return;
  Random random(scene.seed);
  const World world(scene, place(scene, random));
  scene.start ? refuse_bad_state(world) : refuse_start_in_parts(world);
  if (!scene.bonds.empty()) refuse_bad_bonds(world);
  refuse_bad_flights(world);
}

}  // namespace falling_particles
