#include "scene_tables.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "common/number_text.hpp"
#include "common/random.hpp"
#include "grain_world.hpp"
#include "model/container_walls.hpp"
#include "observe/bed.hpp"
#include "observe/energy.hpp"
#include "observe/overlap.hpp"
#include "rocking.hpp"

namespace scene_cost {
namespace {

using common::FormKind;
using common::GrainForm;
using common::joined;
using common::MeasuredTable;
using common::MeshSize;
using common::number;
using common::Random;
using falling_particles::Scene;

constexpr double kSettlingTime = 0.6;  // s; a bed of this height is at rest after a third of this time
constexpr int kWarmUpSteps = 5;        // steps before the measurement of a form that starts from the bed of another one
constexpr int kRounds = 8;
constexpr int kStepsPerRound = 4;

const std::vector<MeshSize> kMeshSizes = {{6, 5}, {12, 10}, {24, 20}, {48, 40}};  // 32, 122, 482, 1922 vertices

constexpr const char* kCostColumns = "pairs,contacts,refused,broad_s,narrow_s,joints_s,solver_s,step_s";

/// The cells of a row: mean costs per step.
std::string cost_cells(const PhaseCosts& costs) {
  const auto mean = [&](auto total) { return number(static_cast<double>(total) / costs.steps); };
  return joined({mean(costs.pairs), mean(costs.contacts), mean(costs.refused), mean(costs.broad.seconds()),
                 mean(costs.narrow.seconds()), mean(costs.joints.seconds()), mean(costs.solver.seconds()), mean(costs.seconds())});
}

Snapshot start_of(const Scene& scene) {
  Random random(scene.seed);
  return {falling_particles::place(scene, random), {}};
}

Snapshot settle(const Scene& scene, const GrainForm& form) {
  GrainWorld world(scene, start_of(scene), form);
  const int steps = static_cast<int>(std::lround(kSettlingTime / scene.time.step));
  for (int step = 0; step < steps; ++step) world.step();
  return world.snapshot();
}

std::vector<GrainForm> polyhedra() {
  std::vector<GrainForm> forms;
  forms.reserve(2 * kMeshSizes.size());
  for (const FormKind kind : {FormKind::Convex, FormKind::Trimesh}) {
    for (const MeshSize size : kMeshSizes) forms.push_back({kind, 0, size});
  }
  return forms;
}

/// Polyhedra start from the bed of the smooth grains. They fit into these grains, because their vertices are on the boundary. Boxes
/// are larger and need their own bed.
std::vector<std::string> time_forms(const Scene& scene) {
  const Snapshot smooth_bed = settle(scene, {});
  const Snapshot box_bed = settle(scene, {FormKind::Box});
  std::vector<GrainForm> forms = {{}, {FormKind::Box}, {.threads = 1}, {.threads = 2}};
  const std::vector<GrainForm> others = polyhedra();
  forms.insert(forms.end(), others.begin(), others.end());
  std::vector<std::unique_ptr<GrainWorld>> worlds;
  worlds.reserve(forms.size());
  for (const GrainForm& form : forms) {
    worlds.push_back(std::make_unique<GrainWorld>(scene, form.kind == FormKind::Box ? box_bed : smooth_bed, form));
    for (int step = 0; step < kWarmUpSteps; ++step) worlds.back()->step();
    worlds.back()->forget_costs();
  }
  for (int round = 0; round < kRounds; ++round) {
    for (const auto& world : worlds) {
      for (int step = 0; step < kStepsPerRound; ++step) world->step();
    }
  }
  std::vector<std::string> lines;
  lines.reserve(forms.size());
  for (std::size_t f = 0; f < forms.size(); ++f) {
    lines.push_back(
        joined({forms[f].name(), forms[f].accuracy(), std::to_string(scene.grains_at_start()), cost_cells(worlds[f]->costs())}));
  }
  return lines;
}

/// Half of the grains in a box of half the plan, to be repeated `columns` x `rows` times.
Scene half_of(Scene scene) {
  for (auto& entry : scene.kinds) entry.count /= 2;
  std::get<falling_particles::Box>(scene.container).width[1] /= 2;
  scene.walls = walls_in(scene.container);
  return scene;
}

struct Tiling {
  std::size_t columns, rows;
};

Snapshot tiled(const Snapshot& bed, const falling_particles::Box& box, const Tiling& tiling) {
  Snapshot all;
  for (std::size_t i = 0; i < tiling.columns; ++i) {
    for (std::size_t j = 0; j < tiling.rows; ++j) {
      for (falling_particles::Placement grain : bed.placements) {
        grain.position[0] += static_cast<double>(i) * box.width[0];
        grain.position[1] += static_cast<double>(j) * box.width[1];
        all.placements.push_back(grain);
      }
      all.velocities.insert(all.velocities.end(), bed.velocities.begin(), bed.velocities.end());
    }
  }
  return all;
}

std::vector<std::string> time_size(const Scene& tile, const Tiling& tiling) {
  const auto& box = std::get<falling_particles::Box>(tile.container);
  const Snapshot bed = tiled(settle(tile, {}), box, tiling);
  Scene scene = tile;
  scene.container =
      falling_particles::Box{{box.width[0] * static_cast<double>(tiling.columns), box.width[1] * static_cast<double>(tiling.rows)}};
  scene.walls = walls_in(scene.container);
  std::vector<std::string> lines;
  for (const SpaceKind space : kSpaceKinds) {
    if (space == SpaceKind::Simple && bed.placements.size() > 5000) continue;  // quadratic cost: minutes
    GrainWorld world(scene, bed, {.threads = 1}, space);
    for (int step = 0; step < kWarmUpSteps; ++step) world.step();
    world.forget_costs();
    for (int step = 0; step < kRounds; ++step) world.step();
    lines.push_back(joined({name_of(space), std::to_string(bed.placements.size()), cost_cells(world.costs())}));
  }
  return lines;
}

std::vector<std::string> measure_outcome(const Scene& scene, const GrainForm& form) {
  GrainWorld world(scene, start_of(scene), form);
  falling_particles::EnergyWatch energy(world.world(), scene);
  const int steps = static_cast<int>(std::lround(kSettlingTime / scene.time.step));
  for (int step = 0; step < steps; ++step) {
    world.step();
    energy.after_step();
  }
  // All forms are measured in the same way: as smooth grains at their final places.
  const falling_particles::World ruler(scene, world.snapshot().placements);
  const auto overlap = falling_particles::measure_overlap(ruler);
  Random random(scene.seed);
  const auto bed = falling_particles::measure_bed(ruler, std::get<falling_particles::Box>(scene.container), random);
  return {joined({form.name(), form.accuracy(), std::to_string(scene.grains_at_start()), cost_cells(world.costs()),
                  number(overlap.relative_to_pair), number(bed.volume_fraction), number(bed.standard_error),
                  number(energy.gained() / energy.lost()), number(falling_particles::kinetic_height(world.world(), scene)),
                  number(rocking_error(form))})};
}

}  // namespace

MeasuredTable scene_forms(const std::string& scene_path) {
  return {"scene_forms",
          std::string("form,accuracy,grains,") + kCostColumns,
          {{"all forms", [=] { return time_forms(falling_particles::load_scene(scene_path)); }}}};
}

MeasuredTable scene_growth(const std::string& scene_path) {
  MeasuredTable table{"scene_growth", std::string("space,grains,") + kCostColumns, {}};
  for (const Tiling tiling : {Tiling{1, 1}, {1, 2}, {2, 2}, {2, 4}, {4, 4}, {5, 8}}) {
    table.tasks.push_back({std::to_string(500 * tiling.columns * tiling.rows) + " grains",
                           [=] { return time_size(half_of(falling_particles::load_scene(scene_path)), tiling); }});
  }
  return table;
}

MeasuredTable scene_outcomes(const std::string& scene_path) {
  MeasuredTable table{"scene_outcomes",
                      std::string("form,accuracy,grains,") + kCostColumns +
                          ",overlap,volume_fraction,volume_fraction_error,energy_gained,kinetic_height_m,rocking_error",
                      {}};
  constexpr int kMostDigits = 12;
  std::vector<GrainForm> forms;
  forms.reserve(kMostDigits + 1 + 2 * kMeshSizes.size());
  for (int digits = 1; digits <= kMostDigits; ++digits) forms.push_back({FormKind::Smooth, std::pow(10.0, -digits), {}});
  forms.push_back({FormKind::Box});
  for (const GrainForm& form : polyhedra()) {
    if (form.mesh.vertices() < 1000) forms.push_back(form);  // larger meshes take hours
  }
  table.tasks.reserve(forms.size());
  for (const GrainForm& form : forms) {
    table.tasks.push_back(
        {form.name() + " " + form.accuracy(), [=] { return measure_outcome(falling_particles::load_scene(scene_path), form); }});
  }
  return table;
}

}  // namespace scene_cost
