#include "supernormal/proximity/pose.hpp"

#include <stdexcept>

#include "base/usable_pose.hpp"
#include "base/validation.hpp"
#include "shapes/description_text.hpp"

namespace supernormal {

std::string describe(const Pose& pose) {
  std::string text = "Pose(position=";
  append_text(text, pose.position);
  text += ", rotation=";
  append_text(text, pose.rotation);
  return text + ")";
}

Pose read_pose(std::string_view text) {
  DescriptionReader reader(text);
  Pose pose;
  for (const char* const word : {"Pose", "(", "position", "="}) reader.expect(word);
  pose.position = reader.vector();
  for (const char* const word : {",", "rotation", "="}) reader.expect(word);
  pose.rotation = reader.matrix();
  reader.expect(")");
  reader.end();
  for (const double coordinate : pose.position) require_in("coordinate of position", coordinate, -kFarthest, kFarthest, "m");
  if (is_rotation(pose.rotation)) return pose;
  std::string matrix;
  append_text(matrix, pose.rotation);
  throw std::invalid_argument("rotation = " + matrix + ", but must be orthonormal and right-handed to 1e-5");
}

}  // namespace supernormal
