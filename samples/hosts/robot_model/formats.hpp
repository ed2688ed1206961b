// The two formats behind read_scene().
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "scene.hpp"

class TiXmlDocument;

namespace robot_model {

Scene read_sdf(const std::string& path);
Scene read_urdf(const std::string& path, const TiXmlDocument& document);

inline void add_once(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

}  // namespace robot_model
