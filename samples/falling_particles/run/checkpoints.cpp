#include "checkpoints.hpp"

#include <ode/ode.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>

#include "base/archive.hpp"
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

constexpr std::string_view kMagic = "SNCHKPT\n";
constexpr std::uint32_t kFormat = 11;  // increase it with every change of the saved data

constexpr std::uint32_t in_other_byte_order(std::uint32_t x) {
  return x >> 24U | (x >> 8U & 0xff00U) | (x << 8U & 0xff0000U) | x << 24U;
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason) {
  throw InputError("checkpoint \"" + path.string() + "\" " + reason + kStartAnew);
}

std::string words(const std::vector<std::string>& list, const char* none) {
  std::string text;
  for (const std::string& word : list) text += (text.empty() ? "" : ", ") + word;
  return text.empty() ? none : text;
}

std::string precision(std::uint32_t bytes) { return bytes == sizeof(double) ? "double precision" : "single precision"; }

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

Origin origin_of(const Scene& scene, int every) {
  Origin origin{FALLING_PARTICLES_VERSION, sizeof(dReal), {}, scene.overrides, scene.pictures, every};
  for (const std::filesystem::path& file : scene.files) origin.files.push_back({file.filename().string(), hash_of_file(file)});
  return origin;
}

std::string seal(const Checkpoint& checkpoint) {
  const std::string bytes = std::string(kMagic) + to_bytes(kFormat, checkpoint.origin, checkpoint.state);
  return bytes + to_bytes(hash_of(bytes));
}

Checkpoint unseal(const std::string& bytes, const std::filesystem::path& path) {
  if (!bytes.starts_with(kMagic)) refuse(path, bytes.empty() ? "is empty" : "is not one of falling_particles");
  if (bytes.size() < kMagic.size() + sizeof kFormat + sizeof(Hash)) refuse(path, "is torn: it ends too early");
  const std::size_t end = bytes.size() - sizeof(Hash);
  Reader body(bytes.substr(kMagic.size(), end - kMagic.size()));
  const auto format = body.read<std::uint32_t>();
  if (format == in_other_byte_order(kFormat)) {
    refuse(path, "is of a machine with the other byte order, on which it can go on");
  }
  if (format != kFormat) {
    refuse(path, "has format " + std::to_string(format) + "; allowed: " + std::to_string(kFormat) + ", that of this program");
  }
  if (Reader(bytes.substr(end)).read<Hash>() != hash_of(std::string_view(bytes).substr(0, end))) {
    refuse(path, "is torn: its checksum is another one");
  }
  Checkpoint checkpoint;
  body(checkpoint.origin, checkpoint.state);
  return checkpoint;
}

void refuse_other(const Origin& saved, const Origin& here, const std::filesystem::path& path) {
  if (saved.program != here.program) {
    refuse(path, "is of version " + saved.program + " of the program; allowed: " + here.program + ", this one");
  }
  if (saved.bytes_of_a_real != here.bytes_of_a_real) {
    refuse(path, "is of ODE with " + precision(saved.bytes_of_a_real) + "; allowed: " + precision(here.bytes_of_a_real) +
                     ", that of this program");
  }
  if (saved.files.size() != here.files.size()) refuse(path, "is of another scene, which names other files");
  for (std::size_t i = 0; i < saved.files.size(); ++i) {
    if (saved.files[i].hash == here.files[i].hash) continue;
    refuse(path, "is of another scene: the text of " + here.files[i].name + " was another one when it was written");
  }
  if (saved.overrides != here.overrides) {
    refuse(path, "is of a run with " + words(saved.overrides, "nothing") + " set; this one has " +
                     words(here.overrides, "nothing") + " (see --set)");
  }
  if (saved.pictures != here.pictures) {
    refuse(path, "is of a run that leaves " + words(saved.pictures, "no pictures") + "; this one leaves " +
                     words(here.pictures, "no pictures") + " (see --no-pictures)");
  }
  if (here.every != 0 && saved.every != here.every) {
    refuse(path, "is of a run with --checkpoint-every " + std::to_string(saved.every) + "; allowed: the same, or none, and not " +
                     std::to_string(here.every) + ", with which the results would be others");
  }
}

}  // namespace falling_particles
