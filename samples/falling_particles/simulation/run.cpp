#include "run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <deque>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "compression.hpp"
#include "interrupt.hpp"
#include "measure/discharge.hpp"
#include "measure/energy.hpp"
#include "measure/leaks.hpp"
#include "measurements/measuring.hpp"
#include "output/output_files.hpp"
#include "output/output_folder.hpp"
#include "output/picture.hpp"
#include "output/summary.hpp"
#include "output/write_file.hpp"
#include "placement.hpp"
#include "population/population.hpp"
#include "progress.hpp"
#include "random.hpp"
#include "stepper.hpp"
#include "world.hpp"

namespace falling_particles {
namespace {

/// The watches that run after every step.
struct Watches {
  Watches(World& world, const Scene& scene, Random& random) : leaks(world, scene), energy(world, scene) {
    if (const Hopper* hopper = std::get_if<Hopper>(&scene.container)) discharge.emplace(world, *hopper, random);
    if (scene.compression) compressor.emplace(world, *world.cell(), *scene.compression, scene.time.duration);
  }
  void after_step(double time, const Stepper& stepper) {
    leaks.after_step(time);
    energy.after_step();
    if (discharge) discharge->after_step(time);
    if (compressor) compressor->after_step(time, stepper.contact_geoms());
  }

  LeakWatch leaks;
  EnergyWatch energy;
  std::optional<Discharge> discharge;    // for a hopper
  std::optional<Compressor> compressor;  // for a periodic cell
};

/// `stepper`: null before the first step.
State state_of(const World& world, const Scene& scene, const Watches& watches, const Stepper* stepper) {
  State state{};
  if (stepper != nullptr) {
    for (const dContactGeom& contact : stepper->contact_geoms()) {
      state.deepest_contact = std::max<double>(state.deepest_contact, contact.depth);
    }
    state.deepest_contact_of_all_steps = stepper->deepest_contact();
  }
  if (scene.gravity() != nullptr) state.kinetic_height = kinetic_height(world, scene);
  state.largest_kinetic_energy = largest_kinetic_energy(world);
  state.energy_lost = watches.energy.lost();
  state.energy_gained = watches.energy.gained();
  state.leaked = watches.leaks.count();
  return state;
}

/// Writes the frames of a run as it goes.
class Recorder {
 public:
  Recorder(const OutputFolder& folder, const World& world, const Scene& scene, const Watches& watches, const Population& population)
      : world_(world),
        scene_(scene),
        watches_(watches),
        population_(population),
        contents_(scene.pictures.empty() ? Contents{&scene, {}} : contents_of(world, scene)),
        trajectory_(folder.file(std::string(kTrajectoryFile))),
        energies_(folder.file(std::string(kEnergiesFile))),
        states_(folder.file(std::string(kStateFile))) {
    if (watches.discharge) discharge_file_.emplace(folder.file(std::string(kDischargeFile)));
    if (watches.compressor) compression_file_.emplace(folder.file(std::string(kCompressionFile)));
    if (scene.has_sizes()) grains_file_.emplace(folder.file(std::string(kGrainsFile)));
    if (std::ranges::any_of(scene.parts, &Part::moves)) parts_file_.emplace(folder.file(std::string(kPartsFile)));
    if (!scene.feeders.empty()) feeders_file_.emplace(folder.file(std::string(kFeedersFile)));
    if (!scene.sinks.empty()) sinks_file_.emplace(folder.file(std::string(kSinksFile)));
    for (const std::string& name : scene.pictures) {
      const PictureFormat& format = *find_picture_format(name);
      pictures_.push_back(format.make(folder, format, contents_));
    }
  }

  /// `stepper`: null before the first step.
  void record(double time, const Stepper* stepper) {
    trajectory_.write(time, world_);
    const Energy energy = measure_energy(world_, scene_);
    energies_.write(time, energy, stepper == nullptr ? 0 : stepper->contacts());
    states_.write(time, state_of(world_, scene_, watches_, stepper));
    if (discharge_file_) discharge_file_->write(time, watches_.discharge->mass(), watches_.discharge->count());
    if (compression_file_ && stepper != nullptr) compression_file_->write(time, watches_.compressor->packing());
    if (grains_file_) grains_file_->write(world_);
    if (parts_file_) parts_file_->write(time, *world_.parts());
    if (feeders_file_) feeders_file_->write(time, population_);
    if (sinks_file_) sinks_file_->write(time, population_, scene_);
    if (pictures_.empty()) return;
    add_new_bodies(contents_, world_);
    const Frame frame = frame_of(time, energy, contents_, world_, stepper);
    for (const std::unique_ptr<Picture>& picture : pictures_) picture->add(frame);
  }

  /// Whether the contacts of a frame are to tell their forces.
  bool wants_forces() const { return scene_.forces && !pictures_.empty(); }

  void close_tables() {
    trajectory_.close();
    energies_.close();
    states_.close();
    if (discharge_file_) discharge_file_->close();
    if (compression_file_) compression_file_->close();
    if (grains_file_) grains_file_->close();
    if (parts_file_) parts_file_->close();
    if (feeders_file_) feeders_file_->close();
    if (sinks_file_) sinks_file_->close();
  }

  void finish_pictures(const std::string& summary) {
    for (const std::unique_ptr<Picture>& picture : pictures_) picture->finish(summary);
  }

  std::vector<Rendering> renderings() const {
    std::vector<Rendering> all;
    for (const std::unique_ptr<Picture>& picture : pictures_) {
      for (Rendering& rendering : picture->renderings()) all.push_back(std::move(rendering));
    }
    return all;
  }

 private:
  const World& world_;
  const Scene& scene_;
  const Watches& watches_;
  const Population& population_;
  Contents contents_;
  Trajectory trajectory_;
  Energies energies_;
  StateFile states_;
  std::optional<DischargeFile> discharge_file_;
  std::optional<CompressionFile> compression_file_;
  std::optional<GrainsFile> grains_file_;  // where sizes differ
  std::optional<PartsFile> parts_file_;    // where any part moves
  std::optional<FeedersFile> feeders_file_;
  std::optional<SinksFile> sinks_file_;
  std::vector<std::unique_ptr<Picture>> pictures_;
};

double time_after(int step, const Time& time) {
  return std::round(step * time.step * 1e9) / 1e9;  // 0.7 and not 0.7000000000000001
}

/// Stands for Measuring in a scene that names no measurement, whose steps are then not an instruction longer.
struct NoMeasuring {
  static constexpr bool wants_forces(int /*step*/) { return false; }
  static constexpr void after_step(int /*step*/, double /*time*/, const std::deque<MeasuredContact>& /*contacts*/) {}
};

/// Stands for Population in a scene whose grains neither come nor go.
struct NoPopulation {};

/// Steps until the end or until the user interrupts, with a frame at the start, at every interval and at the end. Returns the
/// number of steps done.
template <typename Measurements, typename Changes>
int advance(Stepper& stepper, Watches& watches, Recorder& recorder, Measurements&& measuring, Changes&& population,
            const Time& time, bool quiet) {
  const int steps = time.steps();
  std::optional<Progress> progress;
  if (!quiet) progress.emplace(stderr, steps);
  recorder.record(0, nullptr);
  measuring.after_step(0, 0, stepper.measured_contacts());
  int step = 0;
  while (step < steps && !interrupted()) {
    ++step;
    const bool is_frame = step == steps || step % time.steps_per_frame() == 0;
    if constexpr (!std::is_same_v<std::remove_cvref_t<Changes>, NoPopulation>) {
      watches.energy.exchange(population.before_step(time_after(step, time)));
    }
    stepper.step((is_frame && recorder.wants_forces()) || measuring.wants_forces(step));
    const double now = time_after(step, time);
    measuring.after_step(step, now, stepper.measured_contacts());  // before a compression scales the cell
    watches.after_step(now, stepper);
    const bool last = step == steps || interrupted();
    if (last || is_frame) recorder.record(now, &stepper);
    if (progress) progress->update(step, now, stepper.contacts());
    if (last) break;
  }
  recorder.close_tables();
  return step;
}

/// Measures the heap on the dish below a hopper, if there is one.
std::optional<Heap> find_heap(const World& world, const Container& container) {
  const Hopper* hopper = std::get_if<Hopper>(&container);
  if (hopper == nullptr || !hopper->dish) return std::nullopt;
  return measure_heap(world, {0, 0, hopper->dish->height}, hopper->dish->diameter / 2);
}

}  // namespace

RunEnd run(const Scene& scene, const std::filesystem::path& out, bool quiet, int threads) {
  OutputFolder folder(out, scene.name);
  Random random(scene.seed);
  World world(scene, place(scene, random));
  Stepper stepper(world, scene, threads);
  Watches watches(world, scene, random);
  Population population(world, scene);
  Recorder recorder(folder, world, scene, watches, population);
  Measuring measuring(scene, world, folder);
  snResetStatistics();
  const auto start = std::chrono::steady_clock::now();
  const auto advance_with = [&](auto&& measurements, auto&& changes) {
    return advance(stepper, watches, recorder, measurements, changes, scene.time, quiet);
  };
  const auto advance_measuring = [&](auto&& changes) {
    return scene.measurements.empty() ? advance_with(NoMeasuring{}, changes) : advance_with(measuring, changes);
  };
  const int steps = scene.changes_population() ? advance_measuring(population) : advance_measuring(NoPopulation{});
  measuring.close_tables();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  snStatistics statistics;  // taken before the measurements at the end add to them
  snGetStatistics(&statistics);

  if (world.cell() != nullptr) world.cell()->place_images();  // the grains have moved since the last images were placed
  const bool early = steps < scene.time.steps();
  const Box* box = std::get_if<Box>(&scene.container);
  const Summary summary{scene,
                        early,
                        steps,
                        steps * scene.time.step,
                        seconds,
                        stepper.costs(),
                        statistics,
                        world.sweep().axis(),
                        stepper.contacts(),
                        stepper.deepest_contact(),
                        kinetic_height(world, scene),
                        largest_kinetic_energy(world),
                        watches.energy,
                        measure_overlap(world),
                        count_outside(world, scene),
                        watches.leaks.count(),
                        box == nullptr ? std::nullopt : std::optional(measure_bed(world, *box, random)),
                        watches.discharge ? &*watches.discharge : nullptr,
                        watches.compressor ? std::optional(watches.compressor->packing()) : std::nullopt,
                        find_heap(world, scene.container),
                        world.effects().costs(),
                        measuring.costs(),
                        measuring.seconds_of_contacts(),
                        measure_sizes(world, scene),
                        scene.changes_population() ? &population : nullptr};
  const std::string text = to_toml(summary);
  write_file(folder.file(std::string(kSummaryFile)), text);
  recorder.finish_pictures(text);
  folder.commit();
  std::fputs(text.c_str(), stdout);
  if (early) std::fprintf(stderr, "Interrupted after step %d of %d: what there is was written.\n", steps, scene.time.steps());
  if (watches.leaks.first()) {
    std::fprintf(stderr, "Leak: %zu of %zu grains; the first: %s\n", watches.leaks.count(), world.bodies().size(),
                 describe(*watches.leaks.first()).c_str());
  }
  if (!quiet) std::fprintf(stderr, "Results: %s\n", folder.path().c_str());
  return {early, watches.leaks.count() > 0, folder.path(), recorder.renderings()};
}

}  // namespace falling_particles
