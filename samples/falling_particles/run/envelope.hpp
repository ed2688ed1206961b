// The envelope of a run's state in a checkpoint.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/hash.hpp"
#include "model/scene.hpp"

namespace falling_particles {

/// The properties that a resumed run must have in common with the saved one.
struct Origin {
  struct File {
    std::string name;  ///< without its folder, which may differ
    Hash hash{};

    template <typename Archive>
    void serialize(Archive& archive) {
      archive(name, hash);
    }
  };
  std::string program;                 ///< its version
  std::uint32_t bytes_of_a_real = 0;   ///< of dReal: ODE's precision
  std::vector<File> files;             ///< the scene's file, then the files that it names
  std::vector<std::string> overrides;  ///< of the scene's values
  std::vector<std::string> pictures;   ///< formats that the run writes
  std::int32_t every = 0;              ///< steps between two checkpoints

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(program, bytes_of_a_real, files, overrides, pictures, every);
  }
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

}  // namespace falling_particles
