#include "shown_parts.hpp"

#include <Eigen/Geometry>

namespace falling_particles {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

Vector3d to_vector(const Point& point) { return {point[0], point[1], point[2]}; }
Point to_point(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Quaterniond to_quaternion(const std::array<double, 4>& q) { return {q[0], q[1], q[2], q[3]}; }

GrainBody scaled(GrainBody body, double scale) {
  for (double& half_axis : body.half_axes) half_axis *= scale;
  body.rounding *= scale;
  return body;
}

}  // namespace

std::vector<ShownPart> shown_parts(const Frame& frame, const Contents& contents) {
  std::vector<std::vector<GrainPart>> parts_of_kind;
  parts_of_kind.reserve(contents.scene->grains.size());
  for (const GrainCount& kind : contents.scene->grains) parts_of_kind.push_back(kind.grain.all_parts());
  std::vector<ShownPart> shown;
  shown.reserve(frame.bodies.size());
  std::size_t index = 0;
  for (std::size_t k = 0; k < frame.bodies.size(); ++k) {
    const BodyState& state = frame.bodies[k];
    const std::vector<GrainPart>& parts = parts_of_kind[contents.kind_of_body[k]];
    if (!state.is_present) {
      index += parts.size();
      continue;
    }
    const double scale = contents.scale(k);
    for (const GrainPart& part : parts) {
      ShownPart& body = shown.emplace_back(ShownPart{index++, k, scaled(part.body, scale), state.position, state.quaternion,
                                                     state.velocity, state.angular_velocity});
      if (contents.grain(k).parts.empty()) continue;  // to the last digit what the grain is
      const Quaterniond attitude = to_quaternion(state.quaternion);
      const Vector3d offset = attitude * (scale * to_vector(part.position));
      const Quaterniond turned = attitude * to_quaternion(part.quaternion);
      body.position = to_point(to_vector(state.position) + offset);
      body.quaternion = {turned.w(), turned.x(), turned.y(), turned.z()};
      body.velocity = to_point(to_vector(state.velocity) + to_vector(state.angular_velocity).cross(offset));
    }
  }
  return shown;
}

}  // namespace falling_particles
