#include "measuring.hpp"

#include <algorithm>
#include <utility>

namespace falling_particles {

Measuring::Measuring(const Scene& scene, const World& world, const OutputFolder& folder)
    : Measuring(scene, world, folder, MeasuringState{std::vector<MeasuringState::OfTable>(scene.measurements.size()), {}}) {}

Measuring::Measuring(const Scene& scene, const World& world, const OutputFolder& folder, const MeasuringState& saved)
    : world_(&world), folder_(folder.file(kMeasurementFolder)), step_(scene.time.step), gathering_(saved.gathering) {
  if (scene.measurements.empty()) return;
  create_folder(folder_);
  entries_.reserve(scene.measurements.size());
  for (std::size_t i = 0; i < scene.measurements.size(); ++i) {
    const MeasurementRequest& request = scene.measurements[i];
    const MeasuringState::OfTable& table = saved.tables[i];
    Entry entry;
    entry.request = &request;
    entry.measurement = request.make(world);
    entry.file = std::make_unique<OutputFile>(folder_ / (request.name + ".csv"), table.file);
    entry.state = table.state;
    entry.watch = table.watch;
    if (table.file.bytes == 0) entry.file->write(entry.measurement->columns() + '\n');
    entries_.push_back(std::move(entry));
  }
}

void Measuring::go_on_in(const World& world) {
  world_ = &world;
  for (Entry& entry : entries_) entry.measurement = entry.request->make(world);
}

MeasuringState Measuring::save() {
  MeasuringState saved{{}, gathering_};
  saved.tables.reserve(entries_.size());
  for (Entry& entry : entries_) {
    entry.file->sync();
    saved.tables.push_back({entry.file->state(), entry.state, entry.watch});
  }
  if (!entries_.empty()) sync_folder(folder_);
  return saved;
}

bool Measuring::wants_forces(int step) const {
  return std::ranges::any_of(entries_,
                             [step](const Entry& entry) { return entry.request->needs_contacts && entry.request->is_due(step); });
}

void Measuring::after_step(int step, double time, const std::deque<MeasuredContact>& contacts) {
  std::vector<PairContact> pairs;
  if (step > 0 && wants_forces(step)) {
    const Stopwatch::Lap lap(gathering_);
    pairs = gather_contacts(contacts, *world_, step_);
  }
  for (Entry& entry : entries_) {
    const bool is_start_without_contacts = step == 0 && entry.request->needs_contacts;
    if (!entry.request->is_due(step) || is_start_without_contacts) continue;
    const Stopwatch::Lap lap(entry.watch);
    TableText table;
    entry.measurement->measure({time, *world_, pairs}, table);
    entry.file->write(table.text());
    ++entry.state.samples;
    entry.state.lines += table.lines();
  }
}

void Measuring::close_tables() {
  for (Entry& entry : entries_) entry.file->close();
}

std::vector<MeasurementCost> Measuring::costs() const {
  std::vector<MeasurementCost> costs;
  costs.reserve(entries_.size());
  for (const Entry& entry : entries_) {
    costs.push_back({entry.request->name, entry.request->kind, entry.state, entry.watch.seconds()});
  }
  return costs;
}

}  // namespace falling_particles
