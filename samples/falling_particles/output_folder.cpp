#include "output_folder.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <system_error>

#include "input_error.hpp"
#include "output_files.hpp"

namespace falling_particles {
namespace {

namespace fs = std::filesystem;

/// Nothing of the user's is ever deleted: a folder is replaced only when everything in it was written by a run.
void refuse_foreign(const fs::path& target) {
  if (!fs::exists(fs::symlink_status(target))) return;
  if (!fs::is_directory(fs::symlink_status(target))) {
    throw InputError("output \"" + target.string() + "\" exists and is not a folder; allowed: a new folder or an earlier run's");
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(target)) {
    if (std::ranges::find(kOutputFiles, entry.path().filename().string()) == kOutputFiles.end()) {
      throw InputError("output folder \"" + target.string() + "\" holds " + entry.path().filename().string() +
                       ", which no run writes; allowed: a new folder or an earlier run's (see --out)");
    }
  }
}

std::size_t count_missing(fs::path folder) {
  std::size_t missing = 0;
  for (; !folder.empty() && !fs::exists(folder); folder = folder.parent_path()) ++missing;
  return missing;
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& parent, const std::string& name)
    : target_(parent / name),
      staging_(parent / ("." + name + ".unfinished-" + std::to_string(getpid()))),
      created_parents_(count_missing(parent)) {
  refuse_foreign(target_);
  std::error_code error;
  fs::create_directories(staging_, error);
  if (error) throw InputError("cannot create output folder \"" + target_.string() + "\": " + error.message());
}

OutputFolder::~OutputFolder() {
  if (staging_.empty()) return;
  std::error_code error;
  fs::remove_all(staging_, error);
  // Folders above that this object has created go too, if nobody else has put anything into them.
  fs::path folder = target_.parent_path();
  for (std::size_t i = 0; i < created_parents_ && fs::remove(folder, error); ++i) folder = folder.parent_path();
}

void OutputFolder::commit() {
  refuse_foreign(target_);  // somebody may have put something there during the run
  fs::remove_all(target_);
  fs::rename(staging_, target_);
  staging_.clear();
}

}  // namespace falling_particles
