#include "support/hard_cases/catalogue.hpp"

#include <iterator>
#include <utility>

#include "support/hard_cases/builders.hpp"

namespace supernormal::samples {

HardCase pair(std::string name, std::string reason, const Body& body1, const Body& body2, const Pose& pose2,
              std::optional<double> gap) {
  return {.name = std::move(name),
          .reason = std::move(reason),
          .body1 = body1,
          .body2 = body2,
          .shape1 = make_shape(body1),
          .shape2 = make_shape(body2),
          .pose1 = {},
          .pose2 = pose2,
          .gap = gap};
}

HardCase on_normal(std::string name, std::string reason, const Body& body1, const Vector3& n, const Body& body2,
                   const Matrix3& rotation2, double gap) {
  HardCase out = pair(std::move(name), std::move(reason), body1, body2, {});
  const Vector3 normal = n.normalized();
  const Vector3 point2 = rotation2 * out.shape2->point(-(rotation2.transpose() * normal));
  out.pose2 = {out.shape1->point(normal) + gap * normal - point2, rotation2};
  if (gap >= 0) out.gap = gap;
  return out;
}

std::vector<HardCase> hard_cases() {
  std::vector<HardCase> all;
  for (const auto& theme : {concentric_cases, face_cases, edge_and_vertex_cases, exponent_cases, aspect_ratio_cases, size_cases,
                            containment_cases, touching_cases, place_cases, collider_cases, other_shape_cases}) {
    std::vector<HardCase> some = theme();
    all.insert(all.end(), std::make_move_iterator(some.begin()), std::make_move_iterator(some.end()));
  }
  return all;
}

HardCase swapped(const HardCase& original) {
  HardCase out = original;
  std::swap(out.body1, out.body2);
  std::swap(out.shape1, out.shape2);
  std::swap(out.pose1, out.pose2);
  if (out.first_normal) out.first_normal = -(out.pose1.rotation.transpose() * (out.pose2.rotation * *out.first_normal));
  return out;
}

HardCase moved(const HardCase& original, const Pose& motion) {
  HardCase out = original;
  for (Pose* pose : {&out.pose1, &out.pose2}) {
    pose->position = motion.rotation * pose->position + motion.position;
    pose->rotation = motion.rotation * pose->rotation;
  }
  return out;
}

HardCase scaled(const HardCase& original, double unit) {
  HardCase out = original;
  out.body1 = original.body1.scaled(unit);
  out.body2 = original.body2.scaled(unit);
  out.shape1 = make_shape(out.body1);
  out.shape2 = make_shape(out.body2);
  out.pose1.position *= unit;
  out.pose2.position *= unit;
  if (out.gap) out.gap = *out.gap * unit;
  return out;
}

}  // namespace supernormal::samples
