// Doubts about grains that leave the scene: that start above nothing or behind meshes.

#include <ode/ode.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "common/interval.hpp"
#include "common/motion.hpp"
#include "doubts.hpp"
#include "world/placement.hpp"
#include "world/world.hpp"

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

/// What a ray hits first.
struct Seen {
  double distance = INFINITY;  ///< m
  const Wall* wall = nullptr;  ///< a part; null for a wall that is none, or a sink
  bool is_back = false;        ///< whether the ray hits the back of a single-sided triangle

  bool is_nothing() const { return std::isinf(distance); }
};

/// Casts rays against the walls and the sinks of a world, where they start.
class Sight {
 public:
  /// The world must outlive this object.
  explicit Sight(const World& world) : walls_(world.scene().walls), solids_(world.walls().geoms()) {
    dGeomRaySetClosestHit(ray_.get(), 0);
    for (const Sink& sink : world.scene().sinks) {
      sinks_.emplace_back(std::visit([](const auto& region) { return geom_of(region); }, sink.region), dGeomDestroy);
      solids_.push_back(sinks_.back().get());
    }
  }

  /// `direction` must have unit length.
  Seen look(const Point& from, const Vector3& direction) const;

 private:
  using Geom = std::unique_ptr<dxGeom, decltype(&dGeomDestroy)>;

  const std::vector<Wall>& walls_;
  std::vector<Geom> sinks_;
  std::vector<dGeomID> solids_;  // Scene::walls first
  Geom ray_{dCreateRay(nullptr, kLargestLength), dGeomDestroy};
};

bool is_back_of(const Wall& wall, int triangle, const Vector3& direction) {
  const auto* const mesh = std::get_if<MeshShape>(&wall.shape);
  if (mesh == nullptr || mesh->two_sided || triangle < 0) return false;
  const auto& [a, b, c] = mesh->triangles[static_cast<std::size_t>(triangle)];
  const auto corner = [&](unsigned int i) { return Eigen::Map<const Eigen::Vector3f>(mesh->vertices[i].data()).cast<double>(); };
  const Vector3 side = corner(b) - corner(a), other = corner(c) - corner(a);
  return (wall.start.rotation * side.cross(other)).dot(direction) > 0;
}

// For the closest hit only, ODE would test one of the two windings of a triangle of a two-sided mesh, possibly the one that the
// mesh then rejects. So all hits are collected.
Seen Sight::look(const Point& from, const Vector3& direction) const {
  constexpr int kMostHits = 64;
  dGeomRaySet(ray_.get(), from[0], from[1], from[2], direction.x(), direction.y(), direction.z());
  Seen seen;
  std::array<dContactGeom, kMostHits> hits;
  for (std::size_t i = 0; i < solids_.size(); ++i) {
    const int count = dCollide(solids_[i], ray_.get(), kMostHits, hits.data(), sizeof hits[0]);
    for (int k = 0; k < count; ++k) {
      const dContactGeom& hit = hits[static_cast<std::size_t>(k)];
      if (!(hit.depth < seen.distance)) continue;
      const Wall* const part = i < walls_.size() && walls_[i].is_part() ? &walls_[i] : nullptr;
      seen = {hit.depth, part, part != nullptr && is_back_of(*part, hit.side1, direction)};
    }
  }
  return seen;
}

/// Grains of the start or of a feeder, from which rays are cast.
struct Lookout {
  std::string feeder;                                 // its name; empty for the start
  bool falls;                                         // straight down, under gravity
  std::vector<std::pair<Point, double>> grains = {};  // places, and bounding radii (m)

  std::string some(std::size_t count) const {
    if (!feeder.empty()) return (count < grains.size() ? "some grains" : "grains") + (" that feeder \"" + feeder) + "\" brings are";
    return std::to_string(count) + " of " + counted(grains.size(), "grain") + (count == 1 ? " starts" : " start");
  }
};

Lookout start_of(const Scene& scene) {
  Random random(scene.seed);
  // Bonds to a part may hold the grains.
  Lookout start{"", std::ranges::none_of(scene.bonds, [](const BondRule& rule) { return rule.wall.has_value(); })};
  for (const Placement& placement : place(scene, random)) {
    constexpr std::size_t kEnough = 1000;  // the placements are in random order
    if (start.grains.size() == kEnough) break;
    start.grains.emplace_back(placement.position, placement.scale * scene.kinds[placement.kind].kind.bounding_radius());
  }
  return start;
}

/// The unit vector of gravity; empty without gravity.
std::optional<Vector3> down_in(const Scene& scene) {
  const auto* const gravity = scene.gravity();
  if (gravity == nullptr || gravity->acceleration.isZero(0)) return std::nullopt;
  return gravity->acceleration.stableNormalized();
}

/// The outermost centres of the smallest grains in the feeder's region, and its middle.
Lookout origin_of(const Feeder& feeder, const Scene& scene) {
  double radius = INFINITY;
  for (const FedKind& fed : feeder.mixture) {
    const GrainCount& entry = scene.kinds[fed.kind];
    radius = std::min(radius, entry.smallest_scale() * entry.kind.bounding_radius());
  }
  const std::optional<Vector3> down = down_in(scene);
  const Vector3 velocity(feeder.velocity[0], feeder.velocity[1], feeder.velocity[2]);
  Lookout origin{feeder.name, down && velocity.cross(*down).norm() <= 1e-12 * velocity.norm()};
  const auto& [corner, size] = feeder.region;
  origin.grains.emplace_back(Point{corner[0] + size[0] / 2, corner[1] + size[1] / 2, corner[2] + size[2] / 2}, radius);
  for (unsigned i = 0; i < 8; ++i) {
    Point place = corner;
    for (unsigned axis = 0; axis < 3; ++axis) place[axis] += ((i >> axis) & 1U) != 0 ? size[axis] - radius : radius;
    origin.grains.emplace_back(place, radius);
  }
  return origin;
}

/// The directions in which a wall may support a grain: below and beside it; on all sides without gravity.
std::vector<Vector3> directions_of(const Scene& scene) {
  const std::optional<Vector3> gravity = down_in(scene);
  const Vector3 down = gravity.value_or(-Vector3::UnitZ());
  const Vector3 side = down.unitOrthogonal(), other = down.cross(side);
  std::vector<Vector3> directions = {down, side, -side, other, -other};
  if (!gravity) directions.emplace_back(-down);
  return directions;
}

void add_backs(const Sight& sight, const Scene& scene, const Lookout& origin, std::vector<std::string>& doubts) {
  std::map<const Wall*, std::size_t> counts;  // of grains, in the order of the scene's walls
  for (const auto& [place, radius] : origin.grains) {
    std::set<const Wall*> walls;
    for (const Vector3& direction : directions_of(scene)) {
      if (const Seen seen = sight.look(place, direction); seen.is_back) walls.insert(seen.wall);
    }
    for (const Wall* const wall : walls) ++counts[wall];
  }
  for (const auto& [wall, count] : counts) {
    doubts.push_back(wall->called() + ": " + origin.some(count) +
                     " behind a triangle, which does not hold them: a triangle is solid behind, and holds what sees its corners "
                     "anticlockwise; turn its corners around, or let part.two_sided = true hold grains on both sides");
  }
}

/// Points of a grain from which rays go down: its centre, and two circles around it. A grain may be caught far from its centre.
std::vector<Point> points_of(const Point& centre, double radius, const Vector3& down) {
  constexpr int kAround = 32;  // 16 miss 6 % of the grains on bars a tenth of a radius wide and 1.5 radii apart, 32 none
  std::vector<Point> points = {centre};
  const Vector3 side = down.unitOrthogonal(), other = down.cross(side);
  for (int i = 0; i < 2 * kAround; ++i) {
    const double angle = std::numbers::pi * i / kAround;
    const Vector3 to = (i % 2 == 0 ? radius : radius / 2) * (std::cos(angle) * side + std::sin(angle) * other);
    points.push_back({centre[0] + to.x(), centre[1] + to.y(), centre[2] + to.z()});
  }
  return points;
}

void add_void(const Sight& sight, const Scene& scene, const Lookout& origin, std::vector<std::string>& doubts) {
  const std::optional<Vector3> down = down_in(scene);
  if (!down || !origin.falls) return;
  const auto lands = [&](const Point& point) {
    const Seen below = sight.look(point, *down);
    const double way = std::max(0.0, below.distance - scene.smallest_half_axis());
    return !below.is_nothing() &&
           is_inside(scene, {point[0] + way * down->x(), point[1] + way * down->y(), point[2] + way * down->z()});
  };
  const auto lost = static_cast<std::size_t>(std::ranges::count_if(
      origin.grains, [&](const auto& grain) { return std::ranges::none_of(points_of(grain.first, grain.second, *down), lands); }));
  if (lost == 0) return;
  const std::string they = origin.feeder.empty() && lost == 1 ? "it falls" : "they fall";
  doubts.push_back(origin.some(lost) + " above nothing: no wall, part or sink is below within the container, and " + they +
                   " out of it" + (lost < origin.grains.size() ? " unless other grains are in the way" : ""));
}

}  // namespace

void add_doubts_about_leaks(const Scene& scene, std::vector<std::string>& doubts) {
  if (std::holds_alternative<Periodic>(scene.container)) return;
  const World world(scene, std::vector<Placement>{});
  const Sight sight(world);
  std::vector<Lookout> origins = {start_of(scene)};
  for (const Feeder& feeder : scene.feeders) origins.push_back(origin_of(feeder, scene));
  for (const Lookout& origin : origins) {
    add_void(sight, scene, origin, doubts);
    add_backs(sight, scene, origin, doubts);
  }
}

}  // namespace falling_particles
