#include "leaks.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <variant>

#include "common/interval.hpp"
#include "world/grain.hpp"

namespace falling_particles {
namespace {

std::string in_brackets(std::span<const double> numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "[" : ", ") + shortest(number);
  return text + "]";
}

Leak leak_of(const Grain& grain, std::size_t index, double time) {
  return {time, index, grain.kind->name, grain.position(), grain.quaternion(), grain.velocity()};
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// m, where a solid begins and ends along a direction.
struct Extent {
  double from = kInfinity;
  double to = -kInfinity;

  void add(const Extent& other) {
    from = std::min(from, other.from);
    to = std::max(to, other.to);
  }
};

/// A half-space below a plane stops all falls towards it.
Extent extent_of_half_space(const Vector3& normal, const Vector3& down) {
  return normal.dot(down) < 0 ? Extent{-kInfinity, kInfinity} : Extent{};
}

Extent extent_of_box(const Vector3& lower, const Vector3& upper, const Vector3& down) {
  const Vector3 a = lower.cwiseProduct(down), b = upper.cwiseProduct(down);
  return {a.cwiseMin(b).sum(), a.cwiseMax(b).sum()};
}

Extent extent_of(dGeomID wall, const Vector3& down) {
  if (dGeomGetClass(wall) == dPlaneClass) {
    dVector4 plane;
    dGeomPlaneGetParams(wall, plane);
    return extent_of_half_space(to_vector(plane), down);
  }
  const Aabb box = aabb_of(wall);
  return extent_of_box({box[0], box[2], box[4]}, {box[1], box[3], box[5]}, down);
}

Extent extent_of(const Sink& sink, const Vector3& down) {
  if (const auto* const below = std::get_if<HalfSpace>(&sink.region)) {
    return extent_of_half_space(to_vector(below->normal), down);
  }
  const auto& [corner, size] = std::get<Region>(sink.region);
  return extent_of_box(to_vector(corner), to_vector(corner) + to_vector(size), down);
}

}  // namespace

Inside::Inside(const World& world) : scene_(world.scene()), bottom_(kInfinity) {
  for (const dGeomID wall : world.walls().geoms()) {
    if (dGeomGetClass(wall) != dPlaneClass || !world.walls().wall_of(wall)->is_part()) continue;
    dVector4 plane;
    dGeomPlaneGetParams(wall, plane);
    planes_.push_back({plane[0], plane[1], plane[2], plane[3]});
  }
  const auto* const gravity = scene_.gravity();
  if (gravity == nullptr || gravity->acceleration.isZero(0) || !is_open(scene_.container)) return;
  down_ = gravity->acceleration.stableNormalized();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (scene_.periodic[static_cast<std::size_t>(axis)] && down_[axis] != 0) return;  // a fall comes back
  }
  bottom_ = bottom_of(world);
}

// A free wall stops grains as long as it does not fall past all other walls itself.
double Inside::bottom_of(const World& world) const {
  Extent held;
  std::vector<Extent> flying;
  for (const Sink& sink : scene_.sinks) held.add(extent_of(sink, down_));
  for (const dGeomID geom : world.walls().geoms()) {
    const Extent extent = extent_of(geom, down_);
    const bool flies = world.walls().wall_of(geom)->flight && world.walls().is_moving(geom);
    flies ? flying.push_back(extent) : held.add(extent);
  }
  double bottom = held.to;
  for (const Extent& extent : flying) {
    if (extent.from <= held.to) bottom = std::max(bottom, extent.to);
  }
  return bottom;
}

bool Inside::contains(const Point& position, double reach) const {
  if (!is_inside(scene_, position)) return false;
  const auto is_behind = [&](const std::array<dReal, 4>& plane) {
    return plane[0] * position[0] + plane[1] * position[1] + plane[2] * position[2] < plane[3];
  };
  const auto takes = [&](const Sink& sink) { return sink.contains(position); };
  if (std::ranges::any_of(planes_, is_behind) && std::ranges::none_of(scene_.sinks, takes)) return false;
  return down_.dot(to_vector(position)) - reach <= bottom_;
}

double Inside::reach_of(dGeomID wall) const {
  const auto [from, to] = extent_of(wall, down_);
  return (to - from) / 2;
}

std::string describe(const Leak& leak) {
  return "grain " + std::to_string(leak.grain) + " (" + leak.kind + ") left the container at t = " + shortest(leak.time) +
         " s: position " + in_brackets(leak.position) + " m, quaternion " + in_brackets(leak.quaternion) + ", velocity " +
         in_brackets(leak.velocity) + " m/s";
}

std::vector<std::string> free_walls_outside(const World& world) {
  const Inside inside(world);
  std::vector<std::string> sentences;
  for (const dGeomID geom : world.walls().geoms()) {
    const Wall& wall = *world.walls().wall_of(geom);
    if (!wall.flight) continue;
    const Aabb box = aabb_of(geom);
    const Point middle = {(box[0] + box[1]) / 2, (box[2] + box[3]) / 2, (box[4] + box[5]) / 2};
    if (inside.contains(middle, inside.reach_of(geom))) continue;
    sentences.push_back(wall.called() + " has left the container: its middle is at " + in_brackets(middle) + " m");
  }
  return sentences;
}

LeakWatch::LeakWatch(const World& world) : world_(world), has_leaked_(world.grains().size(), false) {}

void LeakWatch::after_step(double time) {
  has_leaked_.resize(world_.grains().size(), false);
  const Inside inside(world_);
  for (const Grain& grain : world_.present()) {
    const std::size_t i = world_.index_of(grain);
    if (has_leaked_[i] || inside.contains(grain.position(), grain.bounding_radius())) continue;
    has_leaked_[i] = true;
    ++count_;
    if (!first_) first_ = leak_of(grain, i, time);
  }
}

}  // namespace falling_particles
