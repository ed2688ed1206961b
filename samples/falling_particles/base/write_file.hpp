// Writing files without silent loss: a failure throws std::runtime_error with the file and the reason.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>

struct XXH3_state_s;

namespace falling_particles {

/// An XXH3 hash of 128 bits. It distinguishes texts unless somebody makes them collide on purpose.
using Hash = std::array<std::uint64_t, 2>;

Hash hash_of(std::string_view bytes);

/// Hashes bytes that arrive piece by piece.
class RunningHash {
 public:
  RunningHash();
  void add(std::string_view bytes);
  Hash value() const;  ///< of all bytes so far

 private:
  struct Free {
    void operator()(XXH3_state_s* state) const;
  };
  std::unique_ptr<XXH3_state_s, Free> state_;
};

/// Hashes the content of a file. Throws std::runtime_error when the file cannot be read.
Hash hash_of_file(const std::filesystem::path& path);

/// Writes to an open file. Returns false and sets errno when it cannot write all bytes.
bool write_all(int file, std::string_view text);

/// The written length of a file.
struct FileState {
  std::uint64_t bytes = 0;
  Hash hash{};  ///< of these bytes

  void serialize(auto& archive) { archive(bytes, hash); }
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

inline constexpr std::string_view kCheckpointFile = "checkpoint";
inline constexpr std::string_view kNewCheckpointFile = "checkpoint.new";  ///< the checkpoint that is being written
inline constexpr std::string_view kFrameLogFile = "checkpoint.frames";
inline constexpr std::array kCheckpointFiles = {kCheckpointFile, kNewCheckpointFile, kFrameLogFile};

/// The advice to a user when a run cannot be resumed.
inline constexpr const char* kStartAnew =
    "; without --resume the run starts anew, and removes this unless other files are beside it";

}  // namespace falling_particles
