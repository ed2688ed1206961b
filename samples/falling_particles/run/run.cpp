#include "run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <variant>

#include "base/archive.hpp"
#include "base/input_error.hpp"
#include "base/interrupt.hpp"
#include "base/output_folder.hpp"
#include "base/stopwatch.hpp"
#include "base/write_file.hpp"
#include "checkpoints.hpp"
#include "observe/measuring.hpp"
#include "observe/simulation.hpp"
#include "output/recorder.hpp"
#include "output/summary.hpp"
#include "progress.hpp"

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

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(step, time, cost.number, cost.watch, simulation, measuring, recorder);
  }
};

class Run {
 public:
  Run(const Scene& scene, OutputFolder& folder, Checkpoints& checkpoints, const RunOptions& options)
      : scene_(scene), folder_(folder), checkpoints_(checkpoints), options_(options) {
    if (checkpoints.last()) {
      go_on(Reader(*checkpoints.last()).read<SavedRun>());
      return;
    }
    simulation_.emplace(scene, options.threads);
    measuring_.emplace(scene, *simulation_, folder);
    recorder_.emplace(folder, scene, *simulation_, checkpoints.are_on());
    measuring_->after_step(0, 0, true);
    measuring_->after_watches(0, 0, true);
    recorder_->record(0, *simulation_);
  }

  /// Returns false if the run was stopped at a checkpoint. Otherwise the results are complete, or end at an interrupt.
  bool advance();
  RunEnd finish();
  int step() const { return step_; }

 private:
  void go_on(const SavedRun& saved);
  void save();
  /// Advances to step `until`, or until the user interrupts, with a frame at every interval and at the end.
  void advance_to(int until, Progress* progress);
  Summary summarize();

  const Scene& scene_;
  OutputFolder& folder_;
  Checkpoints& checkpoints_;
  const RunOptions& options_;
  std::optional<Simulation> simulation_;
  std::optional<Measuring> measuring_;
  std::optional<Recorder> recorder_;
  int step_ = 0;
  Stopwatch time_;  // of the steps and their output
  CheckpointCost cost_;
};

void Run::go_on(const SavedRun& saved) {
  simulation_.emplace(scene_, options_.threads, saved.simulation);
  measuring_.emplace(scene_, *simulation_, folder_, saved.measuring);
  recorder_.emplace(folder_, scene_, *simulation_, saved.recorder);
  step_ = saved.step;
  time_ = saved.time;
  cost_ = saved.cost;
}

// The run continues from its saved state, as it would after it was killed. So both lose ODE's internal order and the warm-start
// normals alike.
void Run::save() {
  const Stopwatch::Lap lap(cost_.watch);
  ++cost_.number;
  const std::string state = simulation_->save();
  Writer writer;
  writer(SavedRun{step_, time_, cost_, state, measuring_->save(), recorder_->save()});
  checkpoints_.write(writer.bytes());
  simulation_.reset();
  simulation_.emplace(scene_, options_.threads, state);
  measuring_->go_on_in(*simulation_);
}

void Run::advance_to(int until, Progress* progress) {
  const Stopwatch::Lap lap(time_);
  const int steps = scene_.time.steps();
  Stepper& stepper = simulation_->stepper;
  Watches& watches = simulation_->watches;
  while (step_ < until && !interrupted()) {
    ++step_;
    const double now = time_after(step_, scene_.time);
    const bool is_frame = step_ == steps || step_ % scene_.time.steps_per_frame() == 0;
    watches.energy.exchange(simulation_->population.before_step(now));
    stepper.step((is_frame && recorder_->wants_forces()) || measuring_->wants_forces(step_, is_frame));
    measuring_->after_step(step_, now, is_frame);
    watches.after_step(now, stepper);
    const bool is_last = step_ == steps || interrupted();
    measuring_->after_watches(step_, now, is_last || is_frame);
    if (is_last || is_frame) recorder_->record(now, *simulation_);
    if (progress != nullptr) progress->update(step_, now, stepper.contacts());
    if (is_last) break;
  }
}

bool Run::advance() {
  const int steps = scene_.time.steps();
  std::optional<Progress> progress;
  if (!options_.quiet) progress.emplace(stderr, steps, step_);
  while (step_ < steps && !interrupted()) {
    const int every = checkpoints_.are_on() ? checkpoints_.every() : steps;
    advance_to(std::min(steps, step_ + every - step_ % every), progress ? &*progress : nullptr);
    if (!checkpoints_.are_on() || step_ == steps) continue;
    save();
    if (stop_requested()) return false;
  }
  measuring_->finish(time_after(step_, scene_.time));
  return true;
}

Summary Run::summarize() {
  World& world = simulation_->world;
  const Stepper& stepper = simulation_->stepper;
  const Watches& watches = simulation_->watches;
  const snStatistics statistics = simulation_->statistics();  // before the measurements at the end, which add to them
  if (world.cell() != nullptr) world.cell()->place_images();  // the grains have moved since the images were placed
  const Box* box = std::get_if<Box>(&scene_.container);
  return {scene_,
          step_ < scene_.time.steps(),
          step_,
          step_ * scene_.time.step,
          time_.seconds(),
          stepper.costs(),
          statistics,
          world.sweep().axis(),
          stepper.contacts(),
          stepper.deepest_contact(),
          kinetic_height(world, scene_),
          largest_kinetic_energy(world),
          watches.energy,
          measure_overlap(world),
          count_outside(world, scene_),
          watches.leaks.count(),
          box == nullptr ? std::nullopt : std::optional(measure_bed(world, *box, simulation_->random)),
          watches.discharge ? &*watches.discharge : nullptr,
          watches.compressor ? std::optional(watches.compressor->packing()) : std::nullopt,
          find_heap(world, scene_.container),
          simulation_->effect_costs(),
          measuring_->costs(),
          measuring_->seconds_of_contacts(),
          measure_sizes(world, scene_),
          scene_.changes_population() ? &simulation_->population : nullptr,
          cost_};
}

RunEnd Run::finish() {
  const Summary summary = summarize();
  const std::string text = to_toml(summary, Times::Told);
  write_file(folder_.file(std::string(kSummaryFile)), text);
  recorder_->finish_pictures(to_toml(summary, Times::LeftOut));
  folder_.commit();
  std::fputs(text.c_str(), stdout);
  const int steps = scene_.time.steps();
  if (summary.interrupted) std::fprintf(stderr, "Interrupted after step %d of %d: what there is was written.\n", step_, steps);
  const LeakWatch& leaks = simulation_->watches.leaks;
  if (leaks.first()) {
    std::fprintf(stderr, "Leak: %zu of %zu grains; the first: %s\n", leaks.count(), simulation_->world.grains().size(),
                 describe(*leaks.first()).c_str());
  }
  if (!options_.quiet) std::fprintf(stderr, "Results: %s\n", folder_.path().c_str());
  return {summary.interrupted, leaks.count() > 0, folder_.path(), recorder_->renderings()};
}

constexpr const char* kStopNote =
    "falling_particles: the run ends at its next checkpoint; a second signal ends it at once, and --resume then goes on from the "
    "last one\n";

RunEnd run_in(OutputFolder& folder, Checkpoints& checkpoints, const Scene& scene, const RunOptions& options) {
  if (checkpoints.are_on()) catch_stop_requests(kStopNote);
  Run run(scene, folder, checkpoints, options);
  // This message appears also with --quiet.
  if (options.resume && !folder.is_resumed()) {
    std::fprintf(stderr, "No checkpoint: starts at step %d of %d\n", run.step(), scene.time.steps());
  } else if (options.resume && !options.quiet) {
    std::fprintf(stderr, "Goes on after step %d of %d\n", run.step(), scene.time.steps());
  }
  if (run.advance()) return run.finish();
  std::fprintf(stderr, "Stopped after step %d of %d: --resume goes on from there.\n", run.step(), scene.time.steps());
  return {true, false, folder.path(), {}};
}

}  // namespace

RunEnd run(const Scene& scene, const RunOptions& options) {
  OutputFolder folder(options.out, scene.name, result_names(), options.resume);
  Checkpoints checkpoints(folder, scene, options.checkpoint_every);
  try {
    return run_in(folder, checkpoints, scene, options);
  } catch (const InputError&) {
    throw;  // the files of the last checkpoint are damaged: the run cannot be resumed
  } catch (const std::exception&) {
    const std::filesystem::path unfinished = folder.file("");  // empty if the run was complete and could not be moved to its place
    if (checkpoints.last() && !unfinished.empty()) {
      std::fprintf(stderr, "The last checkpoint is in \"%s\": --resume goes on from there.\n", unfinished.c_str());
    }
    throw;
  }
}

}  // namespace falling_particles
