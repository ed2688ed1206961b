// The measurements of a run as it goes.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/output_folder.hpp"
#include "base/stopwatch.hpp"
#include "base/write_file.hpp"
#include "measurement.hpp"
#include "model/request.hpp"

namespace falling_particles {

/// The folder of the tables within that of the run.
inline constexpr const char* kMeasurementFolder = "measurements";

/// All that a measurement accumulates, besides the bytes of its table: what a resumed run has to restore.
struct MeasurementState {
  unsigned long long samples = 0;
  unsigned long long lines = 0;  ///< of the table, its head not counted

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(samples, lines);
  }
};

/// All that the measurements of a run accumulate.
struct MeasuringState {
  struct OfTable {
    FileState file;
    MeasurementState state;
    Stopwatch watch;

    template <typename Archive>
    void serialize(Archive& archive) {
      archive(file, state, watch);
    }
  };
  std::vector<OfTable> tables;  ///< in the order of the scene
  Stopwatch gathering;          ///< time in which contacts were gathered

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(tables, gathering);
  }
};

/// What a measurement took.
struct MeasurementCost {
  std::string name;
  std::string kind;
  MeasurementState state;
  double seconds;  ///< wall-clock time of its samples
};

/// Writes the tables that a scene asks for.
class Measuring {
 public:
  /// Creates the folder and the tables, if there are any. `world` has not started, and outlives this object.
  Measuring(const Scene& scene, const World& world, const OutputFolder& folder);
  /// Goes on with tables that are there.
  Measuring(const Scene& scene, const World& world, const OutputFolder& folder, const MeasuringState& saved);

  /// Whether a sample after this step needs the forces of its contacts.
  bool wants_forces(int step) const;
  /// `contacts`: those of the step if wants_forces(step).
  void after_step(int step, double time, const std::deque<MeasuredContact>& contacts);
  void close_tables();

  /// Goes on in another world of the same scene.
  void go_on_in(const World& world);
  /// What there is so far, in tables that survive a power cut.
  MeasuringState save();

  std::vector<MeasurementCost> costs() const;
  double seconds_of_contacts() const { return gathering_.seconds(); }  ///< s, to gather contacts for all measurements

 private:
  struct Entry {
    const MeasurementRequest* request = nullptr;
    std::unique_ptr<Measurement> measurement;
    std::unique_ptr<OutputFile> file;
    MeasurementState state = {};
    Stopwatch watch = {};
  };

  const World* world_;
  std::filesystem::path folder_;  // of the tables
  double step_;
  std::vector<Entry> entries_;
  Stopwatch gathering_;
};

}  // namespace falling_particles
