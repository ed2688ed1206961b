#include "shown_components.hpp"

#include <Eigen/Geometry>

namespace falling_particles {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

Vector3d to_vector(const Point& point) { return {point[0], point[1], point[2]}; }
Point to_point(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Quaterniond to_quaternion(const std::array<double, 4>& q) { return {q[0], q[1], q[2], q[3]}; }

ConvexBody scaled(ConvexBody body, double scale) {
  for (double& half_axis : body.half_axes) half_axis *= scale;
  body.rounding *= scale;
  return body;
}

}  // namespace

std::vector<ShownComponent> shown_components(const Frame& frame, const Contents& contents) {
  std::vector<std::vector<Component>> components_of_kind;
  components_of_kind.reserve(contents.scene->kinds.size());
  for (const GrainCount& entry : contents.scene->kinds) components_of_kind.push_back(entry.kind.all_components());
  std::vector<ShownComponent> shown;
  shown.reserve(frame.grains.size());
  std::size_t index = 0;
  for (std::size_t k = 0; k < frame.grains.size(); ++k) {
    const GrainState& state = frame.grains[k];
    const std::vector<Component>& components = components_of_kind[contents.kind_of_grain[k]];
    if (!state.is_present) {
      index += components.size();
      continue;
    }
    const double scale = contents.scale(k);
    for (const Component& component : components) {
      ShownComponent& shown_component = shown.emplace_back(ShownComponent{
          index++, k, scaled(component.body, scale), state.position, state.quaternion, state.velocity, state.angular_velocity});
      if (contents.kind(k).components.empty()) continue;  // exactly the state of the grain
      const Quaterniond orientation = to_quaternion(state.quaternion);
      const Vector3d offset = orientation * (scale * to_vector(component.position));
      const Quaterniond rotation = orientation * to_quaternion(component.quaternion);
      shown_component.position = to_point(to_vector(state.position) + offset);
      shown_component.quaternion = {rotation.w(), rotation.x(), rotation.y(), rotation.z()};
      shown_component.velocity = to_point(to_vector(state.velocity) + to_vector(state.angular_velocity).cross(offset));
    }
  }
  return shown;
}

}  // namespace falling_particles
