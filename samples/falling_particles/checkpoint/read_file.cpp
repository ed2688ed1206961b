#include "checkpoint/read_file.hpp"

#include <cerrno>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace falling_particles {

std::string read_file(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream bytes;
  if (stream && stream.peek() != std::ifstream::traits_type::eof()) bytes << stream.rdbuf();
  if (!stream.is_open() || stream.bad() || bytes.fail()) {
    throw std::runtime_error("cannot read \"" + path.string() + "\": " + std::generic_category().message(errno == 0 ? EIO : errno));
  }
  return bytes.str();
}

}  // namespace falling_particles
