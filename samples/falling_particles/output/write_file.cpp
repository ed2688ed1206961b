#include "output/write_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
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

OutputFile::OutputFile(std::filesystem::path path) : path_(std::move(path)) {
  constexpr mode_t kReadable = 0666;  // less the user's umask
  file_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kReadable);
  if (file_ < 0) fail();
}

OutputFile::~OutputFile() {
  if (file_ >= 0) ::close(file_);
}

void OutputFile::write(std::string_view text) {
  if (!write_all(file_, text)) fail();
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
