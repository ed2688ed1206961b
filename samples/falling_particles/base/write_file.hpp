// Writing files without silent loss: a failure throws std::runtime_error with the file and the reason.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "hash.hpp"

namespace falling_particles {

/// Writes to an open file. Returns false and sets errno when it cannot write all bytes.
bool write_all(int file, std::string_view text);

/// The written length of a file.
struct FileState {
  std::uint64_t bytes = 0;
  Hash hash{};  ///< of these bytes

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(bytes, hash);
  }
};

/// A file that grows piece by piece. Each piece goes to the operating system at once, so that a killed run leaves whole pieces.
class OutputFile {
 public:
  /// Continues after the bytes of `kept`, with which the file must begin; it cuts off the rest. If `kept` is empty, it creates a
  /// new file. Throws InputError when the file does not begin with these bytes, or does not exist.
  explicit OutputFile(std::filesystem::path path, const FileState& kept = {});
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);
  void close();
  FileState state() const { return {size_, hash_.value()}; }  ///< of all bytes, earlier ones included
  /// Returns when the written bytes survive a power cut.
  void sync();

 private:
  [[noreturn]] void fail() const;
  void go_on_after(const FileState& kept);

  std::filesystem::path path_;
  int file_;
  std::uint64_t size_ = 0;
  RunningHash hash_;
};

/// Writes a whole file, or none, into an output folder. If it fails, the earlier content is lost.
void write_file(const std::filesystem::path& path, std::string_view text);

/// Writes a file that the user has named. If it fails, the earlier content stays. A pipe or a device is written in place and never
/// removed.
void replace_file(const std::filesystem::path& path, std::string_view text);

/// Returns when the names in a folder survive a power cut.
void sync_folder(const std::filesystem::path& path);

/// Creates a folder if it does not exist.
void create_folder(const std::filesystem::path& path);

/// Closes a stream. Throws std::runtime_error if anything could not be written.
void close_or_throw(std::ofstream& stream, const std::filesystem::path& path);

}  // namespace falling_particles
