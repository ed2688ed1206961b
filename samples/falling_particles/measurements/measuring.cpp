#include "measurements/measuring.hpp"

#include <algorithm>

namespace falling_particles {

Measuring::Measuring(const Scene& scene, const World& world, const OutputFolder& folder) : world_(world), step_(scene.time.step) {
  if (scene.measurements.empty()) return;
  const std::filesystem::path tables = folder.file(kMeasurementFolder);
  create_folder(tables);
  for (const MeasurementRequest& request : scene.measurements) {
    Entry& entry =
        entries_.emplace_back(Entry{&request, request.make(world), std::make_unique<OutputFile>(tables / (request.name + ".csv"))});
    entry.file->write(entry.measurement->columns() + '\n');
  }
}

bool Measuring::wants_forces(int step) const {
  return std::ranges::any_of(entries_,
                             [step](const Entry& entry) { return entry.request->needs_contacts && entry.request->is_due(step); });
}

void Measuring::after_step(int step, double time, const std::deque<MeasuredContact>& contacts) {
  std::vector<PairContact> pairs;
  if (step > 0 && wants_forces(step)) {
    const Stopwatch::Lap lap(gathering_);
    pairs = gather_contacts(contacts, world_, step_);
  }
  for (Entry& entry : entries_) {
    const bool is_start_without_contacts = step == 0 && entry.request->needs_contacts;
    if (!entry.request->is_due(step) || is_start_without_contacts) continue;
    const Stopwatch::Lap lap(entry.watch);
    TableText table;
    entry.measurement->measure({time, world_, pairs}, table);
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
