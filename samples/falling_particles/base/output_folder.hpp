// The folder of a run's results.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace falling_particles {

/// A folder within the folder of the results. It holds files of one type, and an SVG beside each table of the same name.
struct InnerFolder {
  std::string name;
  std::string extension;  ///< of the files, with its dot
};

/// The names that runs may leave in the folder of their results.
struct ResultNames {
  std::vector<std::string> files;
  std::vector<InnerFolder> folders;
};

/// The folder of a run's results, all or nothing. Files are written into a folder beside it, NAME.unfinished-1. If another run of
/// the scene is under way, it is NAME.unfinished-2, and so on. commit() renames this folder to the final name. Without commit() the
/// folder is removed, and the results of an earlier run stay. A run that is killed leaves its unfinished folder for inspection. The
/// next run of that name removes it, unless it resumes from its checkpoint (run/checkpoints.hpp). A folder is never removed if it
/// holds a name that no run writes: neither a result nor a file of a checkpoint.
class OutputFolder {
 public:
  /// Throws InputError when `parent`/`name` holds anything but an earlier run's files, or cannot be created or replaced. Throws
  /// std::runtime_error when the disk is full. If `resumes`, takes over the folder of a killed run with checkpoints, with
  /// everything in it. This folder then stays in any case. Throws InputError when the killed run has not ended, or when this cannot
  /// be found out.
  OutputFolder(const std::filesystem::path& parent, const std::string& name, const ResultNames& results, bool resumes = false);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  std::filesystem::path file(const std::string& name) const { return staging_ / name; }
  bool is_resumed() const { return is_resumed_; }  ///< whether the folder of an earlier run was taken over
  /// Keeps the unfinished folder from now on, also without commit().
  void keep() { is_kept_ = true; }
  /// Throws std::runtime_error when the results cannot be moved to their place. They stay where they are, and the message says
  /// where.
  void commit();
  const std::filesystem::path& path() const { return target_; }

 private:
  void create_staging();
  void take_over();
  void discard();

  ResultNames results_;
  std::filesystem::path target_;
  std::size_t created_parents_;  // the number of parent folders that this object has created
  std::filesystem::path staging_;
  bool is_resumed_ = false;
  bool is_kept_ = false;
  int mark_ = -1;  // file descriptor of the lock, which ends with the process
};

}  // namespace falling_particles
