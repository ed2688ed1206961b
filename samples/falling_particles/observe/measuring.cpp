#include "measuring.hpp"

#include <algorithm>
#include <utility>

#include "common/toml_string.hpp"
#include "simulation.hpp"

namespace falling_particles {
namespace {

std::string path_of(const MeasurementRequest& request) { return std::string(kMeasurementFolder) + '/' + request.name + ".csv"; }

/// Whether samples have to be taken before a compression scales the cell. The contacts are those of the step.
bool precedes_watches(const MeasurementKind& kind) { return kind.needs_contacts || !kind.on_by_default; }

/// `columns`: names without quotes, separated by commas.
std::string toml_line(const std::string& table, const std::string& columns) {
  std::string names;
  for (std::size_t at = 0; at < columns.size();) {
    const std::size_t end = std::min(columns.find(',', at), columns.size());
    names += (names.empty() ? "" : ", ") + toml_string(columns.substr(at, end - at));
    at = end + 1;
  }
  return toml_string(table) + " = [" + names + "]\n";
}

}  // namespace

std::string Measuring::Entry::path() const { return request == nullptr ? default_file(*kind) : path_of(*request); }

Measuring::Measuring(const Scene& scene, const Simulation& simulation, const OutputFolder& folder, const MeasuringState& saved)
    : simulation_(&simulation), folder_(folder.file(kMeasurementFolder)), step_(scene.time.step), gathering_(saved.gathering) {
  for (const MeasurementKind& kind : measurement_kinds()) {
    if (kind.is_on(scene)) entries_.push_back({&kind});
  }
  for (const MeasurementRequest& request : scene.measurements) {
    entries_.push_back({find_measurement_kind(request.kind), &request});
  }
  if (!scene.measurements.empty()) create_folder(folder_);
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    Entry& entry = entries_[i];
    const MeasuringState::OfTable table = saved.tables.empty() ? MeasuringState::OfTable() : saved.tables[i];
    entry.measurement = entry.maker()(simulation.world);
    entry.file = std::make_unique<OutputFile>(folder.file(entry.path()), table.file);
    if (table.file.bytes == 0) entry.file->write(entry.measurement->columns() + '\n');
    entry.state = table.state;
    entry.watch = table.watch;
    if (!saved.tables.empty()) entry.measurement->restore(table.memory);
  }
}

void Measuring::go_on_in(const Simulation& simulation) {
  simulation_ = &simulation;
  for (Entry& entry : entries_) {
    const std::string memory = entry.measurement->save();
    entry.measurement = entry.maker()(simulation.world);
    entry.measurement->restore(memory);
  }
}

MeasuringState Measuring::save() {
  MeasuringState saved{{}, gathering_};
  saved.tables.reserve(entries_.size());
  for (Entry& entry : entries_) {
    entry.file->sync();
    saved.tables.push_back({entry.file->state(), entry.state, entry.watch, entry.measurement->save()});
  }
  if (entries_.back().request != nullptr) sync_folder(folder_);
  return saved;
}

bool Measuring::wants_forces(int step, bool is_frame) const {
  return std::ranges::any_of(entries_, [=](const Entry& entry) {
    return entry.kind->needs_contacts && (entry.is_due(step, is_frame) || entry.follows(step));
  });
}

void Measuring::after_step(int step, double time, bool is_frame) {
  std::vector<PairContact> contacts;
  const auto needs_contacts = [=](const Entry& entry) { return entry.kind->needs_contacts && entry.is_due(step, is_frame); };
  if (step > 0 && std::ranges::any_of(entries_, needs_contacts)) {
    const Stopwatch::Lap lap(gathering_);
    contacts = gather_contacts(simulation_->stepper.measured_contacts(), simulation_->world, step_);
  }
  for (Entry& entry : entries_) {
    if (entry.kind->follows) follow(entry, step, time);
    const bool is_start_without_contacts = step == 0 && entry.kind->needs_contacts;
    if (!precedes_watches(*entry.kind) || is_start_without_contacts) continue;
    if (entry.is_due(step, is_frame)) sample(entry, time, contacts);
  }
}

void Measuring::after_watches(int step, double time, bool is_frame) {
  for (Entry& entry : entries_) {
    if (!precedes_watches(*entry.kind) && entry.is_due(step, is_frame)) sample(entry, time, {});
  }
}

void Measuring::follow(Entry& entry, int step, double time) {
  const Stopwatch::Lap lap(entry.watch);
  const Sample sample{time, simulation_->world, {}, simulation_, entry.state.lines};
  if (step == entry.request->first) entry.measurement->begin(sample);
  if (entry.follows(step)) entry.measurement->follow(sample);
}

void Measuring::sample(Entry& entry, double time, const std::vector<PairContact>& contacts) {
  const Stopwatch::Lap lap(entry.watch);
  TableText table;
  const Sample sample{time, simulation_->world, contacts, simulation_, entry.state.lines};
  entry.measurement->measure(sample, table);
  entry.measurement->forget(sample);
  entry.file->write(table.text());
  ++entry.state.samples;
  entry.state.lines += table.lines();
}

void Measuring::finish(double time) {
  for (Entry& entry : entries_) {
    if (entry.is_of_end() || entry.measurement->has_unwritten()) sample(entry, time, {});
    entry.file->close();
  }
}

std::vector<TriangleField> Measuring::fields() const {
  std::vector<TriangleField> all;
  for (const Entry& entry : entries_) {
    for (TriangleField& field : entry.measurement->fields()) {
      all.push_back({entry.request->name + '_' + field.name, std::move(field.of_walls)});
    }
  }
  return all;
}

std::vector<MeasurementCost> Measuring::costs() const {
  std::vector<MeasurementCost> costs;
  for (const Entry& entry : entries_) {
    if (entry.request != nullptr) costs.push_back({entry.request->name, entry.state, entry.watch.seconds()});
  }
  return costs;
}

std::string tables_of(const Scene& scene) {
  std::string text;
  for (const MeasurementKind& kind : measurement_kinds()) {
    if (kind.is_on(scene)) text += toml_line(default_file(kind), kind.columns);
  }
  if (scene.measurements.empty()) return text;
  const Simulation simulation(scene, 1);
  for (const MeasurementRequest& request : scene.measurements) {
    text += toml_line(path_of(request), request.make(simulation.world)->columns());
  }
  return text;
}

}  // namespace falling_particles
