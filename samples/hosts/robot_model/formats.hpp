// SDF behind read_scene(), and what its reader shares with that of URDF.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "scene.hpp"

namespace robot_model {

Scene read_sdf(const std::string& path, bool strict);

/// The shape of a <geometry>; none, with a line in scene.left_out, if it is not known and the reader is not strict.
inline std::optional<Shape> shape_in(Scene& scene, bool strict, const std::string& element, const TextOf& text_of,
                                     const std::string& where) {
  if (strict || is_known(element)) return read_shape(element, text_of, where);
  scene.left_out.push_back(where + ": <" + element + ">");
  return std::nullopt;
}

inline void add_once(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

}  // namespace robot_model
