#include "recorder.hpp"

#include <fstream>
#include <string>
#include <utility>

#include "base/archive.hpp"
#include "base/write_file.hpp"
#include "common/input_error.hpp"

namespace falling_particles {
Recorder::Recorder(const OutputFolder& folder, const Scene& scene, const Simulation& simulation, bool logs_frames)
    : Recorder(folder, scene, simulation, RecorderState{{}, scene.pictures.empty() ? 0 : top_of(simulation.world, scene)},
               logs_frames) {}

Recorder::Recorder(const OutputFolder& folder, const Scene& scene, const Simulation& simulation, const RecorderState& saved)
    : Recorder(folder, scene, simulation, saved, true) {
  if (!log_) return;
  replay_frames(folder.file(std::string(kFrameLogFile)), log_->state().bytes, [this](const Frame& frame) {
    for (const std::unique_ptr<Picture>& picture : pictures_) picture->add(frame);
  });
}

Recorder::Recorder(const OutputFolder& folder, const Scene& scene, const Simulation& simulation, const RecorderState& saved,
                   bool logs_frames)
    : top_(saved.top), contents_(scene.pictures.empty() ? Contents{&scene, {}} : contents_of(simulation.world, scene, saved.top)) {
  for (const std::string& name : scene.pictures) {
    const PictureFormat& format = *find_picture_format(name);
    pictures_.push_back(format.make(folder, format, contents_));
  }
  if (logs_frames && !pictures_.empty()) log_.emplace(folder.file(std::string(kFrameLogFile)), saved.log);
}

void Recorder::record(double time, const Simulation& simulation, bool with_forces, const std::vector<TriangleField>& fields) {
  if (pictures_.empty()) return;
  add_new_grains(contents_, simulation.world);
  const Energy energy = measure_energy(simulation.world, *contents_.scene);
  Frame frame = frame_of(time, energy, contents_, simulation.world, &simulation.stepper, with_forces);
  frame.fields = fields_on(contents_, fields);
  for (const std::unique_ptr<Picture>& picture : pictures_) picture->add(frame);
  if (log_) log_frame(frame, *log_);
}

void Recorder::finish_pictures(const std::string& summary) {
  for (const std::unique_ptr<Picture>& picture : pictures_) picture->finish(summary);
}

std::vector<Rendering> Recorder::renderings() const {
  std::vector<Rendering> all;
  for (const std::unique_ptr<Picture>& picture : pictures_) {
    for (Rendering& rendering : picture->renderings()) all.push_back(std::move(rendering));
  }
  return all;
}

RecorderState Recorder::save() {
  if (!log_) return {{}, top_};
  log_->sync();
  return {log_->state(), top_};
}

void log_frame(const Frame& frame, OutputFile& log) {
  const std::string bytes = to_bytes(frame);
  log.write(to_bytes(static_cast<std::uint64_t>(bytes.size()), hash_of(bytes)) + bytes);
}

void replay_frames(const std::filesystem::path& path, std::uint64_t size, const std::function<void(const Frame&)>& visit) {
  std::ifstream stream(path, std::ios::binary);
  const auto refuse = [&](const char* reason) { throw InputError('"' + path.string() + "\" " + reason + kStartAnew); };
  const auto take = [&](std::uint64_t count) {
    std::string bytes(count <= size ? count : 0, '\0');
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (count > size || !stream) refuse("ends within a frame");
    size -= count;
    return bytes;
  };
  while (size > 0) {
    std::uint64_t length = 0;
    Hash hash{};
    Reader(take(sizeof length + sizeof hash))(length, hash);
    const std::string bytes = take(length);
    if (hash_of(bytes) != hash) refuse("is damaged: a frame has another checksum");
    visit(Reader(bytes).read<Frame>());
  }
}

}  // namespace falling_particles
