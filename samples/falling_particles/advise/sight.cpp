#include "sight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "common/interval.hpp"

namespace falling_particles {
namespace {

dGeomID geom_of(const Region& region) {
  const auto& [corner, size] = region;
  const dGeomID box = dCreateBox(nullptr, size[0], size[1], size[2]);
  dGeomSetPosition(box, corner[0] + size[0] / 2, corner[1] + size[1] / 2, corner[2] + size[2] / 2);
  return box;
}

dGeomID geom_of(const HalfSpace& below) {
  const auto& [point, normal] = below;
  return dCreatePlane(nullptr, normal[0], normal[1], normal[2], normal[0] * point[0] + normal[1] * point[1] + normal[2] * point[2]);
}

}  // namespace

Sight::Sight(const World& world)
    : world_(world), solids_(world.walls().geoms()), ray_(dCreateRay(nullptr, kLargestLength), dGeomDestroy) {
  dGeomRaySetClosestHit(ray_.get(), 0);
  for (const Sink& sink : world.scene().sinks) {
    sinks_.emplace_back(std::visit([](const auto& region) { return geom_of(region); }, sink.region), dGeomDestroy);
    solids_.push_back(sinks_.back().get());
  }
}

std::optional<Sight::Seen> Sight::look(const Point& from, const Vector3& direction) const {
  dGeomRaySet(ray_.get(), from[0], from[1], from[2], direction.x(), direction.y(), direction.z());
  std::optional<Seen> seen;
  double nearest = INFINITY;
  const std::vector<Wall>& walls = world_.scene().walls;
  for (std::size_t i = 0; i < solids_.size(); ++i) {
    const std::optional<dContactGeom> hit = hit_of(solids_[i]);
    if (!hit || !(hit->depth < nearest)) continue;
    nearest = hit->depth;
    seen = Seen{nearest, {}, false};
    if (i >= walls.size() || !walls[i].is_part()) continue;
    seen->wall = i;
    seen->is_back = is_back_of(walls[i], hit->side1, direction);
  }
  return seen;
}

// For the closest hit only, ODE would test one of the two windings of a triangle of a two-sided mesh, possibly the one that the
// mesh then rejects. So all hits are collected.
std::optional<dContactGeom> Sight::hit_of(dGeomID solid) const {
  constexpr int kMostHits = 64;
  std::array<dContactGeom, kMostHits> hits;
  const int count = dCollide(solid, ray_.get(), kMostHits, hits.data(), sizeof hits[0]);
  if (count == 0) return {};
  return *std::min_element(hits.begin(), hits.begin() + count,
                           [](const dContactGeom& one, const dContactGeom& other) { return one.depth < other.depth; });
}

bool Sight::is_back_of(const Wall& wall, int triangle, const Vector3& direction) const {
  const auto* const mesh = std::get_if<MeshShape>(&wall.shape);
  if (mesh == nullptr || mesh->two_sided || triangle < 0) return false;
  const auto& [a, b, c] = mesh->triangles[static_cast<std::size_t>(triangle)];
  const auto corner = [&](unsigned int i) {
    const auto& [x, y, z] = mesh->vertices[i];
    return Vector3(x, y, z);
  };
  const Vector3 normal = wall.start.rotation * (corner(b) - corner(a)).cross(corner(c) - corner(a));
  return normal.dot(direction) > 0;
}

}  // namespace falling_particles
