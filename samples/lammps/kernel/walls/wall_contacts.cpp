#include "kernel/walls/wall_contacts.hpp"

#include <algorithm>
#include <optional>

#include "kernel/face_contact.hpp"
#include "supernormal/contact/contact_curvature.hpp"

namespace granular {
namespace {

/// Removes from `old` the history whose normal is nearest to n, and returns it. Returns a new history if there is none.
ContactHistory take_nearest(WallHistory& old, const Vector3& n) {
  const auto begin = old.contacts.begin(), end = begin + old.count;
  const auto nearest = std::max_element(
      begin, end, [&](const ContactHistory& a, const ContactHistory& b) { return a.normal.dot(n) < b.normal.dot(n); });
  if (nearest == end || nearest->normal.dot(n) < kSameNormal) return {};
  const ContactHistory taken = *nearest;
  *nearest = old.contacts.at(static_cast<std::size_t>(--old.count));
  return taken;
}

NormalForce elastic_force(const ContactMaterial& material, const ParticleShape& shape, const Body& particle, const Vector3& n,
                          double depth, const Matrix3& wall_curvature) {
  if (depth <= 0) return {};
  if (material.law == NormalLaw::Hooke) return hooke_force(material, depth);
  const Matrix3 sum = supernormal::find_curvature(shape.body, particle.pose, n) + wall_curvature;
  return hertz_force(material, depth, supernormal::find_contact_curvature(sum, n), shape.width);
}

/// The force of one of the contacts. A minimum has the weaker of the springs beside it: its own curvature is no contact's, and with
/// a stiffer spring it would pull.
NormalForce elastic_force_at(std::span<const WallContact> contacts, std::size_t which, const Matrix3& rotation,
                             const ContactMaterial& material, const ParticleShape& shape, const Body& particle) {
  const auto force_of = [&](const WallContact& spring) {
    const Matrix3 curvature = rotation * spring.curvature * rotation.transpose();
    return elastic_force(material, shape, particle, rotation * spring.normal, contacts[which].depth, curvature);
  };
  if (!contacts[which].is_between) return force_of(contacts[which]);
  if (contacts.size() < 2) return {};
  const NormalForce before = force_of(contacts[which > 0 ? which - 1 : which + 1]);
  const NormalForce after = force_of(contacts[which + 1 < contacts.size() ? which + 1 : which - 1]);
  return before.force < after.force ? before : after;
}

/// The faces or sides at one of the contacts.
std::optional<FaceContact> find_faces(std::span<const WallContact> contacts, std::size_t which, const supernormal::Pose& wall,
                                      const Body& particle) {
  const WallContact& found = contacts[which];
  if (found.ground) {
    Ground ground = *found.ground;
    ground.frame = wall.rotation * ground.frame;
    ground.origin = wall.position + wall.rotation * ground.origin;
    return find_ground_contact(particle, ground);
  }
  if (!found.pipe || which >= WallHistory::kMost) return std::nullopt;
  std::array<Vector3, WallHistory::kMost> normals;
  std::size_t count = 0, own = normals.size();
  for (std::size_t k = 0; k < std::min(contacts.size(), normals.size()); ++k) {
    if (contacts[k].is_between) continue;
    if (k == which) own = count;
    normals.at(count++) = wall.rotation * contacts[k].normal;
  }
  const Pipe pipe{wall.position + wall.rotation * found.pipe->point, wall.rotation * found.pipe->axis, found.pipe->radius};
  return find_pipe_contact(particle, pipe, std::span(normals).first(count), own);
}

}  // namespace

WallForce find_wall_force(Wall& wall, const Body& wall_body, const ParticleShape& shape, const Body& particle,
                          const ContactMaterial& material, double step, WallHistory& history, std::vector<WallContact>& contacts) {
  const Matrix3& rotation = wall_body.pose.rotation;
  const supernormal::Pose pose{rotation.transpose() * (particle.pose.position - wall_body.pose.position),
                               rotation.transpose() * particle.pose.rotation};
  contacts.clear();
  wall.add_contacts(shape, pose, contacts);
  WallForce sum;
  if (contacts.empty()) {
    if (step > 0) history.count = 0;
    return sum;
  }
  WallHistory old = history, kept;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const WallContact& found = contacts[k];
    const Vector3 arm2 = rotation * found.point;
    const Vector3 arm1 = wall_body.pose.position + arm2 - particle.pose.position;
    Contact contact{rotation * found.normal, arm1, arm2, std::max(0.0, found.depth)};
    const std::optional<FaceContact> faces = find_faces(contacts, k, wall_body.pose, particle);
    const bool do_faces_touch = faces && faces->count > 0;
    if (found.depth <= 0 && !do_faces_touch) continue;
    const NormalForce elastic = elastic_force_at(contacts, k, rotation, material, shape, particle);
    ContactHistory one = take_nearest(old, contact.normal);
    if (!faces && particle.is_flat()) one.release_twist();
    const ContactForce force = faces ? face_contact_force(*faces, face_stiffness(material, shape.width), elastic, material,
                                                          particle, wall_body, step, contact, one)
                                     : contact_force(contact, elastic, material, particle, wall_body, step, one);
    one.normal = contact.normal;
    if (kept.count < WallHistory::kMost) kept.contacts.at(static_cast<std::size_t>(kept.count++)) = one;
    const double sign = found.is_between ? -1 : 1;
    sum.force += sign * force.force;
    sum.torque += sign * (contact.arm1.cross(force.force) + force.torque);
    sum.wall_torque -= sign * (contact.arm2.cross(force.force) + force.torque);
    sum.energy += sign * force.energy;
    sum.depth = std::max(sum.depth, found.depth);
    sum.contacts += found.is_between ? 0 : 1;
  }
  if (step > 0) history = kept;
  return sum;
}

}  // namespace granular
