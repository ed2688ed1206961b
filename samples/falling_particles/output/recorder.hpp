// The recording of a run's frames in its pictures.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/output_folder.hpp"
#include "frame_log.hpp"
#include "observe/simulation.hpp"
#include "picture.hpp"

namespace falling_particles {

/// The state of a recorder, for a resumed run.
struct RecorderState {
  FileState log;   ///< of the frame log
  double top = 0;  ///< m, top_of() at the start

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(log, top);
  }
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
  std::optional<FrameLog> log_;
};

}  // namespace falling_particles
