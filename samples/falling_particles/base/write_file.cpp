#include "write_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "common/input_error.hpp"
#include "common/read_file.hpp"

namespace falling_particles {

using namespace common;

namespace {

[[noreturn]] void fail_to_write(const std::filesystem::path& path, int error) {
  throw std::runtime_error("cannot write \"" + path.string() + "\": " + std::generic_category().message(error));
}

/// Writes to a pipe or a device.
void write_in_place(const std::filesystem::path& path, std::string_view text) {
  const int file = open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) fail_to_write(path, errno);
  const int failure = write_all(file, text) ? 0 : errno;
  if (::close(file) != 0 && failure == 0) fail_to_write(path, errno);
  if (failure != 0) fail_to_write(path, failure);
}

[[noreturn]] void refuse_damaged(const std::filesystem::path& path, const std::string& reason) {
  throw InputError('"' + path.string() + "\" " + reason + kStartAnew);
}

}  // namespace

bool write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(file, text.data(), text.size());
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

OutputFile::OutputFile(std::filesystem::path path, const FileState& kept) : path_(std::move(path)) {
  constexpr mode_t kReadable = 0666;  // before the user's umask
  file_ = open(path_.c_str(), O_CLOEXEC | (kept.bytes == 0 ? O_WRONLY | O_CREAT | O_TRUNC : O_RDWR), kReadable);
  if (file_ < 0 && kept.bytes > 0 && errno == ENOENT) refuse_damaged(path_, "is missing");
  if (file_ < 0) fail();
  if (kept.bytes == 0) return;
  try {
    go_on_after(kept);
  } catch (const std::exception&) {
    ::close(std::exchange(file_, -1));
    throw;
  }
}

void OutputFile::go_on_after(const FileState& kept) {
  std::string piece(1U << 20U, '\0');
  while (size_ < kept.bytes) {
    const ssize_t count = ::read(file_, piece.data(), std::min<std::uint64_t>(piece.size(), kept.bytes - size_));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail();
    if (count == 0) {
      refuse_damaged(path_,
                     "has " + std::to_string(size_) + " bytes, and had " + std::to_string(kept.bytes) + " when it was last saved");
    }
    hash_.add({piece.data(), static_cast<std::size_t>(count)});
    size_ += static_cast<std::uint64_t>(count);
  }
  if (hash_.value() != kept.hash) refuse_damaged(path_, "was changed since it was last saved: its checksum is another one");
  if (ftruncate(file_, static_cast<off_t>(size_)) != 0) fail();
}

OutputFile::~OutputFile() {
  if (file_ >= 0) ::close(file_);
}

void OutputFile::write(std::string_view text) {
  if (!write_all(file_, text)) fail();
  size_ += text.size();
  hash_.add(text);
}

void OutputFile::sync() {
  if (fsync(file_) != 0) fail();
}

void OutputFile::close() {
  if (::close(std::exchange(file_, -1)) != 0) fail();
}

void OutputFile::fail() const { fail_to_write(path_, errno); }

void write_file(const std::filesystem::path& path, std::string_view text) {
  OutputFile file(path);
  try {
    file.write(text);
    file.close();
  } catch (const std::runtime_error&) {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    throw;
  }
}

void replace_file(const std::filesystem::path& path, std::string_view text) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status there = fs::status(path, error);
  if (fs::exists(there) && !fs::is_regular_file(there)) return write_in_place(path, text);
  const fs::path target = fs::is_symlink(path, error) ? fs::weakly_canonical(path, error) : path;  // a link stays a link
  std::string beside = target.string() + ".XXXXXX";
  const int file = mkstemp(beside.data());
  if (file < 0) fail_to_write(path, errno);
  const mode_t mask = umask(0);
  umask(mask);
  const auto mode = fs::exists(there) ? static_cast<mode_t>(there.permissions()) : static_cast<mode_t>(0666 & ~mask);
  const bool is_written = write_all(file, text) && fchmod(file, mode) == 0 && fsync(file) == 0;
  int failure = is_written ? 0 : errno;
  if (::close(file) != 0 && failure == 0) failure = errno;
  if (failure == 0 && ::rename(beside.c_str(), target.c_str()) != 0) failure = errno;
  if (failure == 0) return;
  ::unlink(beside.c_str());
  fail_to_write(path, failure);
}

void sync_folder(const std::filesystem::path& path) {
  const int folder = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) fail_to_write(path, errno);
  const bool is_synced = fsync(folder) == 0;
  const int error = errno;
  ::close(folder);
  // Some file systems cannot sync folders, and return EINVAL.
  if (!is_synced && error != EINVAL) fail_to_write(path, error);
}

void create_folder(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directory(path, error);
  if (error) throw std::runtime_error("cannot create \"" + path.string() + "\": " + error.message());
}

void close_or_throw(std::ofstream& stream, const std::filesystem::path& path) {
  stream.close();
  if (!stream) fail_to_write(path, errno == 0 ? EIO : errno);
}

Hash hash_of(std::string_view bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return {hash.low64, hash.high64};
}

RunningHash::RunningHash() : state_(XXH3_createState()) {
  if (!state_ || XXH3_128bits_reset(state_.get()) == XXH_ERROR) throw std::bad_alloc();
}

void RunningHash::add(std::string_view bytes) { XXH3_128bits_update(state_.get(), bytes.data(), bytes.size()); }

Hash RunningHash::value() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_.get());
  return {hash.low64, hash.high64};
}

void RunningHash::Free::operator()(XXH3_state_s* state) const { XXH3_freeState(state); }

Hash hash_of_file(const std::filesystem::path& path) { return hash_of(read_file(path)); }

}  // namespace falling_particles
