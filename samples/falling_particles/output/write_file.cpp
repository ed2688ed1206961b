#include "output/write_file.hpp"

#include <stdexcept>

namespace falling_particles {

void close_or_throw(std::ofstream& stream, const std::filesystem::path& path) {
  stream.close();
  if (!stream) throw std::runtime_error("cannot write \"" + path.string() + "\" (is the disk full?)");
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream stream(path);
  stream << text;
  close_or_throw(stream, path);
}

}  // namespace falling_particles
