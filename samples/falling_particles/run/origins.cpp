// Doubts about the positions at which the grains of a scene start.

#include <supernormal/supernormal.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <variant>

#include "common/interval.hpp"
#include "doubts.hpp"
#include "model/wall_doubts.hpp"
#include "sight.hpp"
#include "world/free_places.hpp"
#include "world/placement.hpp"
#include "world/world.hpp"

namespace falling_particles {
namespace {

/// Positions of grains of the start or of a feeder, from which rays are cast.
struct Lookout {
  std::string name;  // of a feeder; empty for the start
  std::vector<Point> places;
  std::vector<double> radii;  // m, bounding radii of the grains at these places
  bool falls;                 // straight down, under gravity

  std::string grains(std::size_t count) const {
    if (!name.empty()) return (count < places.size() ? "some grains" : "grains") + (" that feeder \"" + name) + "\" brings are";
    return std::to_string(count) + " of " + counted(places.size(), "grain") + (count == 1 ? " starts" : " start");
  }
};

Lookout start_of(const Scene& scene) {
  Random random(scene.seed);
  // Bonds to a part may hold the grains.
  Lookout origin{"", {}, {}, std::ranges::none_of(scene.bonds, [](const BondRule& rule) { return rule.wall.has_value(); })};
  for (const Placement& placement : place(scene, random)) {
    constexpr std::size_t kEnough = 1000;  // the placements are in random order
    if (origin.places.size() == kEnough) break;
    origin.places.push_back(placement.position);
    origin.radii.push_back(placement.scale * scene.kinds[placement.kind].kind.bounding_radius());
  }
  return origin;
}

/// The unit vector of gravity; empty without gravity.
std::optional<Vector3> down_in(const Scene& scene) {
  const auto* const gravity = scene.gravity();
  if (gravity == nullptr || gravity->acceleration.isZero(0)) return std::nullopt;
  return gravity->acceleration.stableNormalized();
}

double smallest_radius(const Feeder& feeder, const Scene& scene) {
  double least = INFINITY;
  for (const FedKind& fed : feeder.mixture) {
    const GrainCount& entry = scene.kinds[fed.kind];
    least = std::min(least, entry.smallest_scale() * entry.kind.bounding_radius());
  }
  return least;
}

/// The outermost centres of grains in the feeder's region, and its middle.
Lookout origin_of(const Feeder& feeder, const Scene& scene) {
  Lookout origin{feeder.name, {}, {}, true};
  const double radius = smallest_radius(feeder, scene);
  const auto& [corner, size] = feeder.region;
  origin.places.push_back({corner[0] + size[0] / 2, corner[1] + size[1] / 2, corner[2] + size[2] / 2});
  for (unsigned i = 0; i < 8; ++i) {
    Point& place = origin.places.emplace_back(corner);
    for (unsigned axis = 0; axis < 3; ++axis) place[axis] += ((i >> axis) & 1U) != 0 ? size[axis] - radius : radius;
  }
  origin.radii.assign(origin.places.size(), radius);
  const std::optional<Vector3> down = down_in(scene);
  const Vector3 velocity(feeder.velocity[0], feeder.velocity[1], feeder.velocity[2]);
  origin.falls = down && velocity.cross(*down).norm() <= 1e-12 * velocity.norm();
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
  std::map<std::size_t, std::size_t> counts;  // of positions, by wall
  for (const Point& place : origin.places) {
    std::set<std::size_t> walls;
    for (const Vector3& direction : directions_of(scene)) {
      if (const auto seen = sight.look(place, direction); seen && seen->is_back) walls.insert(*seen->wall);
    }
    for (const std::size_t wall : walls) ++counts[wall];
  }
  for (const auto& [wall, count] : counts) {
    doubts.push_back(scene.walls[wall].called() + ": " + origin.grains(count) +
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
  if (!down || !origin.falls || origin.places.empty()) return;
  const auto lands = [&](const Point& point) {
    const std::optional<Sight::Seen> below = sight.look(point, *down);
    if (!below) return false;
    const double way = std::max(0.0, below->distance - scene.smallest_half_axis());
    return is_inside(scene, {point[0] + way * down->x(), point[1] + way * down->y(), point[2] + way * down->z()});
  };
  std::size_t lost = 0;
  for (std::size_t i = 0; i < origin.places.size(); ++i) {
    if (std::ranges::none_of(points_of(origin.places[i], origin.radii[i], *down), lands)) ++lost;
  }
  if (lost == 0) return;
  const std::string they = origin.name.empty() && lost == 1 ? "it falls" : "they fall";
  doubts.push_back(origin.grains(lost) + " above nothing: no wall, part or sink is below within the container, and " + they +
                   " out of it" + (lost < origin.places.size() ? " unless other grains are in the way" : ""));
}

void add_sunk(const Scene& scene, const Lookout& origin, std::vector<std::string>& doubts) {
  const auto is_in_sink = [&](const Point& place) {
    return std::ranges::any_of(scene.sinks, [&](const Sink& sink) { return sink.contains(place); });
  };
  if (origin.places.empty() || !std::ranges::all_of(origin.places, is_in_sink)) return;
  doubts.push_back(origin.grains(origin.places.size()) + " within sinks, which take them at once");
}

/// Adds doubts about walls that stand outside a box, whose walls are infinitely high. (A periodic box is left out, since it has
/// images of its walls.)
void add_unreached(const World& world, std::vector<std::string>& doubts) {
  const Scene& scene = world.scene();
  const auto* const box = std::get_if<Box>(&scene.container);
  if (box == nullptr || is_any(scene.periodic)) return;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    if (!scene.walls[i].is_part() || scene.walls[i].moves()) continue;
    dReal aabb[6];
    dGeomGetAABB(world.walls().geoms()[i], aabb);
    const auto& [x, y] = box->width;
    if (aabb[1] > 0 && aabb[0] < x && aabb[3] > 0 && aabb[2] < y && aabb[5] > 0) continue;
    doubts.push_back(scene.walls[i].called() + " stands outside the box of the container, where no grain meets it");
  }
}

/// m along the axis of a drive: of the middle of its wall at the start, or of a plane.
double middle_along(const Wall& wall, dGeomID geom) {
  if (std::holds_alternative<PlaneShape>(wall.shape)) return wall.drive->axis.dot(wall.start.position);
  dReal box[6];
  dGeomGetAABB(geom, box);
  return wall.drive->axis.dot(Vector3(box[0] + box[1], box[2] + box[3], box[4] + box[5]) / 2);
}

/// Whether grains come somewhere, and none of them ahead of a driven wall. `sign`: -1 for the direction against its axis.
bool leaves_all(const Wall& wall, double sign, dGeomID geom, const std::vector<Lookout>& origins) {
  const Vector3 direction = sign * wall.drive->axis;
  const double middle = sign * middle_along(wall, geom);
  const auto is_ahead = [&](const Point& place) { return direction.dot(Vector3(place[0], place[1], place[2])) > middle; };
  return std::ranges::any_of(origins, [](const Lookout& origin) { return !origin.places.empty(); }) &&
         std::ranges::none_of(origins, [&](const Lookout& origin) { return std::ranges::any_of(origin.places, is_ahead); });
}

/// Adds a doubt about the servo of a plane whose axis is another one than its normal.
void add_oblique(const Wall& wall, std::vector<std::string>& doubts) {
  constexpr double kTyped = 1e-4;  // 1 - cosine: 0.8 degrees, for normals of three digits
  const auto* const plane = std::get_if<PlaneShape>(&wall.shape);
  if (plane == nullptr) return;
  const Vector3 normal = wall.start.rotation * plane->normal;
  if (wall.drive->axis.dot(normal) > 1 - kTyped) return;
  doubts.push_back(wall.called() + " is a servo whose axis is not the normal of its plane: " + wall.key() +
                   ".drive.stress is the force along the axis over the area, and no normal stress; " + wall.key() +
                   ".drive.axis = [" + rounded(normal.x()) + ", " + rounded(normal.y()) + ", " + rounded(normal.z()) +
                   "] would do");
}

/// Adds doubts about servos that leave all grains behind, or that press another way than their planes.
void add_servos(const World& world, const std::vector<Lookout>& origins, std::vector<std::string>& doubts) {
  const std::vector<Wall>& walls = world.scene().walls;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (!walls[i].drive || !walls[i].drive->servo) continue;
    if (!leaves_all(walls[i], 1, world.walls().geoms()[i], origins)) {
      add_oblique(walls[i], doubts);
      continue;
    }
    const Vector3& axis = walls[i].drive->axis;
    const auto against = [&](int k) { return rounded(0.0 - axis[k]); };
    doubts.push_back(walls[i].called() +
                     " is a servo whose axis points away from all grains at the start: it presses none, and leaves; " +
                     walls[i].key() + ".drive.axis = [" + against(0) + ", " + against(1) + ", " + against(2) + "] would do");
  }
}

/// Whether a box that moves along a direction meets another one. Both are pairs of ends along x, y and z, as of dGeomGetAABB().
bool meets(const dReal* moving, const dReal* other, const Vector3& direction) {
  double enter = 0, leave = INFINITY;  // m of the way
  for (int axis = 0; axis < 3; ++axis) {
    const double near = other[2 * axis] - moving[2 * axis + 1], far = other[2 * axis + 1] - moving[2 * axis];
    const double along = direction[axis];
    if (along == 0) {
      if (near > 0 || far < 0) return false;
      continue;
    }
    enter = std::max(enter, std::min(near / along, far / along));
    leave = std::min(leave, std::max(near / along, far / along));
  }
  return enter <= leave;
}

/// Whether a free wall may fall on another one. Of both, the boxes around them count.
bool may_land(const World& world, std::size_t free, const Vector3& down) {
  const std::vector<dGeomID>& geoms = world.walls().geoms();
  dReal box[6], other[6];
  dGeomGetAABB(geoms[free], box);
  for (std::size_t i = 0; i < geoms.size(); ++i) {
    if (i == free) continue;
    dVector4 plane;
    if (dGeomGetClass(geoms[i]) == dPlaneClass) {
      dGeomPlaneGetParams(geoms[i], plane);
      if (down.dot(Vector3(plane[0], plane[1], plane[2])) < 0) return true;
      continue;
    }
    dGeomGetAABB(geoms[i], other);
    if (meets(box, other, down)) return true;
  }
  return false;
}

/// Adds doubts about walls that fall for ever: free ones above nothing, and driven ones that have neither a grain below them nor an
/// end of their travel. These pass through other walls.
void add_falling(const World& world, const std::vector<Lookout>& origins, std::vector<std::string>& doubts) {
  const Scene& scene = world.scene();
  const std::optional<Vector3> down = down_in(scene);
  if (!down) return;
  const double gravity = scene.gravity()->acceleration.norm();
  WallDoubts of_walls;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const Wall& wall = scene.walls[i];
    if (wall.flight && wall.flight->from < scene.time.duration) {
      const Vector3& velocity = wall.flight->velocity.linear;
      const bool falls = velocity.cross(*down).norm() <= 1e-12 * velocity.norm();
      if (falls && !may_land(world, i, *down)) {
        of_walls.add("free", wall, 0,
                     " is free above nothing: no wall is below it, and it falls for ever; a wall below it would do");
      }
    }
    if (!wall.drive || wall.drive->servo || wall.drive->turns() || wall.drive->from >= scene.time.duration) continue;
    const Drive& drive = *wall.drive;
    const double sign = drive.axis.dot(*down) < 0 ? -1 : 1;
    const double push = sign * drive.force + drive.mass * gravity * std::abs(drive.axis.dot(*down));  // N, downwards
    const bool has_end = std::isfinite(sign < 0 ? drive.travel[0] : drive.travel[1]);
    if (!(push > 0) || drive.axis.dot(*down) == 0 || has_end || !leaves_all(wall, sign, world.walls().geoms()[i], origins))
      continue;
    of_walls.add(
        "driven", wall, push,
        " falls for ever: no grain is below it, and no wall stops a wall that is driven; " + wall.key() + ".drive.travel would do");
  }
  of_walls.tell(doubts);
}

/// m along the axis of a drive: of the foremost point of its wall at the start, or of a plane.
double front_along(const Wall& wall, dGeomID geom) {
  const Vector3& axis = wall.drive->axis;
  if (std::holds_alternative<PlaneShape>(wall.shape)) return axis.dot(wall.start.position);
  dReal box[6];
  dGeomGetAABB(geom, box);
  double front = 0;
  for (int i = 0; i < 3; ++i) front += axis[i] * box[2 * i + (axis[i] > 0 ? 1 : 0)];
  return front;
}

/// m/s, of a wall that slides from rest, without grains.
double speed_after(double way, const Drive& drive, const Vector3& gravity) {
  const double force = drive.force + drive.mass * gravity.dot(drive.axis);
  double speed = std::sqrt(2 * std::max(0.0, force) / drive.mass * way);
  if (drive.damping > 0) speed = std::min(speed, force / drive.damping);
  if (drive.power > 0) speed = std::min(speed, std::cbrt(3 * drive.power * way / drive.mass));
  return speed;
}

/// Adds doubts about walls that become so fast before they meet a grain that they may jump over it.
void add_fast(const World& world, const std::vector<Lookout>& origins, std::vector<std::string>& doubts) {
  const Scene& scene = world.scene();
  if (scene.looks_ahead()) return;
  WallDoubts of_walls;
  const Vector3 gravity = scene.gravity() == nullptr ? Vector3::Zero() : scene.gravity()->acceleration;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const Wall& wall = scene.walls[i];
    if (!wall.drive || wall.drive->servo || wall.drive->turns()) continue;
    if (first_way_of(wall, scene.time.step) > scene.smallest_half_axis()) continue;  // a doubt of its own
    const double front = front_along(wall, world.walls().geoms()[i]) + scene.largest_bounding_radius();
    double way = INFINITY;
    for (const Lookout& origin : origins) {
      for (const Point& place : origin.places) {
        const double ahead = wall.drive->axis.dot(Vector3(place[0], place[1], place[2])) - front;
        if (ahead > 0) way = std::min(way, ahead);
      }
    }
    way = std::min(way, wall.drive->travel[1]);
    const double speed = std::isfinite(way) ? speed_after(way, *wall.drive, gravity) : 0;
    if (!(speed * scene.time.step > scene.smallest_half_axis())) continue;
    of_walls.add(
        "fast", wall, speed,
        moves_too_far(" is driven up to the first grain with " + rounded(speed) + " m/s,", speed * scene.time.step, scene) +
            "time.step up to " + rounded(scene.smallest_half_axis() / speed) + " s would do");
  }
  of_walls.tell(doubts);
}

std::string name_of(dGeomID solid, const World& world) {
  const Wall* wall = world.walls().wall_of(solid);
  return wall != nullptr && wall->is_part() ? wall->called() : "the container";
}

/// The names of the solids that obstruct a grain at many random places; none if one place is free.
std::set<std::string> names_in_the_way(const Feeder& feeder, std::size_t kind, const World& world) {
  constexpr int kTries = 512;  // in a region that is free to a hundredth, all fail once in 170 cases
  const GrainCount& fed = world.scene().kinds[kind];
  const Candidate candidate(fed.kind, fed.smallest_scale());
  const Neighbourhood walls(world, feeder.region);
  Random random(world.scene().seed);
  std::set<std::string> found;
  for (int i = 0; i < kTries; ++i) {
    candidate.put(random_place(feeder.region, kind, candidate.grain().scale, candidate.grain().bounding_radius(), random));
    const auto find = [&](dGeomID geom) { return walls.find_overlap(geom); };
    const auto blocked = std::ranges::find_if(candidate.geoms(), find);
    if (blocked == candidate.geoms().end()) return {};
    found.insert(name_of(find(*blocked), world));
  }
  return found;
}

/// Adds a doubt about a feeder whose region is full at the start. Returns whether it is.
bool add_full(const World& world, const Feeder& feeder, std::vector<std::string>& doubts) {
  for (const FedKind& fed : feeder.mixture) {
    std::string names;
    for (const std::string& name : names_in_the_way(feeder, fed.kind, world)) names += (names.empty() ? "" : ", ") + name;
    if (names.empty()) continue;
    doubts.push_back("feeder \"" + feeder.name + "\" has no room for grain \"" + world.scene().kinds[fed.kind].kind.name +
                     "\" at the start: " + names + " is wherever it would come");
    return true;
  }
  return false;
}

}  // namespace

std::vector<std::string> doubts_about_origins(const Scene& scene) {
  std::vector<std::string> doubts;
  if (std::holds_alternative<Periodic>(scene.container)) return doubts;
  const World world(scene, std::vector<Placement>{});
  const Sight sight(world);
  std::vector<Lookout> origins = {start_of(scene)};
  for (const Feeder& feeder : scene.feeders) {
    if (!add_full(world, feeder, doubts)) origins.push_back(origin_of(feeder, scene));
  }
  for (const Lookout& origin : origins) {
    add_sunk(scene, origin, doubts);
    add_void(sight, scene, origin, doubts);
    add_backs(sight, scene, origin, doubts);
  }
  add_unreached(world, doubts);
  add_servos(world, origins, doubts);
  add_falling(world, origins, doubts);
  add_fast(world, origins, doubts);
  return doubts;
}

}  // namespace falling_particles
