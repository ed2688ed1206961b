// The folder of a run's results.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace falling_particles {

/// A folder within the one of a run's results: it holds files of one type, and an SVG beside a table of the same name.
struct InnerFolder {
  std::string name;
  std::string extension;  ///< of the files, with its dot
};

/// What runs may leave in the folder of their results.
struct ResultNames {
  std::vector<std::string> files;
  std::vector<InnerFolder> folders;
};

/// The folder of a run's results, all or nothing: files are written into a folder beside it, NAME.unfinished-1 (or -2, if another
/// run of the scene is on its way, and so on), that takes the final name in commit(); without commit() it vanishes, and results
/// of an earlier run stay as they were. A run that is killed leaves its unfinished folder behind for inspection; the next one
/// with the same name removes it, unless that one is to go on from its checkpoint (run/checkpoints.hpp). A folder that
/// holds anything that no run writes is never removed: names that are neither among the results nor among the files of a
/// checkpoint.
class OutputFolder {
 public:
  /// Throws InputError when `parent`/`name` exists and holds anything but an earlier run's files, or cannot be created or replaced;
  /// std::runtime_error when the disk is full. If `resumes`, what a run with checkpoints has left is taken over, if there is
  /// anything, with whatever else is in its folder, and stays whatever happens; InputError when that run has not ended, or when
  /// nothing can tell.
  OutputFolder(const std::filesystem::path& parent, const std::string& name, const ResultNames& results, bool resumes = false);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  std::filesystem::path file(const std::string& name) const { return staging_ / name; }
  bool is_resumed() const { return is_resumed_; }  ///< whether it holds what an earlier run has left
  /// From now on the unfinished folder stays if there is no commit().
  void keep() { is_kept_ = true; }
  /// Throws std::runtime_error when the results cannot go to their place; they stay where they are then, and it says so.
  void commit();
  const std::filesystem::path& path() const { return target_; }

 private:
  void create_staging();
  void take_over();
  void discard();

  ResultNames results_;
  std::filesystem::path target_;
  std::size_t created_parents_;  // how many folders above this object had to create
  std::filesystem::path staging_;
  bool is_resumed_ = false;
  bool is_kept_ = false;
  int mark_ = -1;  // file descriptor: a lock that ends with the process, however it ends
};

}  // namespace falling_particles
