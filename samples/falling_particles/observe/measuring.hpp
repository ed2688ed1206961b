// The measurements of a run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/output_folder.hpp"
#include "base/write_file.hpp"
#include "common/stopwatch.hpp"
#include "measurement.hpp"
#include "model/scene.hpp"

namespace falling_particles {

/// The folder of the requested tables, within the folder of the run. Tables that are on by default are beside it.
inline constexpr const char* kMeasurementFolder = "measurements";

/// The state of a measurement besides the bytes of its table and its memory. A resumed run restores it.
struct MeasurementState {
  unsigned long long samples = 0;
  unsigned long long lines = 0;  ///< of the table, without its head

  void serialize(auto& archive) { archive(samples, lines); }
};

/// The state of all measurements of a run.
struct MeasuringState {
  struct OfTable {
    FileState file;
    MeasurementState state;
    Stopwatch watch;
    std::string memory = {};  ///< Measurement::save()

    void serialize(auto& archive) { archive(file, state, watch, memory); }
  };
  std::vector<OfTable> tables;  ///< of the kinds that are on by default, then in the order of the scene; empty at the start
  Stopwatch gathering;          ///< time to gather contacts

  void serialize(auto& archive) { archive(tables, gathering); }
};

/// The cost of a measurement.
struct MeasurementCost {
  std::string name;
  MeasurementState state;
  double seconds;  ///< wall-clock time of its samples
};

/// Takes the samples of a run's measurements and writes their tables.
class Measuring {
 public:
  /// Creates the tables, or continues with existing ones. The simulation must not have made a step since it was made, and must
  /// outlive this object.
  Measuring(const Scene& scene, const Simulation& simulation, const OutputFolder& folder, const MeasuringState& saved = {});

  /// Whether a sample after this step needs the forces of its contacts.
  bool wants_forces(int step, bool is_frame) const;
  /// Samples the kinds that a scene requests, before a compression scales the cell.
  void after_step(int step, double time, bool is_frame);
  /// Samples the kinds that are on by default, with what the watches have seen.
  void after_watches(int step, double time, bool is_frame);
  /// Samples the kinds that have one sample at the end, or events since their last one, and closes all tables.
  void finish(double time);

  /// Continues with another simulation of the same scene.
  void go_on_in(const Simulation& simulation);
  /// The state so far. The tables up to it survive a power cut.
  MeasuringState save();

  /// The fields of all measurements on the walls of the scene, each with the name of its measurement in front.
  std::vector<TriangleField> fields() const;

  std::vector<MeasurementCost> costs() const;                          ///< of the requested measurements
  double seconds_of_contacts() const { return gathering_.seconds(); }  ///< s, to gather contacts for all measurements

 private:
  struct Entry {
    const MeasurementKind* kind = nullptr;
    const MeasurementRequest* request = nullptr;  // null for a kind that is on by default
    std::unique_ptr<Measurement> measurement = {};
    std::unique_ptr<OutputFile> file = {};
    MeasurementState state = {};
    Stopwatch watch = {};

    bool is_of_end() const { return request == nullptr && kind->on_by_default->is_of_end; }
    bool is_due(int step, bool is_frame) const { return request == nullptr ? is_frame && !is_of_end() : request->is_due(step); }
    bool follows(int step) const { return kind->follows && request->follows(step); }
    const MeasurementMaker& maker() const { return request == nullptr ? kind->on_by_default->make : request->make; }
    std::string path() const;  // within the folder of the run
  };
  void follow(Entry& entry, int step, double time);
  void sample(Entry& entry, double time, const std::vector<PairContact>& contacts);

  const Simulation* simulation_;
  std::filesystem::path folder_;  // of the requested tables
  double step_;
  std::vector<Entry> entries_;
  Stopwatch gathering_;
};

/// The tables that a run of the scene writes, as TOML: "energies.csv" = ["time_s", …]. Nothing is run.
std::string tables_of(const Scene& scene);

}  // namespace falling_particles
