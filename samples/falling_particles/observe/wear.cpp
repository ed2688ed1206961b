// The measurement wear: the volume that sliding grains wear off walls.

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/archive.hpp"
#include "common/nearest_word.hpp"
#include "measurement.hpp"
#include "region.hpp"
#include "simulation.hpp"
#include "world/grain.hpp"

namespace falling_particles {
namespace {

/// N m, the normal force times the sliding distance in the step of a contact of a grain and the wall with `geom`.
double sliding_work(const MeasuredContact& contact, dGeomID grain, dGeomID wall, const World& world) {
  const double step = world.scene().time.step;
  const Vector3 normal = to_vector(contact.geom.normal);
  const double load = normal.dot(to_vector(contact.force()));
  if (!(load > 0)) return 0;
  dBodyID body = dGeomGetBody(grain);
  const Vector3 velocity = velocity_of_move(body);
  const Vector3 centre = to_vector(dBodyGetPosition(body)) - step * velocity;
  const Vector3 point = to_vector(contact.geom.pos);
  const Vector3 slip =
      velocity + spin_of_move(body).cross(point - centre) - world.walls().surface_velocity(wall, point, centre, velocity);
  return step * load * (slip - normal.dot(slip) * normal).norm();
}

using Polygon = std::vector<Vector3>;  // m, convex and plane

/// The part of a polygon whose coordinate along an axis is at least `limit` (Sutherland and Hodgman 1974); at most with sign -1.
Polygon part_beyond(double limit, double sign, Eigen::Index axis, const Polygon& polygon) {
  Polygon part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3& a = polygon[i];
    const Vector3& b = polygon[(i + 1) % polygon.size()];
    const double from = sign * (a[axis] - limit);
    const double to = sign * (b[axis] - limit);
    if (from >= 0) part.push_back(a);
    if ((from < 0) != (to < 0)) part.emplace_back(a + from / (from - to) * (b - a));
  }
  return part;
}

/// Walls extend beyond a periodic cell, and have contacts only in it.
Polygon part_in_cell(Polygon polygon, const PeriodicAxes& axes) {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (!axes[i]) continue;
    const auto axis = static_cast<Eigen::Index>(i);
    polygon = part_beyond(axes[i]->upper(), -1, axis, part_beyond(axes[i]->lower, 1, axis, polygon));
  }
  return polygon;
}

struct Extent {
  double area = 0;                     // m^2
  Vector3 centroid = Vector3::Zero();  // m; the origin if there is no area
};

Extent extent_of(const Polygon& polygon) {
  Extent extent;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const double area = (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]).norm() / 2;
    extent.area += area;
    extent.centroid += area * (polygon[0] + polygon[i - 1] + polygon[i]) / 3;
  }
  if (extent.area > 0) extent.centroid /= extent.area;
  return extent;
}

/// The triangles of a mesh as contacts number them; empty for other shapes. Contacts with the other side of a two-sided mesh have
/// higher numbers.
std::vector<Extent> triangles_of(const Wall& wall, const PeriodicAxes& axes) {
  const auto* const mesh = std::get_if<MeshShape>(&wall.shape);
  if (mesh == nullptr) return {};
  std::vector<Extent> extents;
  for (const auto& triangle : mesh->triangles) {
    Polygon corners;
    for (const unsigned int vertex : triangle) {
      const auto& [x, y, z] = mesh->vertices[vertex];
      corners.emplace_back(wall.start(Vector3(x, y, z)));
    }
    extents.push_back(extent_of(part_in_cell(std::move(corners), axes)));
  }
  return extents;
}

class Wear final : public Measurement {
 public:
  /// `worn`: m^3/(N m), the volume for each unit of work.
  Wear(const World& world, const std::vector<std::string>& names, double worn, bool per_triangle)
      : worn_(worn), per_triangle_(per_triangle) {
    for (const Wall& wall : world.scene().walls) {
      const bool is_chosen = std::ranges::find(names, wall.name) != names.end();
      const std::vector<Extent>& triangles =
          triangles_.emplace_back(is_chosen ? triangles_of(wall, world.scene().periodic) : std::vector<Extent>());
      work_.emplace_back(is_chosen ? std::max<std::size_t>(triangles.size(), 1) : 0, 0.0);
    }
  }

  std::string columns() const override {
    return per_triangle_ ? "time_s,wall,triangle,x_m,y_m,z_m,area_m2,force_times_distance_Nm,worn_volume_m3,worn_depth_m"
                         : "time_s,wall,force_times_distance_Nm,worn_volume_m3";
  }

  void follow(const Sample& sample) override {
    const World& world = sample.world;
    for (const MeasuredContact& contact : sample.simulation->stepper.measured_contacts()) {
      const bool is_wall_first = grain_of(contact.geom.g1) == nullptr;
      const auto [wall_geom, grain_geom] =
          is_wall_first ? std::pair(contact.geom.g1, contact.geom.g2) : std::pair(contact.geom.g2, contact.geom.g1);
      const Wall* const wall = world.walls().wall_of(wall_geom);
      if (wall == nullptr) continue;
      std::vector<double>& work = work_[static_cast<std::size_t>(wall - world.scene().walls.data())];
      if (work.empty()) continue;
      const int side = is_wall_first ? contact.geom.side1 : contact.geom.side2;  // -1 for walls without triangles
      const std::size_t triangle = side < 0 ? 0 : static_cast<std::size_t>(side) % work.size();
      work[triangle] += sliding_work(contact, grain_geom, wall_geom, world);
    }
  }

  void measure(const Sample& sample, TableText& table) const override {
    per_triangle_ ? write_triangles(sample, table) : write_walls(sample, table);
  }

  std::vector<TriangleField> fields() const override {
    const auto has_none = [](const std::vector<Extent>& triangles) { return triangles.empty(); };
    if (!per_triangle_ || std::ranges::all_of(triangles_, has_none)) return {};
    TriangleField depth{"depth", {}}, volume{"volume", {}};
    for (std::size_t i = 0; i < work_.size(); ++i) {
      depth.of_walls.emplace_back();
      volume.of_walls.emplace_back();
      for (std::size_t k = 0; k < triangles_[i].size(); ++k) {
        const double area = triangles_[i][k].area;
        volume.of_walls.back().push_back(worn_ * work_[i][k]);
        depth.of_walls.back().push_back(area > 0 ? worn_ * work_[i][k] / area : 0);
      }
    }
    return {depth, volume};
  }

  std::string save() const override { return to_bytes(work_); }
  void restore(const std::string& memory) override { Reader{memory}(work_); }

 private:
  /// One line for each name. Several walls may share one.
  void write_walls(const Sample& sample, TableText& table) const {
    const std::vector<Wall>& walls = sample.world.scene().walls;
    std::vector<std::string> names;
    std::map<std::string, double> works;
    for (std::size_t i = 0; i < walls.size(); ++i) {
      if (work_[i].empty()) continue;
      if (!works.contains(walls[i].name)) names.push_back(walls[i].name);
      for (const double work : work_[i]) works[walls[i].name] += work;
    }
    for (const std::string& name : names) table.add(sample.time).add(name).add(works[name]).add(worn_ * works[name]).end_line();
  }

  /// One line for each triangle with wear.
  void write_triangles(const Sample& sample, TableText& table) const {
    const std::vector<Wall>& walls = sample.world.scene().walls;
    for (std::size_t i = 0; i < walls.size(); ++i) {
      for (std::size_t k = 0; k < work_[i].size(); ++k) {
        if (work_[i][k] > 0) write_triangle(sample, i, k, table);
      }
    }
  }

  void write_triangle(const Sample& sample, std::size_t index, std::size_t triangle, TableText& table) const {
    const double work = work_[index][triangle];
    const auto& [area, centroid] = triangles_[index][triangle];
    table.add(sample.time).add(sample.world.scene().walls[index].name);
    table.add(triangle).add(centroid).add(area).add(work).add(worn_ * work);
    area > 0 ? table.add(worn_ * work / area).end_line() : table.blank().end_line();
  }

  double worn_;
  bool per_triangle_;
  std::vector<std::vector<Extent>> triangles_;  // of each wall of the scene; empty for walls that are not chosen, or no mesh
  std::vector<std::vector<double>> work_;       // N m, of each triangle, or of the whole wall; empty for walls that are not chosen
};

/// Of `names`, of walls, those of meshes. Throws InputError if the scene names another one, or if there is none.
std::vector<std::string> meshes_of(const std::vector<std::string>& names, const TomlTable& table, const Scene& scene) {
  std::vector<std::string> all, chosen;
  for (const Wall& wall : scene.walls) {
    if (std::holds_alternative<MeshShape>(wall.shape)) all.push_back(wall.name);
  }
  if (all.empty()) {
    table.fail(
        "per",
        R"(measurement.per is "triangle" in a scene without a wall that is a mesh; allowed: wall, or a part with shape = "mesh")");
  }
  for (const std::string& name : names) {
    if (std::ranges::find(all, name) != all.end()) {
      chosen.push_back(name);
    } else if (table.has("surfaces")) {
      table.fail("surfaces", "measurement.surfaces has \"" + name +
                                 "\", which is no mesh and has no triangles; allowed: " + join(all) + ", or per = \"wall\"");
    }
  }
  return chosen;
}

}  // namespace

MeasurementKind wear_kind() {
  constexpr double kSoftest = 1e4;   // Pa; as soft as jelly, and above the numbers that hardnesses have in GPa, MPa or HV
  constexpr double kHardest = 1e12;  // Pa; diamond has 1e11
  return {.name = "wear",
          .measures = "the volume that sliding grains have worn off walls since `from`, by Archard's law",
          .parameters = {{"coefficient", "1, in (0, 1]: the wear coefficient k of Archard's law; 1e-8 to 1e-2 is usual"},
                         {"hardness", "Pa, in [1e4, 1e12]: of the softer one of wall and grains"},
                         {"surfaces", "names of walls, as for part_force; without it all; per triangle only meshes"},
                         {"per", "wall or triangle, for triangles of meshes with wear; wall without it"}},
          .columns =
              "time, wall, sum over contacts and steps of normal force times sliding distance, volume; per triangle also its index "
              "in the mesh, centroid at the start, area and mean depth",
          .source = "V = k / H sum F s: Archard, J. Appl. Phys. 24 (1953) 981",
          .needs_contacts = true,
          .follows = true,
          .read = [](const TomlTable& table, const Scene& scene) -> MeasurementMaker {
            const double coefficient = table.number("coefficient", Interval::positive(1, ""));
            const double hardness = table.number("hardness", Interval::closed(kSoftest, kHardest, "Pa"));
            const bool is_per_triangle = table.has("per") && table.choice("per", {"wall", "triangle"}) == "triangle";
            std::vector<std::string> names = read_surfaces(table, scene);
            if (is_per_triangle) names = meshes_of(names, table, scene);
            return
                [=](const World& world) { return std::make_unique<Wear>(world, names, coefficient / hardness, is_per_triangle); };
          }};
}

}  // namespace falling_particles
