// What surrounds the state of a run in its checkpoint.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/hash.hpp"
#include "model/scene.hpp"

namespace falling_particles {

/// What must be the same where a run goes on.
struct Origin {
  struct File {
    std::string name;  ///< without its folder, which may be another one
    Hash hash{};

    template <typename Archive>
    void serialize(Archive& archive) {
      archive(name, hash);
    }
  };
  std::string program;                 ///< its version
  std::uint32_t bytes_of_a_real = 0;   ///< of dReal: ODE's precision
  std::vector<File> files;             ///< the scene's, then those that it names
  std::vector<std::string> overrides;  ///< of the scene's values
  std::vector<std::string> pictures;   ///< formats that the run leaves
  std::int32_t every = 0;              ///< steps from checkpoint to checkpoint

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(program, bytes_of_a_real, files, overrides, pictures, every);
  }
};

/// Of this program with the scene. Throws std::runtime_error when a file of the scene cannot be read.
Origin origin_of(const Scene& scene, int every);

/// A checkpoint without its envelope.
struct Checkpoint {
  Origin origin;
  std::string state;
};

/// The bytes of a checkpoint's file: a magic number, the version of the format, origin and state, and a checksum of all that.
std::string seal(const Checkpoint& checkpoint);

/// Takes the bytes apart. Throws InputError, which names `path`, when they are not a checkpoint, or of another format, or not
/// whole.
Checkpoint unseal(const std::string& bytes, const std::filesystem::path& path);

/// Throws InputError, which names `path` and the first difference, when a checkpoint is not of this run. `here.every` may be 0,
/// which goes with any.
void refuse_other(const Origin& saved, const Origin& here, const std::filesystem::path& path);

}  // namespace falling_particles
