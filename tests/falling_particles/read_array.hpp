// Numbers of VTK's XML files.
#pragma once

#include <doctest/doctest.h>

#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace falling_particles {

/// The numbers of the array of that name in a .vtp file.
inline std::vector<double> read_array(const std::string& text, const std::string& name) {
  const std::size_t at = text.find("Name=\"" + name + "\"");
  REQUIRE(at != std::string::npos);
  const std::size_t start = text.find('>', at) + 1;
  std::istringstream stream(text.substr(start, text.find('<', start) - start));
  return {std::istream_iterator<double>(stream), {}};
}

}  // namespace falling_particles
