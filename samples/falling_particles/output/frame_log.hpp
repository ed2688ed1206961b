// The frames of a run in a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "base/write_file.hpp"
#include "frame.hpp"

namespace falling_particles {

/// A file to which frames are appended, all their numbers bit for bit: pictures, which keep what they have seen in memory, come
/// back when they see the same frames again.
class FrameLog {
 public:
  /// Begins a file, or goes on after the bytes of `kept`, with which one that is there begins.
  explicit FrameLog(const std::filesystem::path& path, const FileState& kept = {}) : file_(path, kept) {}
  void add(const Frame& frame);
  FileState state() const { return file_.state(); }
  void sync() { file_.sync(); }

 private:
  OutputFile file_;
};

/// Visits the frames in the first `size` bytes of a log. Throws InputError where they are not what was written.
void replay_frames(const std::filesystem::path& path, std::uint64_t size, const std::function<void(const Frame&)>& visit);

}  // namespace falling_particles
