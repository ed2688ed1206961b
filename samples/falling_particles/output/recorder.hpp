// The recording of a run's frames.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/output_folder.hpp"
#include "frame_log.hpp"
#include "observe/simulation.hpp"
#include "output_files.hpp"
#include "picture.hpp"

namespace falling_particles {

/// The state of a recorder, for a resumed run.
struct RecorderState {
  std::map<std::string, FileState> files;  ///< the tables and the frame log, by name
  std::uint64_t grains_written = 0;        ///< into grains.csv
  double top = 0;                          ///< m, top_of() at the start

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(files, grains_written, top);
  }
};

/// Writes the frames of a run into its tables and pictures.
class Recorder {
 public:
  /// For a run that has not started. `logs_frames`: keeps the frames of pictures in a file, so that another recorder can resume.
  Recorder(const OutputFolder& folder, const Scene& scene, const Simulation& simulation, bool logs_frames);
  /// Resumes from the state of another recorder.
  Recorder(const OutputFolder& folder, const Scene& scene, const Simulation& simulation, const RecorderState& saved);

  void record(double time, const Simulation& simulation, bool has_stepped);

  /// Whether the contacts of a frame need their forces.
  bool wants_forces() const { return scene_.forces && !pictures_.empty(); }

  void close_tables();
  void finish_pictures(const std::string& summary);
  std::vector<Rendering> renderings() const;

  /// The state so far. The files up to it survive a power cut.
  RecorderState save();

 private:
  Recorder(const OutputFolder& folder, const Scene& scene, const Simulation& simulation, const RecorderState& saved,
           bool logs_frames);
  /// Adds the table, if the scene has it. `written`: the counts of its existing lines.
  template <typename File, typename... Counts>
  void add(std::optional<File>& file, std::string_view name, Counts... written);

  const OutputFolder& folder_;
  const Scene& scene_;
  RecorderState kept_;
  Contents contents_;
  std::optional<Trajectory> trajectory_;
  std::optional<Energies> energies_;
  std::optional<StateFile> states_;
  std::optional<DischargeFile> discharge_;
  std::optional<CompressionFile> compression_;
  std::optional<GrainsFile> grains_;  // of scenes with sizes
  std::optional<WallsFile> walls_;    // of scenes with moving walls
  std::optional<FeedersFile> feeders_;
  std::optional<SinksFile> sinks_;
  std::vector<std::pair<std::string, Table*>> tables_;  // all tables above
  std::vector<std::unique_ptr<Picture>> pictures_;
  std::optional<FrameLog> log_;
};

}  // namespace falling_particles
