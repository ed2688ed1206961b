#include "stepwise_run.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <variant>

#include "base/archive.hpp"
#include "base/interrupt.hpp"
#include "base/write_file.hpp"
#include "common/interval.hpp"
#include "world/grain.hpp"

namespace falling_particles {
namespace {

double time_after(int step, const Time& time) {
  return std::round(step * time.step * 1e9) / 1e9;  // 0.7 and not 0.7000000000000001
}

/// Measures the heap on the dish below a hopper, if there is one.
std::optional<Heap> find_heap(const World& world, const Container& container) {
  const Hopper* hopper = std::get_if<Hopper>(&container);
  if (hopper == nullptr || !hopper->dish) return std::nullopt;
  return measure_heap(world, {0, 0, hopper->dish->height}, hopper->dish->diameter / 2);
}

/// The state of a run in its checkpoint.
struct SavedRun {
  std::int32_t step = 0;
  Stopwatch time;
  CheckpointCost cost;
  std::string simulation;
  MeasuringState measuring;
  RecorderState recorder;

  void serialize(auto& archive) { archive(step, time, cost.number, cost.watch, simulation, measuring, recorder); }
};

bool is_zero(const Point& vector) { return vector == Point{}; }

/// `most`: the largest allowed absolute value, in `unit`.
void require_within(const char* name, std::size_t grain, const Point& values, double most, const char* unit) {
  for (std::size_t axis = 0; axis < values.size(); ++axis) {
    if (std::abs(values[axis]) <= most) continue;  // false for NaN
    throw std::invalid_argument(std::string(name) + '[' + std::to_string(grain) + ", " + std::to_string(axis) + "] is " +
                                shortest(values[axis]) + "; allowed: from " + shortest(-most) + " to " + shortest(most) + ' ' +
                                unit + ", which change a velocity of the grain by " + shortest(kFastest) + " in a step");
  }
}

/// kg m^2, of the grain about its axes.
double smallest_inertia(const Grain& grain) { return std::min({grain.mass.I[0], grain.mass.I[5], grain.mass.I[10]}); }

void require_slow(const Grain& grain, std::size_t index) {
  const double speed = to_vector(dBodyGetLinearVel(grain.body)).norm();
  const double spin = to_vector(dBodyGetAngularVel(grain.body)).norm();
  if (speed <= kFastest && spin <= kFastest) return;
  throw std::runtime_error("grain " + std::to_string(index) + " has the speed " + shortest(speed) + " m/s and the spin " +
                           shortest(spin) + " rad/s by its forces; allowed: up to " + shortest(kFastest));
}

}  // namespace

StepwiseRun::StepwiseRun(const Scene& scene, int threads, std::optional<Files> files)
    : scene_(scene), threads_(threads), files_(files) {
  if (files_ && files_->checkpoints.last()) {
    go_on(*files_->checkpoints.last());
    return;
  }
  simulation_.emplace(scene, threads);
  if (!files_) return;
  measuring_.emplace(scene, *simulation_, files_->folder);
  recorder_.emplace(files_->folder, scene, *simulation_, files_->checkpoints.are_on());
  measuring_->after_step(0, 0, true);
  record();
}

double StepwiseRun::time() const { return time_after(step_, scene_.time); }

void StepwiseRun::go_on(const std::string& checkpoint) {
  const auto saved = Reader(checkpoint).read<SavedRun>();
  simulation_.emplace(scene_, threads_, saved.simulation);
  measuring_.emplace(scene_, *simulation_, files_->folder, saved.measuring);
  recorder_.emplace(files_->folder, scene_, *simulation_, saved.recorder);
  step_ = recorded_step_ = saved.step;
  time_ = saved.time;
  cost_ = saved.cost;
}

void StepwiseRun::make_simulation_again(const std::string& state) {
  simulation_.reset();
  simulation_.emplace(scene_, threads_, state);
  if (measuring_) measuring_->go_on_in(*simulation_);
}

// The run continues from its saved state, as it would after it was killed. So both lose ODE's internal order and the warm-start
// normals alike.
void StepwiseRun::save() {
  const Stopwatch::Lap lap(cost_.watch);
  ++cost_.number;
  const std::string state = simulation_->save();
  files_->checkpoints.write(to_bytes(SavedRun{step_, time_, cost_, state, measuring_->save(), recorder_->save()}));
  make_simulation_again(state);
}

void StepwiseRun::change(const std::vector<supernormal::effects::Effect>& effects, const std::function<void()>& change) {
  const double before = measure_energy(simulation_->world, scene_).total();
  const std::string state = simulation_->save_for(effects);
  change();
  make_simulation_again(state);
  for (const Grain& grain : simulation_->world.present()) dBodyEnable(grain.body);
  simulation_->watches.energy.exchange(measure_energy(simulation_->world, scene_).total() - before);
}

void StepwiseRun::set_pushes(std::vector<Push> pushes) {
  const std::vector<Grain>& grains = simulation_->world.grains();
  for (std::size_t i = 0; i < std::min(pushes.size(), grains.size()); ++i) {
    if (!grains[i].is_present()) continue;
    require_within("forces", i, pushes[i].force, kFastest * grains[i].mass.mass / scene_.time.step, "N");
    require_within("torques", i, pushes[i].torque, kFastest * smallest_inertia(grains[i]) / scene_.time.step, "N m");
  }
  pushes_ = std::move(pushes);
  for (std::size_t i = 0; i < std::min(pushes_.size(), grains.size()); ++i) {
    const bool acts = !is_zero(pushes_[i].force) || !is_zero(pushes_[i].torque);
    if (acts && grains[i].is_present()) dBodyEnable(grains[i].body);
  }
}

void StepwiseRun::push() const {
  const std::vector<Grain>& grains = simulation_->world.grains();
  for (std::size_t i = 0; i < std::min(pushes_.size(), grains.size()); ++i) {
    // ODE would keep the forces on a sleeping body until it wakes.
    if (!grains[i].is_present() || dBodyIsEnabled(grains[i].body) == 0) continue;
    require_slow(grains[i], i);
    const auto& [force, torque] = pushes_[i];
    dBodyAddForce(grains[i].body, force[0], force[1], force[2]);
    dBodyAddTorque(grains[i].body, torque[0], torque[1], torque[2]);
  }
}

void StepwiseRun::record() {
  recorded_step_ = step_;
  if (!files_) return;
  measuring_->after_watches(step_, time(), true);
  recorder_->record(time(), *simulation_, results_need_forces_, measuring_->fields());
}

void StepwiseRun::advance_to(int until, Progress* progress) {
  const Stopwatch::Lap lap(time_);
  Stepper& stepper = simulation_->stepper;
  Watches& watches = simulation_->watches;
  while (step_ < until && !interrupted()) {
    ++step_;
    const double now = time();
    const bool is_frame = is_at_end() || step_ % scene_.time.steps_per_frame() == 0;
    watches.energy.exchange(simulation_->population.before_step(now));
    push();
    results_need_forces_ = files_ && ((is_frame && recorder_->wants_forces()) || measuring_->wants_forces(step_, is_frame));
    stepper.step(results_need_forces_ || measures_forces_);
    if (files_) measuring_->after_step(step_, now, is_frame);
    watches.after_step(now, stepper);
    if (is_frame) {
      record();
    } else if (files_) {
      measuring_->after_watches(step_, now, false);
    }
    if (progress != nullptr) progress->update(step_, now, stepper.contacts());
  }
}

void StepwiseRun::advance(int until, Progress* progress) {
  while (step_ < until && !interrupted()) {
    if (!files_ || !files_->checkpoints.are_on()) {
      advance_to(until, progress);
      continue;
    }
    const int every = files_->checkpoints.every();
    advance_to(std::min(until, step_ + every - step_ % every), progress);
    if (step_ % every != 0 || is_at_end()) continue;
    save();
    if (stop_requested()) return;
  }
}

Summary StepwiseRun::summarize() {
  World& world = simulation_->world;
  const snStatistics statistics = simulation_->statistics();  // before the measurements at the end, which add to them
  if (world.cell() != nullptr) world.cell()->place_images();  // the grains have moved since the images were placed
  const Box* box = std::get_if<Box>(&scene_.container);
  return {scene_,
          *simulation_,
          !is_at_end(),
          step_,
          time_.seconds(),
          statistics,
          measure_overlap(world),
          count_outside(world),
          box == nullptr ? std::nullopt : std::optional(measure_bed(world, *box, simulation_->random)),
          find_heap(world, scene_.container),
          measure_sizes(world, scene_),
          measuring_->costs(),
          measuring_->seconds_of_contacts(),
          cost_};
}

void StepwiseRun::finish() {
  if (recorded_step_ < step_) record();
  measuring_->finish(time());
  const Summary summary = summarize();
  summary_ = to_toml(summary, Times::Told);
  write_file(files_->folder.file(std::string(kSummaryFile)), summary_);
  recorder_->finish_pictures(to_toml(summary, Times::LeftOut));
  files_->folder.commit();
}

}  // namespace falling_particles
