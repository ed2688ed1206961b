#include "forecast.hpp"

#include <algorithm>
#include <ctime>

#include "model/scene.hpp"
#include "observe/measurement.hpp"
#include "observe/simulation.hpp"

namespace falling_particles {
namespace {

// Bytes per grain and frame, from 150 frames of 1000 grains (samples/benchmarks/README.md, pictures).
constexpr double kTrajectory = 160;
constexpr double kFinalState = 300;  // bytes per grain, of final_state.csv

double bytes_of_picture(const std::string& format, double grain_frames) {
  constexpr double kMega = 1e6;
  if (format == "page")
    return 0.7 * kMega + 25 * grain_frames + std::min(2.5 * kMega, 60 * grain_frames);  // the page itself; grains; contacts
  if (format == "glb") return 0.1 * kMega + 33 * grain_frames;                          // meshes; grains
  if (format == "lammps") return 307 * grain_frames;
  if (format == "vtk") return 793 * grain_frames;
  return 0;  // a still and plots are small
}

constexpr double kLineOfFrame = 300;    // bytes, of energies.csv and state.csv together
constexpr double kLineOfContact = 260;  // bytes, of contact_forces
constexpr int kContactsPerGrain = 3;    // in a bed, each counted once: 2.3 to 3 in the beds of samples/scenes

std::uint64_t samples_of(const MeasurementRequest& request) {
  const auto up_to = [&](int step) { return step < 0 ? 0 : step / request.every + 1; };
  const int first = std::max(request.first, request.needs_contacts ? 1 : 0);
  return static_cast<std::uint64_t>(std::max(0, up_to(request.last) - up_to(first - 1)));
}

/// The bytes of a table: samples as long as one of the start, with the lines of the expected contacts, and one event of each grain.
double bytes_of_table(const MeasurementRequest& request, const Simulation& simulation, int grains) {
  TableText table;
  const auto measurement = request.make(simulation.world);
  measurement->measure({0, simulation.world, {}, &simulation}, table);
  const double contacts = request.kind == "contact_forces" ? kContactsPerGrain * grains : 0;
  const double of_sample = static_cast<double>(table.text().size()) + kLineOfContact * contacts;
  return static_cast<double>(samples_of(request)) * of_sample + grains * measurement->bytes_of_event();
}

double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }  // s

/// Takes the first steps.
void time_steps(Simulation& simulation, Forecast& result) {
  constexpr int kSteps = 20;
  constexpr double kLongest = 0.5;  // s
  const double start = processor_time();
  do {
    simulation.advance(++result.timed_steps * simulation.world.scene().time.step);
  } while (result.timed_steps < std::min(kSteps, result.steps) && processor_time() - start < kLongest);
  result.step = (processor_time() - start) / result.timed_steps;
}

}  // namespace

Forecast forecast(const Scene& scene) {
  Forecast result;
  const double most = scene.grains_at_start() + most_fed(scene);
  result.most_grains = static_cast<int>(most);
  result.steps = scene.time.steps();
  result.frames = 1 + (result.steps + scene.time.steps_per_frame() - 1) / scene.time.steps_per_frame();
  result.memory = memory_needed(result.most_grains);
  const double grain_frames = most * result.frames;
  result.table_bytes = kTrajectory * grain_frames + kFinalState * most + kLineOfFrame * result.frames;
  for (const std::string& format : scene.pictures) result.picture_bytes += bytes_of_picture(format, grain_frames);
  Simulation simulation(scene, 1);
  for (const MeasurementRequest& request : scene.measurements) {
    result.samples.push_back(samples_of(request));
    result.table_bytes += bytes_of_table(request, simulation, result.most_grains);
  }
  result.bonds.resize(scene.bonds.size());
  if (!scene.bonds.empty()) {
    for (const Bond& bond : simulation.world.bonds()->all()) ++result.bonds[bond.rule];
  }
  time_steps(simulation, result);
  return result;
}

}  // namespace falling_particles
