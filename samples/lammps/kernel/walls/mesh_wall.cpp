#include "kernel/walls/mesh_wall.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "kernel/face_contact.hpp"
#include "supernormal/proximity/plane.hpp"

namespace granular {
namespace {

using Box = Eigen::AlignedBox3d;

Box box_of(const supernormal::MeshTriangle& triangle) {
  Box box;
  for (const Vector3& vertex : triangle.vertices) box.extend(vertex);
  return box;
}

/// Collects the triangles that touch a box, and with a body its own box.
struct Collector {
  const std::vector<supernormal::MeshTriangle>& triangles;
  const Box box;
  const supernormal::BodyBox* body_box;
  const supernormal::Pose& pose;
  std::vector<supernormal::MeshTriangle>& found;

  // Eigen's tree requires these names.
  bool intersectVolume(const Box& volume) const { return volume.intersects(box); }  // NOLINT(readability-identifier-naming)
  bool intersectObject(int index) {                                                 // NOLINT(readability-identifier-naming)
    const supernormal::MeshTriangle& triangle = triangles[static_cast<std::size_t>(index)];
    if (body_box == nullptr || body_box->touches(pose, triangle.vertices)) found.push_back(triangle);
    return false;  // continue the search
  }
};

// Triangles whose normals are within this angle (rad) are coplanar, up to rounding of their coordinates, as in lib/contact/mesh.
constexpr double kLevel = 1e-5;

// The distance of their vertices from one plane, relative to a side of a triangle, as there.
constexpr double kCrack = 1e-6;

// The relative error of a coordinate: all formats of meshes are read in single precision.
constexpr double kRounding = 0x1p-24;

/// Out of the surface, m^2; zero without an area.
Vector3 area_of(const supernormal::MeshTriangle& triangle) {
  const std::array<Vector3, 3>& v = triangle.vertices;
  return 0.5 * (v[1] - v[0]).cross(v[2] - v[0]);
}

double longest_side(const supernormal::MeshTriangle& triangle) {
  const std::array<Vector3, 3>& v = triangle.vertices;
  return std::max({(v[1] - v[0]).norm(), (v[2] - v[1]).norm(), (v[0] - v[2]).norm()});
}

/// How far the normal of a triangle with an area may be off, rad, if each vertex is off by `rounding` (m).
double tilt_by(double rounding, const supernormal::MeshTriangle& triangle) {
  return rounding * longest_side(triangle) / area_of(triangle).norm();
}

/// Whether the tilt of a face or a side leaves it a share on a plane. `normal` is in the body's frame.
bool may_lie(const ParticleShape& shape, const Vector3& normal) {
  return std::ranges::any_of(shape.faces, [&](const Face& one) { return std::abs(normal[one.axis]) > std::cos(2 * one.tilt); }) ||
         std::ranges::any_of(shape.sides, [&](const Side& one) {
           return std::abs(normal[one.along]) < std::tan(2 * one.tilt) * one.part_across(normal);
         });
}

}  // namespace

MeshWall::MeshWall(std::vector<supernormal::MeshTriangle> triangles) : triangles_(std::move(triangles)) {
  if (triangles_.empty()) throw std::invalid_argument("mesh: there are no triangles");
  std::vector<int> indices(triangles_.size());
  std::iota(indices.begin(), indices.end(), 0);
  std::vector<Box> boxes;
  boxes.reserve(triangles_.size());
  Box all;
  for (const auto& triangle : triangles_) all.extend(boxes.emplace_back(box_of(triangle)));
  rounding_ = kRounding * all.min().cwiseAbs().cwiseMax(all.max().cwiseAbs()).norm();
  tree_.init(indices.begin(), indices.end(), boxes.begin(), boxes.end());
}

bool MeshWall::is_in_plane(const supernormal::MeshTriangle& triangle, const supernormal::MeshTriangle& seed) const {
  const Vector3 area = area_of(triangle), normal = area_of(seed).normalized(), &origin = seed.vertices[0];
  const double upright = area.dot(normal), tilt = tilt_by(rounding_, seed);
  if (upright <= 0 || area.cross(normal).norm() > (kLevel + tilt + tilt_by(rounding_, triangle)) * upright) return false;
  const double near = kCrack * longest_side(triangle) + 2 * rounding_;
  return std::ranges::all_of(triangle.vertices, [&](const Vector3& vertex) {
    return std::abs(normal.dot(vertex - origin)) <= near + tilt * (vertex - origin).norm();
  });
}

void MeshWall::collect(const supernormal::Pose& pose, double half, const supernormal::BodyBox* body_box,
                       std::vector<supernormal::MeshTriangle>& found) const {
  found.clear();
  const Vector3 reach = Vector3::Constant(half);
  Collector collector{triangles_, Box(pose.position - reach, pose.position + reach), body_box, pose, found};
  Eigen::BVIntersect(tree_, collector);
}

void MeshWall::add_contacts(const ParticleShape& shape, const supernormal::Pose& pose, std::vector<WallContact>& contacts) {
  const supernormal::BodyBox body_box = supernormal::BodyBox::of(shape.body);
  collect(pose, shape.bounding_radius, &body_box, near_);
  if (near_.empty()) return;
  const std::size_t first = contacts.size();
  tilts_.clear();
  for (const supernormal::MeshContact& contact : search_.find(shape.body, pose, near_)) {
    const supernormal::Proximity& found = contact.proximity;
    if (found.gap >= 0) continue;
    // Each contact has a stiffness of its own. A plane has one, but rounding makes a surface of many faces of it.
    const double tilt = kLevel + tilt_by(rounding_, triangles_[static_cast<std::size_t>(contact.triangle)]);
    bool is_new = true;
    for (std::size_t k = first; k < contacts.size() && is_new; ++k) {
      is_new = found.normal.cross(contacts[k].normal).norm() > tilt + tilts_[k - first] || found.normal.dot(contacts[k].normal) < 0;
    }
    if (!is_new) continue;
    contacts.push_back({found.normal, found.contact, -found.gap});
    tilts_.push_back(tilt);
  }
  if (shape.bulge == 0) return;
  find_floors(shape, pose);
  for (const Floor& floor : floors_) {
    if (floor.share == 0) continue;
    const Vector3 normal = -floor.ground.frame.col(2);
    const auto found =
        std::max_element(contacts.begin() + static_cast<std::ptrdiff_t>(first), contacts.end(),
                         [&](const WallContact& a, const WallContact& b) { return a.normal.dot(normal) < b.normal.dot(normal); });
    if (found != contacts.end() && found->normal.dot(normal) > kSameNormal) {
      found->ground = floor.ground;
    } else if (floor.gap >= 0 && floor.gap < shape.bulge) {
      // Faces and sides may meet the floor before the body does.
      contacts.push_back({normal, pose.position + pose.rotation * shape.body.point(pose.rotation.transpose() * normal), -floor.gap,
                          Matrix3::Zero(), floor.ground});
    }
  }
}

void MeshWall::find_floors(const ParticleShape& shape, const supernormal::Pose& pose) {
  floors_.clear();
  patches_.clear();
  triangles_of_floors_.clear();
  Body body;
  body.pose = pose;
  body.faces = shape.faces;
  body.sides = shape.sides;
  for (const supernormal::MeshTriangle& seed : near_) {
    const Vector3 normal = area_of(seed).normalized(), point = seed.vertices[0];
    const auto is_here = [&](const Floor& one) { return is_in_plane(seed, *one.seed); };
    if (normal.isZero() || !may_lie(shape, pose.rotation.transpose() * normal) || std::ranges::any_of(floors_, is_here)) continue;
    const double gap = supernormal::find_plane_proximity(shape.body, pose, normal, normal.dot(point)).gap;
    if (gap >= shape.bulge) continue;
    if (floors_.empty()) {
      // A tilted face is above triangles that the body does not touch: the plane may be as far from the centre as the sphere.
      collect(pose, std::numbers::sqrt2 * shape.bounding_radius, nullptr, around_);
      // The grounds refer to them.
      patches_.reserve(around_.size() * (near_.size() + 1));
      triangles_of_floors_.reserve(around_.size() * (near_.size() + 1));
    }
    Ground ground = Ground::plane(point, normal);
    ground.is_surface = true;
    const std::size_t first = patches_.size();
    for (const supernormal::MeshTriangle& other : around_) {
      if (!is_in_plane(other, seed)) continue;
      std::array<Vector2, 3>& triangle = triangles_of_floors_.emplace_back();
      for (std::size_t v = 0; v < 3; ++v) triangle[v] = ground.frame.leftCols<2>().transpose() * (other.vertices[v] - point);
      patches_.emplace_back(triangle);
    }
    ground.patches = std::span(patches_).subspan(first);
    const std::optional<FaceContact> contact = find_ground_contact(body, ground);
    floors_.push_back({ground, gap, contact ? contact->share : 0, &seed});
  }
  // The last one of a contact counts.
  std::ranges::sort(floors_, {}, [](const Floor& one) { return std::pair(one.share, -std::abs(one.gap)); });
}

}  // namespace granular
