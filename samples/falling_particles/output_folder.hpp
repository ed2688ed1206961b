#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace falling_particles {

/// The folder of a run's results, all or nothing: files are written into a hidden sibling folder that takes the final name in
/// commit(); without commit() it vanishes, and results of an earlier run stay as they were.
class OutputFolder {
 public:
  /// Throws InputError when `parent`/`name` exists and holds anything but an earlier run's files, or cannot be created.
  OutputFolder(const std::filesystem::path& parent, const std::string& name);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  std::filesystem::path file(const std::string& name) const { return staging_ / name; }
  void commit();
  const std::filesystem::path& path() const { return target_; }

 private:
  std::filesystem::path target_;
  std::filesystem::path staging_;
  std::size_t created_parents_;  // how many folders above this object had to create
};

}  // namespace falling_particles
