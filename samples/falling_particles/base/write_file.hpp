// Writing files without losing anything in silence: what cannot be written is a std::runtime_error with the file and the reason.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "hash.hpp"

namespace falling_particles {

/// Writes to an open file; false, with errno, when it does not take all.
bool write_all(int file, std::string_view text);

/// How far a file has come.
struct FileState {
  std::uint64_t bytes = 0;
  Hash hash{};  ///< of these bytes

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(bytes, hash);
  }
};

/// A file that grows piece by piece. Each piece is handed over to the system at once: a run that is killed leaves whole pieces.
class OutputFile {
 public:
  /// Goes on after the bytes of `kept`, which the file begins with; what it has beyond them is cut off. Without bytes: a new file.
  /// Throws InputError when the file does not begin so, or is not there.
  explicit OutputFile(std::filesystem::path path, const FileState& kept = {});
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);
  void close();
  FileState state() const { return {size_, hash_.value()}; }  ///< of all that was written, that of before included
  /// Returns when what was written survives a power cut.
  void sync();

 private:
  [[noreturn]] void fail() const;
  void go_on_after(const FileState& kept);

  std::filesystem::path path_;
  int file_;
  std::uint64_t size_ = 0;
  RunningHash hash_;
};

/// Writes a whole file, or none. For files in a folder of ours: what was there is gone if it fails.
void write_file(const std::filesystem::path& path, std::string_view text);

/// Writes a file that the user has named: the whole of it, or what was there stays. What is no regular file, such as a pipe or a
/// device, is written as it is, and never removed.
void replace_file(const std::filesystem::path& path, std::string_view text);

/// Returns when the names of the files in a folder survive a power cut.
void sync_folder(const std::filesystem::path& path);

/// Creates a folder, if it is not there.
void create_folder(const std::filesystem::path& path);

/// Ends a file that a stream has written.
void close_or_throw(std::ofstream& stream, const std::filesystem::path& path);

}  // namespace falling_particles
