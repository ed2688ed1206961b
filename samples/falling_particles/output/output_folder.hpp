// The folder of a run's results.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace falling_particles {

/// The folder of a run's results, all or nothing: files are written into a folder beside it, NAME.unfinished-1 (or -2, if another
/// run of the scene is on its way, and so on), that takes the final name in commit(); without commit() it vanishes, and results
/// of an earlier run stay as they were. A run that is killed leaves its unfinished folder behind for inspection; the next one
/// with the same name removes it.
class OutputFolder {
 public:
  /// Throws InputError when `parent`/`name` exists and holds anything but an earlier run's files, or cannot be created or replaced;
  /// std::runtime_error when the disk is full.
  OutputFolder(const std::filesystem::path& parent, const std::string& name);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  std::filesystem::path file(const std::string& name) const { return staging_ / name; }
  /// Throws std::runtime_error when the results cannot go to their place; they stay where they are then, and it says so.
  void commit();
  const std::filesystem::path& path() const { return target_; }

 private:
  void create_staging();
  void discard();

  std::filesystem::path target_;
  std::size_t created_parents_;  // how many folders above this object had to create
  std::filesystem::path staging_;
  int mark_ = -1;  // file descriptor: a lock that ends with the process, however it ends
};

}  // namespace falling_particles
