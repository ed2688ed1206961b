// The checkpoints of a run.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/output_folder.hpp"
#include "envelope.hpp"

namespace falling_particles {

/// Writes the checkpoints of a run into its unfinished folder, each in the place of the last one: into a file beside it that takes
/// its name when its bytes are on the disk. So there is a whole one at any time, whenever the run, the machine or the disk ends.
class Checkpoints {
 public:
  /// `every`: steps from one to the next; 0: as the run that is gone on with, or none. The arguments must outlive this object.
  /// Throws InputError when the folder has one that is not of this run (envelope.hpp), or when `every` is too small for bodies of
  /// the scene to fall asleep.
  Checkpoints(OutputFolder& folder, const Scene& scene, int every);

  bool are_on() const { return origin_.every > 0; }
  int every() const { return origin_.every; }  ///< steps; 0 where they are off
  /// The state that was saved last, by this run or the one that it goes on with.
  const std::optional<std::string>& last() const { return last_; }

  /// Throws std::runtime_error when it cannot be written; the last one is there as before then.
  void write(std::string state);

 private:
  std::filesystem::path file() const;

  OutputFolder& folder_;
  Origin origin_;
  std::optional<std::string> last_;
};

}  // namespace falling_particles
