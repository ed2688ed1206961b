#include "checkpoints.hpp"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>
#include <variant>

#include "base/files.hpp"
#include "base/write_file.hpp"
#include "common/input_error.hpp"
#include "common/interval.hpp"
#include "common/read_file.hpp"

namespace falling_particles {
namespace {

/// Throws InputError if bodies cannot fall asleep between two checkpoints. ODE's auto-disable history cannot be saved, so that it
/// starts anew at each checkpoint.
void require_time_to_sleep(const Scene& scene, int every) {
  for (const supernormal::effects::Effect& effect : scene.effects) {
    const auto* const sleep = std::get_if<supernormal::effects::AutoDisable>(&effect);
    if (sleep == nullptr) continue;
    const double least = 2 * sleep->samples + std::ceil(sleep->time / scene.time.step) + 1;
    if (every >= least) continue;
    throw InputError("--checkpoint-every is " + std::to_string(every) + "; allowed with [auto_disable] of the scene: at least " +
                     shortest(least) + " steps, within which bodies can fall asleep");
  }
}

}  // namespace

Checkpoints::Checkpoints(OutputFolder& folder, const Scene& scene, int every) : folder_(folder) {
  origin_.every = every;
  if (!folder.is_resumed() && every == 0) return;  // the files of the scene need not be read again
  origin_ = origin_of(scene, every);
  if (folder.is_resumed()) {
    Checkpoint checkpoint = unseal(read_file(file()), file());
    refuse_other(checkpoint.origin, origin_, file());
    origin_.every = checkpoint.origin.every;
    last_ = std::move(checkpoint.state);
  }
  require_time_to_sleep(scene, origin_.every);
}

std::filesystem::path Checkpoints::file() const { return folder_.file(std::string(kCheckpointFile)); }

void Checkpoints::write(std::string state) {
  const std::filesystem::path fresh = folder_.file(std::string(kNewCheckpointFile));
  Checkpoint checkpoint{origin_, std::move(state)};
  try {
    OutputFile stream(fresh);
    stream.write(seal(checkpoint));
    stream.sync();
    stream.close();
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(fresh, ignored);
    throw;
  }
  std::filesystem::rename(fresh, file());
  sync_folder(file().parent_path());
  sync_folder(file().parent_path().parent_path());
  folder_.keep();
  last_ = std::move(checkpoint.state);
}

}  // namespace falling_particles
