#include "wall.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <supernormal/shapes/box.hpp>
#include <supernormal/shapes/cylinder.hpp>
#include <supernormal/shapes/superovoid.hpp>
#include <utility>

namespace falling_particles {
namespace {

double radius_of(const PlaneShape& /*plane*/) { return INFINITY; }
double radius_of(const GroundShape& /*ground*/) { return INFINITY; }
double radius_of(const BoxShape& box) { return box.size.norm() / 2; }
double radius_of(const CylinderShape& cylinder) { return std::hypot(cylinder.radius, cylinder.length / 2); }
double radius_of(const SmoothShape& body) {
  const double widest = 1 + std::max(std::abs(body.taper_x), std::abs(body.taper_y));
  return Vector3(widest * body.half_axes.x(), widest * body.half_axes.y(), body.half_axes.z()).norm();
}
double radius_of(const MeshShape& mesh) {
  double radius = 0;
  for (const auto& [x, y, z] : mesh.vertices) radius = std::max(radius, Vector3(x, y, z).norm());
  return radius;
}

/// Whether each edge of each triangle is the edge of one other triangle, in the other direction.
bool is_closed(const Mesh& mesh) {
  std::map<std::pair<unsigned int, unsigned int>, int> edges;
  for (const auto& [a, b, c] : mesh.triangles) {
    for (const auto& edge : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) ++edges[edge];
  }
  return std::ranges::all_of(edges, [&](const auto& entry) {
    const auto back = edges.find({entry.first.second, entry.first.first});
    return entry.second == 1 && back != edges.end();
  });
}

/// The sum over the tetrahedra from the origin to the triangles.
supernormal::MassProperties sum_of(const Mesh& mesh) {
  supernormal::MassProperties sum;
  const auto corner = [&](unsigned int index) {
    const auto& [x, y, z] = mesh.vertices[index];
    return Vector3(x, y, z);
  };
  Vector3 first_moment = Vector3::Zero();
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vector3 a = corner(i), b = corner(j), c = corner(k), s = a + b + c;
    const double volume = a.dot(b.cross(c)) / 6;
    sum.volume += volume;
    first_moment += volume / 4 * s;
    sum.second_moment += volume / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
  }
  sum.centroid = first_moment / sum.volume;
  return sum;
}

/// A face and its unit normal, towards the grains.
struct Face {
  Vector3 normal;
  Vector3 point;  // m
};

std::vector<Face> faces_of(const WallShape& shape, const WallPose& pose) {
  if (const auto* plane = std::get_if<PlaneShape>(&shape)) return {{pose.rotation * plane->normal, pose.position}};
  std::vector<Face> faces;
  if (const auto* box = std::get_if<BoxShape>(&shape)) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const Vector3 normal = pose.rotation * Vector3::Unit(axis);
      for (const double side : {-1.0, 1.0}) faces.push_back({side * normal, pose.position + side * box->size[axis] / 2 * normal});
    }
  }
  return faces;
}

namespace fx = supernormal::effects;

bool has_own_material(const Wall& wall) { return wall.friction.has_value() || wall.restitution.has_value(); }

/// The effect that the scene names for grains on walls.
template <typename E>
std::optional<E> of_walls(const std::vector<fx::Effect>& effects) {
  for (const fx::Effect& effect : effects) {
    const E* found = std::get_if<E>(&effect);
    if (found != nullptr && found->on == kGrainOnWall) return *found;
  }
  return std::nullopt;
}

/// The threshold of the restitution that the scene names; all contacts share it.
double threshold_of(const std::vector<fx::Effect>& effects) {
  for (const fx::Effect& effect : effects) {
    if (const auto* found = std::get_if<fx::Restitution>(&effect)) return found->threshold;
  }
  return 0;
}

}  // namespace

std::string Wall::called() const { return (is_of_container ? "wall \"" : "part \"") + name + '"'; }

std::string Wall::key() const { return is_of_container ? "container." + name : "part"; }

std::vector<std::string> names_of(std::span<const Wall> walls) {
  std::vector<std::string> names;
  std::ranges::transform(walls, std::back_inserter(names), &Wall::name);
  return names;
}

double bounding_radius(const WallShape& shape) {
  return std::visit([](const auto& kind) { return radius_of(kind); }, shape);
}

double thinnest(const WallShape& shape) {
  if (const auto* box = std::get_if<BoxShape>(&shape)) return box->size.minCoeff();
  if (const auto* cylinder = std::get_if<CylinderShape>(&shape)) return std::min(cylinder->radius, cylinder->length);
  if (const auto* body = std::get_if<SmoothShape>(&shape)) return body->half_axes.minCoeff();
  return INFINITY;
}

std::optional<supernormal::MassProperties> solid_of(const WallShape& shape) {
  if (const auto* box = std::get_if<BoxShape>(&shape)) return supernormal::Box(box->size / 2).mass_properties();
  if (const auto* cylinder = std::get_if<CylinderShape>(&shape)) {
    return supernormal::Cylinder(cylinder->radius, cylinder->length / 2).mass_properties();
  }
  if (const auto* body = std::get_if<SmoothShape>(&shape)) {
    return supernormal::Superovoid(body->half_axes, body->delta, body->epsilon, body->taper_x, body->taper_y).mass_properties();
  }
  const auto* mesh = std::get_if<MeshShape>(&shape);
  if (mesh == nullptr || mesh->two_sided || !is_closed(*mesh)) return std::nullopt;
  const supernormal::MassProperties solid = sum_of(*mesh);
  return solid.volume > 0 ? std::optional(solid) : std::nullopt;
}

std::optional<FacingFaces> facing_faces(const WallShape& first, const WallPose& at_first, const WallShape& second,
                                        const WallPose& at_second) {
  constexpr double kParallel = 1e-9;  // of the product of two unit normals: rounding of poses
  std::optional<FacingFaces> found;
  for (const Face& one : faces_of(first, at_first)) {
    for (const Face& two : faces_of(second, at_second)) {
      if (one.normal.dot(two.normal) > kParallel - 1) continue;
      const FacingFaces faces{one.normal, one.normal.dot(one.point), one.normal.dot(two.point)};
      if (!found || faces.distance() > found->distance()) found = faces;
    }
  }
  return found;
}

fx::Material material_of_wall(const std::vector<Wall>& walls, std::size_t index) {
  if (!has_own_material(walls[index])) return kWallMaterial;
  fx::Material material = kWallMaterial;
  for (std::size_t i = 0; i <= index; ++i) material += has_own_material(walls[i]) ? 1 : 0;
  return material;
}

void add_wall_effects(const std::vector<Wall>& walls, std::vector<fx::Effect>& effects) {
  const std::optional<fx::Friction> friction = of_walls<fx::Friction>(effects);
  const std::optional<fx::Restitution> restitution = of_walls<fx::Restitution>(effects);
  const double threshold = threshold_of(effects);
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (!has_own_material(walls[i])) continue;
    const auto on = fx::MaterialSelector::between(kGrainMaterial, material_of_wall(walls, i));
    if (walls[i].friction || friction)
      effects.emplace_back(fx::Friction{walls[i].friction.value_or(friction ? friction->coefficient : 0), on});
    if (walls[i].restitution || restitution) {
      effects.emplace_back(
          fx::Restitution{walls[i].restitution.value_or(restitution ? restitution->coefficient : 0), threshold, on});
    }
  }
}

void WallDoubts::add(const std::string& kind, const Wall& wall, double excess, const std::string& text) {
  const auto found = std::ranges::find(kinds_, kind, [](const auto& doubts) { return doubts.front().kind; });
  std::vector<Doubt>& doubts = found == kinds_.end() ? kinds_.emplace_back() : *found;
  doubts.push_back({kind, wall.name, excess, wall.called() + text});
}

void WallDoubts::tell(std::vector<std::string>& doubts) const {
  for (const std::vector<Doubt>& kind : kinds_) {
    const auto worst = std::ranges::max_element(kind, {}, &Doubt::excess);
    std::string others;
    for (const Doubt& doubt : kind) {
      if (&doubt != &*worst) others += (others.empty() ? "; the same holds for \"" : ", \"") + doubt.wall + '"';
    }
    doubts.push_back(worst->sentence + others);
  }
}

}  // namespace falling_particles
