// Measures what accuracy costs in a simulation: a scene of grains as bodies of several geometry classes.

#include <ode/ode.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "common/measured_tables.hpp"
#include "common/ode_world.hpp"
#include "common/random.hpp"
#include "grain_world.hpp"
#include "model/container.hpp"
#include "observe/bed.hpp"
#include "observe/energy.hpp"

namespace {

using namespace scene_cost;
using common::FormKind;
using common::grain_maker;
using common::GrainForm;
using common::joined;
using common::MeasuredTable;
using common::MeshSize;
using common::number;
using common::OdeGeom;
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

constexpr double kGravity = 9.81;
constexpr double kA = 0.3, kB = 0.2, kC = 0.1;  // m; the half-axes
constexpr double kTilt = 0.3;                   // rad, about y
// The period from conservation of energy, g h(theta) + (I + h'^2) theta'^2 / 2 = g h(tilt), by quadrature, s: see
// tests/dynamics/rocking_test.cpp.
constexpr double kPeriod = 0.489837517;
constexpr double kStep = 1e-4;  // s; error of the period below 1e-4
constexpr int kPeriods = 3;
constexpr int kMaxContacts = 5;

constexpr common::GrainBody kEllipsoid{{kA, kB, kC}};
constexpr double kDensity = 1000;  // kg/m^3

class Rocking {
 public:
  explicit Rocking(const GrainForm& form) : geom_(grain_maker(form, kEllipsoid)()), floor_(dCreateBox(nullptr, 2, 2, 1)) {
    dGeomSetPosition(floor_.id(), 0, 0, -0.5);
    dWorldSetGravity(world_.id(), 0, 0, -kGravity);
    dWorldSetERP(world_.id(), 0.8);  // the constraint acts on velocities: without ERP the centre lags behind the rising support
    const OdeGeom exact = grain_maker({}, kEllipsoid)();
    dMass mass;
    snMassSet(&mass, kDensity, exact.id());
    dBodySetMass(body_, &mass);
    dGeomSetBody(geom_.id(), body_);
    dQuaternion orientation;
    dQFromAxisAndAngle(orientation, 0, 1, 0, kTilt);
    dBodySetQuaternion(body_, orientation);
    dBodySetPosition(body_, 0, 0, std::hypot(kA * std::sin(kTilt), kC * std::cos(kTilt)));  // touching
  }

  /// Steps the world. Returns the angle about y, rad.
  double step() {
    std::array<dContactGeom, kMaxContacts> found;
    dReal aabb[6];
    dGeomGetAABB(geom_.id(), aabb);  // a space does this before dCollide
    const int count = dCollide(geom_.id(), floor_.id(), kMaxContacts, found.data(), sizeof(dContactGeom));
    for (int k = 0; k < count; ++k) {
      dContact contact{};
      contact.geom = found[static_cast<std::size_t>(k)];
      if (!(std::abs(dCalcVectorLength3(contact.geom.normal) - 1) < 1e-6)) continue;  // libccd makes such contacts
      world_.join(contact);
    }
    world_.step(kStep);
    const dReal* const q = dBodyGetQuaternion(body_);
    return 2 * std::atan2(q[2], q[0]);
  }

 private:
  common::OdeWorld world_{nullptr};
  dBodyID body_ = dBodyCreate(world_.id());
  OdeGeom geom_, floor_;
};

/// |period / exact - 1| of an ellipsoid that rocks on a dBox without friction. NaN if it does not rock.
double rocking_error(const GrainForm& form) {
  Rocking rocking(form);
  int passages = 0;
  double first = 0;
  double before = kTilt;
  for (int step = 1; step * kStep < 2 * (kPeriods + 1) * kPeriod; ++step) {
    const double theta = rocking.step();
    if (theta * before < 0) {
      const double time = kStep * (step - theta / (theta - before));
      if (passages == 0) first = time;
      if (passages == 2 * kPeriods) return std::abs((time - first) / kPeriods / kPeriod - 1);
      ++passages;
    }
    before = theta;
  }
  return std::numeric_limits<double>::quiet_NaN();
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

/// Measures the time per step of a settled bed of 1000 grains, with our class and the classes of ODE, in one run.
MeasuredTable scene_forms(const std::string& scene_path) {
  return {"scene_forms",
          std::string("form,accuracy,grains,") + kCostColumns,
          {{"all forms", [=] { return time_forms(falling_particles::load_scene(scene_path)); }}}};
}

/// Measures the time per step of 500 to 20 000 grains in every space of ODE.
MeasuredTable scene_growth(const std::string& scene_path) {
  MeasuredTable table{"scene_growth", std::string("space,grains,") + kCostColumns, {}};
  for (const Tiling tiling : {Tiling{1, 1}, {1, 2}, {2, 2}, {2, 4}, {4, 4}, {5, 8}}) {
    table.tasks.push_back({std::to_string(500 * tiling.columns * tiling.rows) + " grains",
                           [=] { return time_size(half_of(falling_particles::load_scene(scene_path)), tiling); }});
  }
  return table;
}

/// Drops 1000 grains with every tolerance and number of vertices. Measures the cost and the differences of the final beds.
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

/// That of the build, and the libraries whose colliders a scene has.
common::Environment environment() {
  common::Environment lines = common::environment();
  lines.emplace_back("ODE", dODE_VERSION);
  lines.emplace_back("libccd (by its ccd.pc)", SCENE_COST_CCD_VERSION);
  return lines;
}

int run_program(int argc, char** argv) {
  CLI::App app("Times a scene of grains as bodies of our class and of ODE's, and compares what comes out.", "scene_cost");
  std::string scene_path = "samples/scenes/pile.toml";
  std::string out = "out/accuracy_cost";
  app.add_option("--scene-file", scene_path, "the grains, in a box")->capture_default_str();
  app.add_option("--out", out, "folder for the results, also those of accuracy_cost; what is there is not measured again")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  common::measure_tables({scene_forms(scene_path), scene_growth(scene_path), scene_outcomes(scene_path)}, environment(), out);
  const std::string report = SCENE_COST_REPORT;
  if (std::filesystem::exists(report)) common::become_python(report, out);  // writes report.md and draws the figures
  std::printf("python3 samples/benchmarks/accuracy_cost/report.py %s writes the report; %s is missing\n", out.c_str(),
              report.c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "scene_cost: %s\n", error.what());
    return 1;
  }
}
