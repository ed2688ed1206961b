// The measurements of a run.
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

/// The folder of the tables, within the folder of the run.
inline constexpr const char* kMeasurementFolder = "measurements";

/// The state of a measurement besides the bytes of its table. A resumed run restores it.
struct MeasurementState {
  unsigned long long samples = 0;
  unsigned long long lines = 0;  ///< of the table, without its head

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(samples, lines);
  }
};

/// The state of all measurements of a run.
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
  Stopwatch gathering;          ///< time to gather contacts

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(tables, gathering);
  }
};

/// The cost of a measurement.
struct MeasurementCost {
  std::string name;
  std::string kind;
  MeasurementState state;
  double seconds;  ///< wall-clock time of its samples
};

/// Takes the samples of a scene's measurements and writes their tables.
class Measuring {
 public:
  /// Creates the folder and the tables, if there are any. `world` must not have made a step, and must outlive this object.
  Measuring(const Scene& scene, const World& world, const OutputFolder& folder);
  /// Resumes with existing tables.
  Measuring(const Scene& scene, const World& world, const OutputFolder& folder, const MeasuringState& saved);

  /// Whether a sample after this step needs the forces of its contacts.
  bool wants_forces(int step) const;
  /// `contacts`: of the step, if wants_forces(step).
  void after_step(int step, double time, const std::deque<MeasuredContact>& contacts);
  void close_tables();

  /// Continues with another world of the same scene.
  void go_on_in(const World& world);
  /// The state so far. The tables up to it survive a power cut.
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
