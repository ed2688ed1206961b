#include <tinyxml.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "formats.hpp"
#include "numbers.hpp"

namespace robot_model {

namespace {

/// Stops from kNoLimit on are none, infinity and the largest double among them. ODE has no stops of a hinge beyond half a
/// revolution.
Scene without_far_stops(Scene scene) {
  for (Joint& joint : scene.joints) {
    for (double* stop : {&joint.lower, &joint.upper}) {
      if (std::abs(*stop) >= kNoLimit) *stop = std::copysign(std::numeric_limits<double>::infinity(), *stop);
    }
    if (joint.type != Joint::Type::Revolute) continue;
    for (double* stop : {&joint.lower, &joint.upper}) {
      if (!std::isfinite(*stop) || std::abs(*stop) < std::numbers::pi) continue;
      *stop = std::copysign(std::numeric_limits<double>::infinity(), *stop);
      add_once(scene.not_read, "limits of " + joint.name + " beyond pi");
    }
  }
  return scene;
}

}  // namespace

Scene read_scene(const std::string& path, bool strict) {
  TiXmlDocument document;
  if (!document.LoadFile(path.c_str())) {
    throw std::runtime_error(path + ": line " + std::to_string(document.ErrorRow()) + ": " + document.ErrorDesc());
  }
  const std::string root = document.RootElement() == nullptr ? "" : document.RootElement()->ValueStr();
  // sdformat would also read URDF, but leaves out links without <inertial>.
  if (root == "robot") return without_far_stops(read_urdf(path, document, strict));
  if (root == "sdf") return without_far_stops(read_sdf(path, strict));
  throw std::runtime_error(path + ": the root element is <" + root + ">, must be <sdf> or <robot>");
}

}  // namespace robot_model
