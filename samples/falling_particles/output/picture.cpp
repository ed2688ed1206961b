#include "output/picture.hpp"

#include <algorithm>

namespace falling_particles {

const std::vector<PictureFormat>& picture_formats() {
  static const std::vector<PictureFormat> formats = {};
  return formats;
}

std::vector<std::string> default_pictures() { return {}; }

const PictureFormat* find_picture_format(std::string_view name) {
  const auto found = std::ranges::find(picture_formats(), name, &PictureFormat::name);
  return found == picture_formats().end() ? nullptr : &*found;
}

}  // namespace falling_particles
