// The checkpoints of a run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/output_folder.hpp"
#include "base/write_file.hpp"
#include "model/scene.hpp"

namespace falling_particles {

/// The properties that a resumed run must have in common with the saved one.
struct Origin {
  struct File {
    std::string name;  ///< without its folder, which may differ
    Hash hash{};

    void serialize(auto& archive) { archive(name, hash); }
  };
  std::string program;                 ///< its version
  std::uint32_t bytes_of_a_real = 0;   ///< of dReal: ODE's precision
  std::vector<File> files;             ///< the scene's file, then the files that it names
  std::vector<std::string> overrides;  ///< of the scene's values
  std::vector<std::string> pictures;   ///< formats that the run writes
  std::int32_t every = 0;              ///< steps between two checkpoints

  void serialize(auto& archive) { archive(program, bytes_of_a_real, files, overrides, pictures, every); }
};

/// The origin of this program with the scene. Throws std::runtime_error when a file of the scene cannot be read.
Origin origin_of(const Scene& scene, int every);

/// The content of a checkpoint.
struct Checkpoint {
  Origin origin;
  std::string state;
};

/// The bytes of a checkpoint's file: a magic number, the version of the format, origin and state, and a checksum of all these
/// bytes.
std::string seal(const Checkpoint& checkpoint);

/// Reads the bytes of a checkpoint's file. Throws InputError, which names `path`, when they are no checkpoint, of another format,
/// or incomplete.
Checkpoint unseal(const std::string& bytes, const std::filesystem::path& path);

/// Throws InputError, which names `path` and the first difference, when a checkpoint belongs to another run. `here.every` = 0
/// agrees with any value.
void refuse_other(const Origin& saved, const Origin& here, const std::filesystem::path& path);

/// Writes the checkpoints of a run into its unfinished folder. Each one replaces the last one: it is written into another file,
/// which is renamed when its bytes are on the disk. So a complete checkpoint exists at any time, even if the run, the machine or
/// the disk fails.
class Checkpoints {
 public:
  /// `every`: steps between two checkpoints; 0: as in the resumed run, or none. The arguments must outlive this object. Throws
  /// InputError when the folder has a checkpoint of another run (refuse_other), or when `every` is too small for bodies of the
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
