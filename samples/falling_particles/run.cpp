#include "run.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "energy.hpp"
#include "interrupt.hpp"
#include "output_files.hpp"
#include "output_folder.hpp"
#include "placement.hpp"
#include "progress.hpp"
#include "random.hpp"
#include "stepper.hpp"
#include "summary.hpp"
#include "world.hpp"

namespace falling_particles {
namespace {

/// The frames of a run, written as it goes.
class Recorder {
 public:
  Recorder(const OutputFolder& folder, const World& world, const Scene& scene)
      : world_(world),
        scene_(scene),
        trajectory_(folder.file(std::string(kTrajectoryFile))),
        energies_(folder.file(std::string(kEnergiesFile))) {}

  void record(int step, std::size_t contacts) {
    const double time = std::round(step * scene_.time.step * 1e9) / 1e9;  // 0.7 and not 0.7000000000000001
    trajectory_.write(time, world_);
    energies_.write(time, measure_energy(world_, scene_), contacts);
  }

  void close() {
    trajectory_.close();
    energies_.close();
  }

 private:
  const World& world_;
  const Scene& scene_;
  Trajectory trajectory_;
  Energies energies_;
};

/// Steps until the end or until the user interrupts; a frame at the start, at every interval and at the end. Returns the steps
/// done.
int advance(Stepper& stepper, Recorder& recorder, const Time& time, bool quiet) {
  const int steps = time.steps();
  std::optional<Progress> progress;
  if (!quiet) progress.emplace(stderr, steps);
  recorder.record(0, 0);
  int step = 0;
  while (step < steps && !interrupted()) {
    stepper.step();
    ++step;
    const bool last = step == steps || interrupted();
    if (last || step % time.steps_per_frame() == 0) recorder.record(step, stepper.contacts());
    if (progress) progress->update(step, step * time.step, stepper.contacts());
    if (last) break;
  }
  recorder.close();
  if (progress) progress->finish();
  return step;
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream stream(path);
  stream << text;
  stream.close();
  if (!stream) throw std::runtime_error("cannot write \"" + path.string() + "\" (is the disk full?)");
}

}  // namespace

RunEnd run(const Scene& scene, const std::filesystem::path& out, bool quiet) {
  OutputFolder folder(out, scene.name);
  Random random(scene.seed);
  const World world(scene, place(scene, random));
  Stepper stepper(world, scene);
  Recorder recorder(folder, world, scene);
  snResetStatistics();
  const auto start = std::chrono::steady_clock::now();
  const int steps = advance(stepper, recorder, scene.time, quiet);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  snStatistics statistics;  // before the measurements at the end add to them
  snGetStatistics(&statistics);

  const bool early = steps < scene.time.steps();
  const Summary summary{scene,
                        early,
                        steps,
                        steps * scene.time.step,
                        seconds,
                        stepper.costs(),
                        statistics,
                        stepper.contacts(),
                        stepper.deepest_contact(),
                        kinetic_height(world, scene),
                        measure_overlap(world),
                        count_outside(world, scene.box),
                        measure_bed(world, scene.box, random)};
  const std::string text = to_toml(summary);
  write_file(folder.file(std::string(kSummaryFile)), text);
  folder.commit();
  std::fputs(text.c_str(), stdout);
  if (early) std::fprintf(stderr, "Interrupted after step %d of %d: what there is was written.\n", steps, scene.time.steps());
  if (!quiet) std::fprintf(stderr, "Results: %s\n", folder.path().c_str());
  return early ? RunEnd::Interrupted : RunEnd::Completed;
}

}  // namespace falling_particles
