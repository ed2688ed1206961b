// Writing files without losing anything in silence: what cannot be written is a std::runtime_error with the file and the reason.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace falling_particles {

/// Writes to an open file; false, with errno, when it does not take all.
bool write_all(int file, std::string_view text);

/// A file that grows piece by piece. Each piece is handed over to the system at once: a run that is killed leaves whole pieces.
class OutputFile {
 public:
  /// Goes on after the first `kept` bytes of a file that is there; what it has beyond them is cut off. 0: a new file.
  explicit OutputFile(std::filesystem::path path, std::uint64_t kept = 0);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);
  void close();
  std::uint64_t size() const { return size_; }  ///< bytes written so far, those of before included
  /// Returns when what was written survives a power cut.
  void sync();

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  int file_;
  std::uint64_t size_;
};

/// Writes a whole file, or none.
void write_file(const std::filesystem::path& path, std::string_view text);

/// Returns when the names of the files in a folder survive a power cut.
void sync_folder(const std::filesystem::path& path);

/// Creates a folder, if it is not there.
void create_folder(const std::filesystem::path& path);

/// Ends a file that a stream has written.
void close_or_throw(std::ofstream& stream, const std::filesystem::path& path);

}  // namespace falling_particles
