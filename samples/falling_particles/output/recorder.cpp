#include "recorder.hpp"

#include <algorithm>

#include "base/files.hpp"

namespace falling_particles {
namespace {

State state_of(const Simulation& simulation, const Scene& scene, bool has_stepped) {
  State state{};
  if (has_stepped) {
    for (const dContactGeom& contact : simulation.stepper.contact_geoms()) {
      state.deepest_contact = std::max<double>(state.deepest_contact, contact.depth);
    }
    state.deepest_contact_of_all_steps = simulation.stepper.deepest_contact();
  }
  const Watches& watches = simulation.watches;
  if (scene.gravity() != nullptr) state.kinetic_height = kinetic_height(simulation.world, scene);
  state.largest_kinetic_energy = largest_kinetic_energy(simulation.world);
  state.energy_lost = watches.energy.lost();
  state.energy_gained = watches.energy.gained();
  state.leaked = watches.leaks.count();
  return state;
}

}  // namespace

Recorder::Recorder(const OutputFolder& folder, const Scene& scene, const Simulation& simulation, bool logs_frames)
    : Recorder(folder, scene, simulation, RecorderState{{}, 0, scene.pictures.empty() ? 0 : top_of(simulation.world, scene)},
               logs_frames) {}

Recorder::Recorder(const OutputFolder& folder, const Scene& scene, const Simulation& simulation, const RecorderState& saved)
    : Recorder(folder, scene, simulation, saved, true) {
  if (!log_) return;
  replay_frames(folder.file(std::string(kFrameLogFile)), log_->state().bytes, [this](const Frame& frame) {
    for (const std::unique_ptr<Picture>& picture : pictures_) picture->add(frame);
  });
}

Recorder::Recorder(const OutputFolder& folder, const Scene& scene, const Simulation& simulation, const RecorderState& saved,
                   bool logs_frames)
    : folder_(folder),
      scene_(scene),
      kept_(saved),
      contents_(scene.pictures.empty() ? Contents{&scene, {}} : contents_of(simulation.world, scene, saved.top)) {
  add(trajectory_, kTrajectoryFile);
  add(energies_, kEnergiesFile);
  add(states_, kStateFile);
  add(discharge_, kDischargeFile);
  add(compression_, kCompressionFile);
  add(grains_, kGrainsFile, kept_.grains_written);
  add(walls_, kPartsFile);
  add(feeders_, kFeedersFile);
  add(sinks_, kSinksFile);
  for (const std::string& name : scene.pictures) {
    const PictureFormat& format = *find_picture_format(name);
    pictures_.push_back(format.make(folder, format, contents_));
  }
  const std::string log(kFrameLogFile);
  if (logs_frames && !pictures_.empty()) log_.emplace(folder.file(log), kept_.files[log]);
}

template <typename File, typename... Counts>
void Recorder::add(std::optional<File>& file, std::string_view name, Counts... written) {
  if (!std::ranges::find(table_formats(), name, &TableFormat::name)->is_written(scene_)) return;
  file.emplace(folder_.file(std::string(name)), kept_.files[std::string(name)], written...);
  tables_.emplace_back(name, &*file);
}

void Recorder::record(double time, const Simulation& simulation, bool has_stepped) {
  const World& world = simulation.world;
  trajectory_->write(time, world);
  const Energy energy = measure_energy(world, scene_);
  energies_->write(time, energy, has_stepped ? simulation.stepper.contacts() : 0);
  states_->write(time, state_of(simulation, scene_, has_stepped));
  if (discharge_) discharge_->write(time, simulation.watches.discharge->mass(), simulation.watches.discharge->count());
  if (compression_ && has_stepped) compression_->write(time, simulation.watches.compressor->packing());
  if (grains_) grains_->write(world);
  if (walls_) walls_->write(time, world.walls());
  if (feeders_) feeders_->write(time, simulation.population);
  if (sinks_) sinks_->write(time, simulation.population, scene_);
  if (pictures_.empty()) return;
  add_new_grains(contents_, world);
  const Frame frame = frame_of(time, energy, contents_, world, has_stepped ? &simulation.stepper : nullptr);
  for (const std::unique_ptr<Picture>& picture : pictures_) picture->add(frame);
  if (log_) log_->add(frame);
}

void Recorder::close_tables() {
  for (const auto& [name, table] : tables_) table->close();
}

void Recorder::finish_pictures(const std::string& summary) {
  for (const std::unique_ptr<Picture>& picture : pictures_) picture->finish(summary);
}

std::vector<Rendering> Recorder::renderings() const {
  std::vector<Rendering> all;
  for (const std::unique_ptr<Picture>& picture : pictures_) {
    for (Rendering& rendering : picture->renderings()) all.push_back(std::move(rendering));
  }
  return all;
}

RecorderState Recorder::save() {
  for (const auto& [name, table] : tables_) {
    table->sync();
    kept_.files[name] = table->state();
  }
  if (log_) {
    log_->sync();
    kept_.files[std::string(kFrameLogFile)] = log_->state();
  }
  if (grains_) kept_.grains_written = grains_->written();
  return kept_;
}

}  // namespace falling_particles
