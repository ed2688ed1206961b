#include "hopper.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace falling_particles {
namespace {

double angle_of(int side, int segments) { return 2 * std::numbers::pi * side / segments; }

/// Appends a horizontal ring of vertices, midway between the directions of the sides.
void append_ring(Mesh& mesh, int segments, double radius, double z) {
  const double to_corner = radius / std::cos(std::numbers::pi / segments);
  for (int side = 0; side < segments; ++side) {
    const double angle = angle_of(side, segments) - std::numbers::pi / segments;
    mesh.vertices.push_back(
        {static_cast<float>(to_corner * std::cos(angle)), static_cast<float>(to_corner * std::sin(angle)), static_cast<float>(z)});
  }
}

/// Appends the band between two successive rings, seen from inside.
void append_band(Mesh& mesh, unsigned int segments, unsigned int lower_ring) {
  const unsigned int lower = lower_ring * segments;
  const unsigned int upper = lower + segments;
  for (unsigned int i = 0; i < segments; ++i) {
    const unsigned int next = (i + 1) % segments;
    mesh.triangles.push_back({lower + i, upper + i, upper + next});
    mesh.triangles.push_back({lower + i, upper + next, lower + next});
  }
}

struct ConeMoments {
  double volume = 0, first = 0;  // up to the constant factor of the polygon
};

/// Adds the volume from height a to b. The radius is linear there, so that Simpson's rule is exact.
void add_moments(const Hopper& hopper, double a, double b, ConeMoments& moments) {
  const double middle = (a + b) / 2;
  for (const auto& [height, weight] : std::array<std::array<double, 2>, 3>{{{a, 1}, {middle, 4}, {b, 1}}}) {
    const double radius = hopper.radius_at(hopper.clearance + height);
    moments.volume += (b - a) / 6 * weight * radius * radius;
    moments.first += (b - a) / 6 * weight * radius * radius * height;
  }
}

}  // namespace

double Hopper::cone_height() const { return (diameter - outlet) / 2 / std::tan(wall_angle * std::numbers::pi / 180); }

double Hopper::top() const { return clearance + cone_height() + cylinder_height; }

double Hopper::radius_at(double z) const {
  const double share = (z - clearance) / cone_height();
  return share < 1 ? std::lerp(outlet, diameter, share) / 2 : diameter / 2;
}

bool Hopper::is_within(double x, double y, double radius) const {
  const double side = std::round(std::atan2(y, x) / angle_of(1, segments));  // the nearest side
  const double angle = side * angle_of(1, segments);
  return x * std::cos(angle) + y * std::sin(angle) < radius;
}

bool Hopper::is_in_tray(const Point& p) const {
  if (!tray().contains(p[0], p[1]) || !(p[2] > 0 && p[2] < clearance)) return false;
  return !dish || p[2] > dish->height || !is_within(p[0], p[1], dish->outer_radius());
}

// A hopper does not narrow upwards. So the farthest corner of the cell's lower end from the axis decides.
bool Hopper::has_room(const Point& lower, const Point& size) const {
  const double x = std::max(std::abs(lower[0]), std::abs(lower[0] + size[0]));
  const double y = std::max(std::abs(lower[1]), std::abs(lower[1] + size[1]));
  return std::hypot(x, y) <= radius_at(lower[2]);
}

double Hopper::mean_height(double level) const {
  const double height = level - clearance;
  const double in_cone = std::fmin(height, cone_height());
  ConeMoments moments;
  add_moments(*this, 0, in_cone, moments);
  if (height > in_cone) add_moments(*this, in_cone, height, moments);
  return moments.first / moments.volume;
}

Region Hopper::room() const {
  const double half = std::max(tray_width, diameter / std::cos(angle_of(1, segments) / 2)) / 2;
  return {{-half, -half, 0}, {2 * half, 2 * half, INFINITY}};
}

bool Hopper::contains(const Point& p) const {
  if (!(p[2] >= clearance)) return is_in_tray(p);
  return p[2] < INFINITY && is_within(p[0], p[1], radius_at(p[2]));
}

Mesh make_mesh(const Hopper& hopper) {
  Mesh mesh;
  append_ring(mesh, hopper.segments, hopper.outlet / 2, hopper.clearance);
  append_ring(mesh, hopper.segments, hopper.diameter / 2, hopper.clearance + hopper.cone_height());
  append_ring(mesh, hopper.segments, hopper.diameter / 2, hopper.top());
  append_band(mesh, static_cast<unsigned int>(hopper.segments), 0);
  append_band(mesh, static_cast<unsigned int>(hopper.segments), 1);
  return mesh;
}

Mesh make_mesh(const Dish& dish, int segments) {
  Mesh mesh;
  const double inner = dish.diameter / 2;
  append_ring(mesh, segments, inner, dish.height);
  append_ring(mesh, segments, inner, dish.height + dish.rim);
  append_ring(mesh, segments, dish.outer_radius(), dish.height + dish.rim);
  append_ring(mesh, segments, dish.outer_radius(), 0);
  const auto sides = static_cast<unsigned int>(segments);
  for (unsigned int ring = 0; ring < 3; ++ring) append_band(mesh, sides, ring);
  const auto middle = static_cast<unsigned int>(mesh.vertices.size());
  mesh.vertices.push_back({0, 0, static_cast<float>(dish.height)});
  for (unsigned int i = 0; i < sides; ++i) mesh.triangles.push_back({middle, i, (i + 1) % sides});
  return mesh;
}

}  // namespace falling_particles
