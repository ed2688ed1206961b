#include "output/write_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace falling_particles {
namespace {

[[noreturn]] void fail_to_write(const std::filesystem::path& path, int error) {
  throw std::runtime_error("cannot write \"" + path.string() + "\": " + std::generic_category().message(error));
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

OutputFile::OutputFile(std::filesystem::path path, std::uint64_t kept) : path_(std::move(path)), size_(kept) {
  constexpr mode_t kReadable = 0666;  // less the user's umask
  file_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | (kept == 0 ? O_TRUNC : O_APPEND), kReadable);
  if (file_ < 0) fail();
  if (kept == 0) return;
  struct stat status {};
  const bool is_known = fstat(file_, &status) == 0;
  const bool is_short = is_known && std::cmp_less(status.st_size, kept);
  const bool is_cut = is_known && !is_short && ftruncate(file_, static_cast<off_t>(kept)) == 0;
  if (is_cut) return;
  const int error = errno;
  ::close(std::exchange(file_, -1));
  if (!is_short) fail_to_write(path_, error);
  throw std::runtime_error("\"" + path_.string() + "\" has " + std::to_string(status.st_size) + " bytes, and had " +
                           std::to_string(kept) + " when it was last saved");
}

OutputFile::~OutputFile() {
  if (file_ >= 0) ::close(file_);
}

void OutputFile::write(std::string_view text) {
  if (!write_all(file_, text)) fail();
  size_ += text.size();
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

void sync_folder(const std::filesystem::path& path) {
  const int folder = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) fail_to_write(path, errno);
  const bool is_synced = fsync(folder) == 0;
  const int error = errno;
  ::close(folder);
  // Some file systems have nothing to do for a folder, and say so.
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

}  // namespace falling_particles
