#include "output/close_stream.hpp"

#include <stdexcept>

namespace falling_particles {

void close_or_throw(std::ofstream& stream, const std::filesystem::path& path) {
  stream.close();
  if (!stream) throw std::runtime_error("cannot write \"" + path.string() + "\" (is the disk full?)");
}

}  // namespace falling_particles
