// Numbers of VTK's XML files, and of glTF files.
#pragma once

#include <doctest/doctest.h>
#include <tiny_gltf.h>

#include <cstring>
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

/// The model of a .glb file without errors.
inline tinygltf::Model read_glb(const std::string& path) {
  tinygltf::Model model;
  std::string error, warning;
  REQUIRE(tinygltf::TinyGLTF().LoadBinaryFromFile(&model, &error, &warning, path));
  CHECK((error + warning).empty());
  return model;
}

/// The numbers of an accessor.
inline std::vector<float> read(const tinygltf::Model& model, int accessor) {
  const tinygltf::Accessor& found = model.accessors[static_cast<std::size_t>(accessor)];
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(found.bufferView)];
  std::vector<float> numbers(found.count *
                             static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(found.type))));
  std::memcpy(numbers.data(), model.buffers[0].data.data() + view.byteOffset + found.byteOffset, numbers.size() * sizeof(float));
  return numbers;
}

}  // namespace falling_particles
