// The checkpoints of a run.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/output_folder.hpp"
#include "envelope.hpp"

namespace falling_particles {

/// Writes the checkpoints of a run into its unfinished folder. Each one replaces the last one: it is written into another file,
/// which is renamed when its bytes are on the disk. So a complete checkpoint exists at any time, even if the run, the machine or
/// the disk fails.
class Checkpoints {
 public:
  /// `every`: steps between two checkpoints; 0: as in the resumed run, or none. The arguments must outlive this object. Throws
  /// InputError when the folder has a checkpoint of another run (envelope.hpp), or when `every` is too small for bodies of the
  /// scene to fall asleep.
  Checkpoints(OutputFolder& folder, const Scene& scene, int every);

  bool are_on() const { return origin_.every > 0; }
  int every() const { return origin_.every; }  ///< steps; 0 if there are no checkpoints
  /// The last saved state, of this run or of the resumed run.
  const std::optional<std::string>& last() const { return last_; }

  /// Throws std::runtime_error when the checkpoint cannot be written. The last one then stays.
  void write(std::string state);

 private:
  std::filesystem::path file() const;

  OutputFolder& folder_;
  Origin origin_;
  std::optional<std::string> last_;
};

}  // namespace falling_particles
