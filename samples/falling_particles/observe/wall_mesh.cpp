#include "wall_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <supernormal/shapes/superovoid.hpp>
#include <supernormal/shapes/tessellation.hpp>
#include <utility>
#include <variant>

namespace falling_particles {
namespace {

constexpr double kChordError = 0.01;    // of the smallest half-axis
constexpr unsigned int kSegments = 64;  // of a circle
constexpr double kSharp = 0.87;         // cosine of 30 degrees between two triangles; if it is larger, their edge is not drawn

std::array<float, 3> vertex(const Vector3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

/// A prism between two polygons, anticlockwise from above; the lower corners come first.
Mesh prism(const std::vector<Vector3>& corners, double half_height) {
  Mesh mesh;
  const auto count = static_cast<unsigned int>(corners.size());
  for (const double z : {-half_height, half_height}) {
    for (const Vector3& corner : corners) mesh.vertices.push_back(vertex(corner + z * Vector3::UnitZ()));
  }
  for (unsigned int i = 0; i < count; ++i) {
    const unsigned int next = (i + 1) % count;
    mesh.triangles.push_back({i, next, next + count});
    mesh.triangles.push_back({i, next + count, i + count});
    if (i == 0 || next == 0) continue;
    mesh.triangles.push_back({0, next, i});
    mesh.triangles.push_back({count, i + count, next + count});
  }
  return mesh;
}

std::vector<Vector3> rectangle(double x, double y) {
  return {{-x / 2, -y / 2, 0}, {x / 2, -y / 2, 0}, {x / 2, y / 2, 0}, {-x / 2, y / 2, 0}};
}

std::vector<Vector3> circle(double radius) {
  std::vector<Vector3> corners;
  for (unsigned int i = 0; i < kSegments; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSegments;
    corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  return corners;
}

Vector3 corner_of(const Box3& box, int index) { return box.corner(static_cast<Box3::CornerType>(index)); }

/// The rectangle in the plane z = 0 of a frame on which a box stands.
std::vector<Vector3> below(const Box3& box, const WallPose& pose, const Eigen::Quaterniond& turn) {
  Eigen::AlignedBox2d shadow;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 there = turn.conjugate() * (pose.rotation.conjugate() * (corner_of(box, corner) - pose.position));
    shadow.extend(Eigen::Vector2d(there.head<2>()));
  }
  const Eigen::Vector2d centre = shadow.center(), size = shadow.sizes();
  std::vector<Vector3> corners = rectangle(size.x(), size.y());
  for (Vector3& corner : corners) corner.head<2>() += centre;
  return corners;
}

/// A grid of samples by samples points, and two triangles in each of its squares.
Mesh grid_of(unsigned int samples, const auto& point) {
  Mesh mesh;
  for (unsigned int j = 0; j < samples; ++j) {
    for (unsigned int i = 0; i < samples; ++i) {
      mesh.vertices.push_back(vertex(point(i, j)));
      if (i == 0 || j == 0) continue;
      const unsigned int highest = j * samples + i, lowest = highest - samples - 1;
      mesh.triangles.push_back({lowest, lowest + 1, highest});
      mesh.triangles.push_back({lowest, highest, highest - 1});
    }
  }
  return mesh;
}

struct Mesher {
  const Box3& region;
  const WallPose& pose;

  Mesh operator()(const PlaneShape& plane) const {
    Mesh mesh;
    const Eigen::Quaterniond turn = rotation_between(Vector3::UnitZ(), plane.normal);
    const std::vector<Vector3> outline = plane.shown_radius > 0 ? circle(plane.shown_radius) : below(region, pose, turn);
    for (const Vector3& corner : outline) mesh.vertices.push_back(vertex(turn * corner));
    for (unsigned int i = 2; i < outline.size(); ++i) mesh.triangles.push_back({0, i - 1, i});
    return mesh;
  }
  Mesh operator()(const BoxShape& box) const { return prism(rectangle(box.size.x(), box.size.y()), box.size.z() / 2); }
  Mesh operator()(const CylinderShape& cylinder) const { return prism(circle(cylinder.radius), cylinder.length / 2); }
  Mesh operator()(const SmoothShape& body) const {
    const supernormal::Superovoid shape(body.half_axes, body.delta, body.epsilon, body.taper_x, body.taper_y);
    const supernormal::Tessellation found = supernormal::tessellate(shape, kChordError * body.half_axes.minCoeff());
    Mesh mesh;
    for (const Vector3& point : found.points) mesh.vertices.push_back(vertex(point));
    for (const auto& [a, b, c] : found.triangles) mesh.triangles.push_back({a, b, c});
    return mesh;
  }
  Mesh operator()(const MeshShape& mesh) const { return {mesh.vertices, mesh.triangles}; }
  Mesh operator()(const GroundShape& ground) const {
    const auto samples = static_cast<unsigned int>(ground.samples);
    const auto place = [&](unsigned int index, std::size_t axis) { return (index - (samples - 1) / 2.0) * ground.spacing[axis]; };
    return grid_of(samples, [&](unsigned int i, unsigned int j) {
      return Vector3(place(i, 0), place(j, 1), ground.heights[std::size_t{j} * samples + i]);
    });
  }
};

Vector3 normal_of(const Mesh& mesh, const std::array<unsigned int, 3>& triangle) {
  const auto corner = [&](std::size_t i) {
    const auto& [x, y, z] = mesh.vertices[triangle[i]];
    return Vector3(x, y, z);
  };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
}

/// The edges that have one triangle only, or two triangles with an angle between them.
std::vector<std::array<unsigned int, 2>> sharp_edges(const Mesh& mesh) {
  std::map<std::array<unsigned int, 2>, std::vector<Vector3>> normals;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const unsigned int a = triangle[i], b = triangle[(i + 1) % 3];
      normals[{std::min(a, b), std::max(a, b)}].push_back(normal_of(mesh, triangle));
    }
  }
  std::vector<std::array<unsigned int, 2>> edges;
  for (const auto& [edge, sides] : normals) {
    if (sides.size() != 2 || sides[0].dot(sides[1]) < kSharp) edges.push_back(edge);
  }
  return edges;
}

using Role = WallPicture::Role;

std::array<float, 3> vertex(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

/// The corners of the plan at two heights, the lower ones first, anticlockwise from the lowest x and y.
std::vector<std::array<float, 3>> corners_of(const Rectangle& plan, double bottom, double top) {
  const auto [x, y] = plan.corner;
  const auto [dx, dy] = plan.width;
  std::vector<std::array<float, 3>> corners;
  for (const double z : {bottom, top}) {
    for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) corners.push_back(vertex(x + i * dx, y + j * dy, z));
  }
  return corners;
}

WallPicture floor_of(const Rectangle& plan, double z) {
  WallPicture wall{"floor", Role::Still, {corners_of(plan, z, z), {{0, 1, 2}, {0, 2, 3}}}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
  wall.mesh.vertices.resize(4);
  return wall;
}

WallPicture walls_around(const Rectangle& plan, double bottom, double top, const PeriodicAxes& periodic = {}) {
  WallPicture wall{"walls", Role::Still, {corners_of(plan, bottom, top), {}}, {}};
  for (unsigned int side = 0; side < 4; ++side) {
    const unsigned int next = (side + 1) % 4;
    if (periodic[(side + 1) % 2]) continue;                     // side 0 is across y
    wall.mesh.triangles.push_back({side, side + 4, next + 4});  // seen from inside
    wall.mesh.triangles.push_back({side, next + 4, next});
    wall.edges.push_back({side, side + 4});
    wall.edges.push_back({side + 4, next + 4});
  }
  return wall;
}

std::vector<WallPicture> pictures_of(const Box& box, double top, const PeriodicAxes& periodic = {}) {
  std::vector<WallPicture> walls = {floor_of(box.plan(), 0)};
  if (!periodic[0] || !periodic[1]) walls.push_back(walls_around(box.plan(), 0, top, periodic));
  return walls;
}

/// The edges of the first `rings` rings that make_mesh() stacks.
std::vector<std::array<unsigned int, 2>> ring_edges(int segments, unsigned int rings) {
  const auto sides = static_cast<unsigned int>(segments);
  std::vector<std::array<unsigned int, 2>> edges;
  for (unsigned int ring = 0; ring < rings; ++ring) {
    for (unsigned int side = 0; side < sides; ++side) edges.push_back({ring * sides + side, ring * sides + (side + 1) % sides});
  }
  return edges;
}

/// The part of the lid's plane that closes the outlet: the polygon of the hopper's lowest ring.
WallPicture lid_of(const Hopper& hopper) {
  WallPicture wall{"lid", Role::Lid, make_mesh(hopper), ring_edges(hopper.segments, 1)};
  wall.mesh.vertices.resize(static_cast<std::size_t>(hopper.segments));
  wall.mesh.triangles.clear();
  for (unsigned int side = 1; side + 1 < static_cast<unsigned int>(hopper.segments); ++side) {
    wall.mesh.triangles.push_back({0, side, side + 1});
  }
  return wall;
}

std::vector<WallPicture> pictures_of(const Hopper& hopper, double /*top*/) {
  const Rectangle tray = hopper.tray();
  std::vector<WallPicture> walls = {floor_of(tray, 0), walls_around(tray, 0, hopper.clearance), lid_of(hopper)};
  walls.push_back({"hopper", Role::Still, make_mesh(hopper), ring_edges(hopper.segments, 3)});
  if (hopper.dish) {
    walls.push_back({"dish", Role::Still, make_mesh(*hopper.dish, hopper.segments), ring_edges(hopper.segments, 4)});
  }
  return walls;
}

/// The ground between the walls: all samples but the outermost, which lie beyond the walls.
WallPicture ground_of(const Terrain& terrain) {
  const auto [dx, dy] = terrain.spacing();
  const auto point = [&, dx = dx, dy = dy](unsigned int i, unsigned int j) {
    return Vector3(i * dx, j * dy, terrain.sample(i + 1, j + 1));
  };
  return {"ground", Role::Still, grid_of(static_cast<unsigned int>(terrain.samples_per_side() - 2), point), {}};
}

std::vector<WallPicture> pictures_of(const Terrain& terrain, double top) {
  WallPicture ground = ground_of(terrain);
  const auto below = [](const auto& a, const auto& b) { return a[2] < b[2]; };
  const double lowest = std::ranges::min_element(ground.mesh.vertices, below)->at(2);
  return {std::move(ground), walls_around(terrain.plan(), lowest, top)};
}

std::vector<WallPicture> pictures_of(const Periodic&, double /*top*/) {
  WallPicture cell{"cell", Role::Cell, {corners_of({{0, 0}, {1, 1}}, 0, 1), {}}, {}};
  for (unsigned int side = 0; side < 4; ++side) {
    const unsigned int next = (side + 1) % 4;
    cell.edges.insert(cell.edges.end(), {{side, next}, {side, side + 4}, {side + 4, next + 4}});
  }
  return {std::move(cell)};
}

/// For containers whose walls are in Scene::walls.
std::vector<WallPicture> pictures_of(const auto&, double /*top*/) { return {}; }

}  // namespace

Box3 region_of_planes(Box3 contents, std::span<const Wall> walls) {
  constexpr double kAcross = 1e-6;  // rad; a plane that is tilted more bounds no side of the box
  const Vector3 size = contents.sizes();
  Vector3 least = contents.min() - size / 2, most = contents.max() + size / 2;
  for (const Wall& wall : walls) {
    const auto* const plane = std::get_if<PlaneShape>(&wall.shape);
    if (plane == nullptr) continue;
    const Vector3 normal = wall.start.rotation * plane->normal;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(normal[axis]) < 1 - kAcross * kAcross) continue;
      double& side = normal[axis] > 0 ? least[axis] : most[axis];
      const double place = wall.start.position[axis];
      if (std::abs(place - side) <= size.norm()) side = place;
    }
  }
  return {least.cwiseMin(most), least.cwiseMax(most)};
}

WallPicture picture_of(const Wall& wall, const Box3& region) {
  WallPicture picture{wall.name,
                      wall.moves() ? WallPicture::Role::Moving : WallPicture::Role::Still,
                      std::visit(Mesher{region, wall.start}, wall.shape),
                      {}};
  // Smooth bodies have no edges, however sharply their triangles bend.
  if (!std::holds_alternative<SmoothShape>(wall.shape)) picture.edges = sharp_edges(picture.mesh);
  const auto* const mesh = std::get_if<MeshShape>(&wall.shape);
  picture.two_sided = mesh != nullptr && mesh->two_sided;
  if (wall.moves()) return picture;
  for (auto& corner : picture.mesh.vertices) corner = vertex(wall.start(Vector3(corner[0], corner[1], corner[2])));
  return picture;
}

std::vector<SurfacePoint> surface_of(const Wall& wall, const Container& container) {
  const Rectangle plan = plan_of(container);
  const Vector3 half = Vector3::Constant(std::hypot(plan.width[0], plan.width[1]) / 2);
  const Mesh mesh = picture_of(wall, {wall.start.position - half, wall.start.position + half}).mesh;
  const auto corner = [&](unsigned int index) {
    const auto& [x, y, z] = mesh.vertices[index];
    return wall.moves() ? wall.start(Vector3(x, y, z)) : Vector3(x, y, z);
  };
  std::vector<SurfacePoint> points;
  for (const auto& triangle : mesh.triangles) {
    const Vector3 a = corner(triangle[0]), b = corner(triangle[1]), c = corner(triangle[2]);
    const Vector3 normal = (b - a).cross(c - a).normalized();
    for (const Vector3& point : {a, b, c}) points.push_back({point, normal});
  }
  return points;
}

std::vector<WallPicture> pictures_of(const Container& container, double top, const PeriodicAxes& periodic) {
  if (const Box* box = std::get_if<Box>(&container)) return pictures_of(*box, top, periodic);
  return std::visit([top](const auto& kind) { return pictures_of(kind, top); }, container);
}

}  // namespace falling_particles
