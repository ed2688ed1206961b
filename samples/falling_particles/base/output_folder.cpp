#include "output_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "common/input_error.hpp"
#include "write_file.hpp"

namespace falling_particles {

using namespace common;
namespace {

namespace fs = std::filesystem;

/// The file that marks a folder as unfinished. The run that writes there locks it.
constexpr std::string_view kMarkFile = "UNFINISHED";
constexpr std::string_view kMarkText =
    "The run that writes here has not ended. If it was killed, these are its results up to then; the next run of the scene with\n"
    "the same output folder removes them, or goes on from the checkpoint, if there is one, with --resume.\n";

const InnerFolder* find_inner_folder(const ResultNames& results, const fs::path& name) {
  const auto found = std::ranges::find(results.folders, name.string(), &InnerFolder::name);
  return found == results.folders.end() ? nullptr : &*found;
}

bool may_leave(const ResultNames& results, const fs::path& name) {
  return find_inner_folder(results, name) != nullptr || std::ranges::find(results.files, name.string()) != results.files.end() ||
         name == kMarkFile || std::ranges::find(kCheckpointFiles, name) != kCheckpointFiles.end();
}

bool may_leave(const InnerFolder& folder, const fs::directory_entry& entry) {
  const fs::path& path = entry.path();
  if (entry.is_directory()) return false;
  if (path.extension() == ".svg") return fs::exists(fs::path(path).replace_extension(".csv"));
  return path.extension() == folder.extension;
}

/// The first entry of a folder that no run has written: it is neither a result nor a file that a run keeps until it has ended.
std::optional<fs::path> find_foreign(const fs::path& folder, const ResultNames& results) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const fs::path name = entry.path().filename();
    if (!may_leave(results, name)) return name;
    if (!fs::is_directory(entry.symlink_status())) continue;
    const InnerFolder* inner_folder = find_inner_folder(results, name);
    if (inner_folder == nullptr) return name;
    for (const fs::directory_entry& inner : fs::directory_iterator(entry)) {
      if (!may_leave(*inner_folder, inner)) return name / inner.path().filename();
    }
  }
  return std::nullopt;
}

/// Does the same without throwing.
bool has_foreign(const fs::path& folder, const ResultNames& results) noexcept {
  try {
    return find_foreign(folder, results).has_value();
  } catch (const fs::filesystem_error&) {
    return true;  // a folder that cannot be read stays
  }
}

/// Refuses to delete anything of the user's. A folder is replaced only if a run has written everything in it and it is not
/// write-protected.
void refuse_foreign(const fs::path& target, const ResultNames& results) {
  if (!fs::exists(fs::symlink_status(target))) return;
  if (!fs::is_directory(fs::symlink_status(target))) {
    throw InputError("output \"" + target.string() + "\" exists and is not a folder; allowed: a new folder or an earlier run's");
  }
  if (const std::optional<fs::path> foreign = find_foreign(target, results)) {
    throw InputError("output folder \"" + target.string() + "\" holds " + foreign->string() +
                     ", which no run writes; allowed: a new folder or an earlier run's (see --out)");
  }
  if (access(target.c_str(), W_OK) != 0) {
    throw fs::filesystem_error("", target, std::error_code(errno, std::generic_category()));
  }
}

std::string unfinished_prefix(const fs::path& target) { return target.filename().string() + ".unfinished-"; }

int open_mark(const fs::path& folder, int flags) {
  constexpr mode_t kReadable = 0644;
  return open((folder / kMarkFile).c_str(), O_RDWR | O_CLOEXEC | flags, kReadable);
}

bool lock(int mark) { return flock(mark, LOCK_EX | LOCK_NB) == 0; }

/// Whether another run took the mark for a leftover before it was locked. That run holds the lock or has removed the file.
bool is_taken_away(int mark) {
  // If the file system has no locks, no run removes anything, and leftovers stay.
  if (!lock(mark)) return errno == EWOULDBLOCK;
  struct stat status {};
  return fstat(mark, &status) == 0 && status.st_nlink == 0;
}

bool has_mark(const fs::path& folder) { return fs::is_regular_file(fs::symlink_status(folder / kMarkFile)); }

bool has_checkpoint(const fs::path& folder) { return fs::exists(fs::symlink_status(folder / kCheckpointFile)); }

/// Removes the folder of an unfinished run. If this process is killed meanwhile, the next run removes the rest. Another run may do
/// so at the same time, so a missing file is no error.
void remove_unfinished(const fs::path& folder, std::error_code& error) {
  for (fs::directory_iterator entry(folder, error); !error && entry != fs::directory_iterator(); entry.increment(error)) {
    if (entry->path().filename() != kMarkFile) fs::remove_all(entry->path(), error);
    if (error) return;
  }
  if (!error) fs::remove_all(folder, error);
  if (error == std::errc::no_such_file_or_directory) error.clear();
}

/// The folders beside `target` with the names of unfinished runs: runs that were killed or are under way.
std::vector<fs::path> unfinished_runs(const fs::path& target) {
  std::vector<fs::path> folders;
  if (!fs::is_directory(target.parent_path())) return folders;
  const std::string prefix = unfinished_prefix(target);
  for (const fs::directory_entry& entry : fs::directory_iterator(target.parent_path())) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix) || name.size() == prefix.size() || !fs::is_directory(entry)) continue;
    if (name.find_first_not_of("0123456789", prefix.size()) == std::string::npos) folders.push_back(entry.path());
  }
  return folders;
}

/// Removes the mark and the checkpoint files of an unfinished run. From then on no other run may remove its results.
void mark_finished(const fs::path& folder) {
  std::error_code ignored;  // if the mark stays, the next run of the scene still replaces the results
  for (const std::string_view name : kCheckpointFiles) fs::remove(folder / name, ignored);
  fs::remove(folder / kMarkFile, ignored);
}

/// Removes a folder that a killed run has left, unless it holds anything of the user's.
void remove_leftover(const fs::path& folder, const ResultNames& results) {
  if (const std::optional<fs::path> foreign = find_foreign(folder, results)) {
    std::fprintf(stderr, "\"%s\" of an earlier run stays: it holds %s, which no run writes\n", folder.c_str(), foreign->c_str());
    return;
  }
  std::error_code ignored;
  remove_unfinished(folder, ignored);
}

/// Removes the folders that killed runs have left beside `target`. The mark is the first file to be created and the last to be
/// removed. A folder without it is somebody's copy, or empty.
void remove_leftovers(const fs::path& target, const ResultNames& results) {
  for (const fs::path& folder : unfinished_runs(target)) {
    if (fs::is_symlink(folder) || (!has_mark(folder) && !fs::is_empty(folder))) continue;
    std::error_code ignored;
    const int mark = open_mark(folder, 0);
    if (mark < 0) {
      fs::remove(folder, ignored);  // succeeds only for an empty folder
      continue;
    }
    if (lock(mark)) remove_leftover(folder, results);  // a locked mark belongs to a live run
    close(mark);
  }
}

/// Exchanges two folders in one operation, so that a folder of that name exists at any time. Returns false if there is no second
/// folder or the file system cannot exchange them.
bool exchange(const fs::path& one, const fs::path& other) {
  return renameat2(AT_FDCWD, one.c_str(), AT_FDCWD, other.c_str(), RENAME_EXCHANGE) == 0;
}

bool is_lack_of_space(const std::error_code& code) {
  return code.value() == ENOSPC || code.value() == EDQUOT || code.value() == EFBIG;
}

std::size_t count_missing(fs::path folder) {
  std::size_t missing = 0;
  for (; !folder.empty() && !fs::exists(folder); folder = folder.parent_path()) ++missing;
  return missing;
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& parent, const std::string& name, const ResultNames& results, bool resumes)
    : results_(results),
      target_((parent.empty() ? fs::path(".") : parent) / name),
      created_parents_(count_missing(target_.parent_path())) {
  try {
    refuse_foreign(target_, results_);
    if (resumes) take_over();
    remove_leftovers(target_, results_);
    if (staging_.empty()) create_staging();
  } catch (const fs::filesystem_error& error) {
    discard();
    const std::string complaint = "cannot create output folder \"" + target_.string() + "\": " + error.code().message();
    if (is_lack_of_space(error.code())) throw std::runtime_error(complaint);
    throw InputError(complaint);
  }
}

void OutputFolder::create_staging() {
  fs::create_directories(target_.parent_path());
  for (int number = 1;; ++number) {
    const fs::path folder = target_.parent_path() / (unfinished_prefix(target_) + std::to_string(number));
    if (!fs::create_directory(folder)) continue;
    staging_ = folder;
    mark_ = open_mark(staging_, O_CREAT);
    if (mark_ < 0 && errno == ENOENT) continue;  // another run removed the empty folder as a leftover
    if (mark_ < 0 || !write_all(mark_, kMarkText)) {
      throw fs::filesystem_error("", staging_, std::error_code(errno, std::generic_category()));
    }
    if (!is_taken_away(mark_)) return;
    close(mark_);
    staging_.clear();
  }
}

/// Takes over the folder with the latest checkpoint, whatever else it holds.
void OutputFolder::take_over() {
  std::vector<fs::path> folders = unfinished_runs(target_);
  std::erase_if(folders, std::not_fn(has_checkpoint));
  if (folders.empty()) return;
  const auto written = [](const fs::path& folder) { return fs::last_write_time(folder / kCheckpointFile); };
  const fs::path folder = *std::ranges::max_element(folders, {}, written);
  if (fs::is_symlink(folder)) {
    throw InputError("output folder \"" + folder.string() + "\" has a checkpoint and is a link; allowed: the folder itself");
  }
  if (!has_mark(folder)) {
    throw InputError("output folder \"" + folder.string() + "\" has a checkpoint but no file " + std::string(kMarkFile) +
                     ", which a run that writes there locks; allowed: an empty file of that name, if no run does");
  }
  mark_ = open_mark(folder, 0);
  if (mark_ < 0) throw fs::filesystem_error("", folder, std::error_code(errno, std::generic_category()));
  if (!lock(mark_) && errno == EWOULDBLOCK) {
    close(std::exchange(mark_, -1));
    throw InputError("output folder \"" + folder.string() + "\" is that of a run on its way; allowed: --resume when it has ended");
  }
  staging_ = folder;
  is_resumed_ = is_kept_ = true;
}

OutputFolder::~OutputFolder() { discard(); }

void OutputFolder::discard() {
  std::error_code error;
  if (!staging_.empty() && !is_kept_ && !has_foreign(staging_, results_)) {
    remove_unfinished(staging_, error);
    // Parent folders that this object has created are removed too, unless somebody has put anything into them.
    fs::path folder = target_.parent_path();
    for (std::size_t i = 0; i < created_parents_ && fs::remove(folder, error); ++i) folder = folder.parent_path();
  }
  if (mark_ >= 0) close(mark_);
}

// A kill leaves one of two states. The run is unfinished and has its checkpoint; or it is in its place, and the replaced folder is
// marked as a leftover.
void OutputFolder::commit() {
  const fs::path results = std::exchange(staging_, {});  // the run is complete and stays there if it cannot be moved
  const auto fail = [&results](const std::string& reason) {
    mark_finished(results);
    throw std::runtime_error(reason + "; the results are in \"" + results.string() + '"');
  };
  bool has_replaced = false;
  try {
    refuse_foreign(target_, results_);  // somebody may have put something there during the run
    if (const int mark = open_mark(target_, O_CREAT); mark >= 0) close(mark);  // only if there is an earlier run
    has_replaced = exchange(results, target_);
    if (!has_replaced) {
      fs::remove_all(target_);
      fs::rename(results, target_);
    }
  } catch (const InputError& error) {
    fail(error.what());
  } catch (const fs::filesystem_error& error) {
    fail("cannot create output folder \"" + target_.string() + "\": " + error.code().message());
  }
  mark_finished(target_);
  if (!has_replaced) return;
  std::error_code error;
  remove_unfinished(results, error);
  if (!error) return;
  throw std::runtime_error("cannot remove the earlier run's results, which are in \"" + results.string() +
                           "\" now: " + error.message() + "; the new ones are in \"" + target_.string() + '"');
}

}  // namespace falling_particles
