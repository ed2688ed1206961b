#include "frame_log.hpp"

#include <fstream>
#include <string>

#include "base/archive.hpp"
#include "base/files.hpp"
#include "base/hash.hpp"
#include "common/input_error.hpp"

namespace falling_particles {
namespace {

/// The header of a frame.
struct Head {
  std::uint64_t bytes = 0;
  Hash hash{};
};

}  // namespace

void FrameLog::add(const Frame& frame) {
  Writer writer;
  writer(frame);
  const std::string bytes = writer.bytes();
  Writer head;
  head(static_cast<std::uint64_t>(bytes.size()), hash_of(bytes));
  file_.write(head.bytes() + bytes);
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
    Head head;
    Reader reader(take(sizeof head.bytes + sizeof head.hash));
    reader(head.bytes, head.hash);
    const std::string bytes = take(head.bytes);
    if (hash_of(bytes) != head.hash) refuse("is damaged: a frame has another checksum");
    visit(Reader(bytes).read<Frame>());
  }
}

}  // namespace falling_particles
