// The recording of a run's frames in its pictures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/output_folder.hpp"
#include "base/write_file.hpp"
#include "frame.hpp"
#include "observe/simulation.hpp"
#include "picture.hpp"

namespace falling_particles {

/// Appends a frame with exact numbers to a log. Pictures keep what they have seen in memory; a resumed run shows them the logged
/// frames again.
void log_frame(const Frame& frame, OutputFile& log);

/// Visits the frames in the first `size` bytes of a log. Throws InputError when the bytes were changed.
void replay_frames(const std::filesystem::path& path, std::uint64_t size, const std::function<void(const Frame&)>& visit);

/// The state of a recorder, for a resumed run.
struct RecorderState {
  FileState log;   ///< of the frame log
  double top = 0;  ///< m, top_of() at the start

  void serialize(auto& archive) { archive(log, top); }
};

/// Adds the frames of a run to its pictures.
class Recorder {
 public:
  /// For a run that has not started. `logs_frames`: keeps the frames in a file, so that another recorder can resume.
  Recorder(const OutputFolder& folder, const Scene& scene, const Simulation& simulation, bool logs_frames);
  /// Resumes from the state of another recorder.
  Recorder(const OutputFolder& folder, const Scene& scene, const Simulation& simulation, const RecorderState& saved);

  /// `with_forces`: shows the forces that the last step has measured. `fields`: on the walls of the scene.
  void record(double time, const Simulation& simulation, bool with_forces, const std::vector<TriangleField>& fields);

  /// Whether the contacts of a frame need their forces.
  bool wants_forces() const { return contents_.scene->forces && !pictures_.empty(); }

  void finish_pictures(const std::string& summary);
  std::vector<Rendering> renderings() const;

  /// The state so far. The log up to it survives a power cut.
  RecorderState save();

 private:
  Recorder(const OutputFolder& folder, const Scene& scene, const Simulation& simulation, const RecorderState& saved,
           bool logs_frames);

  double top_;
  Contents contents_;
  std::vector<std::unique_ptr<Picture>> pictures_;
  std::optional<OutputFile> log_;
};

}  // namespace falling_particles
