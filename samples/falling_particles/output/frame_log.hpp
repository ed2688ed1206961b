// A log of the frames of a run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "base/write_file.hpp"
#include "frame.hpp"

namespace falling_particles {

/// A file of frames with exact numbers. Pictures keep what they have seen in memory; a resumed run shows them the logged frames
/// again.
class FrameLog {
 public:
  /// Creates a file, or continues after the bytes of `kept`, with which an existing file begins.
  explicit FrameLog(const std::filesystem::path& path, const FileState& kept = {}) : file_(path, kept) {}
  void add(const Frame& frame);
  FileState state() const { return file_.state(); }
  void sync() { file_.sync(); }

 private:
  OutputFile file_;
};

/// Visits the frames in the first `size` bytes of a log. Throws InputError when the bytes were changed.
void replay_frames(const std::filesystem::path& path, std::uint64_t size, const std::function<void(const Frame&)>& visit);

}  // namespace falling_particles
