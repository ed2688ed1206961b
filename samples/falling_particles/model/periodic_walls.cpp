#include "periodic_walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/interval.hpp"

namespace falling_particles {
namespace {

constexpr double kAlong = 1e-9;     // of a unit vector: tolerance for being along an axis, or across it
constexpr double kRounding = 1e-9;  // m

bool is_along(const Vector3& direction, std::size_t axis) {
  return std::abs(direction[static_cast<Eigen::Index>(axis)]) > 1 - kAlong;
}
bool is_across(const Vector3& direction, std::size_t axis) { return std::abs(direction[static_cast<Eigen::Index>(axis)]) < kAlong; }

/// The normal of a plane at the start, in the world's frame.
Vector3 normal_of(const Wall& wall, const PlaneShape& plane) { return wall.start.rotation * plane.normal; }

/// The ends (m) of a wall along an axis at the start. A plane has none unless it is across the axis.
struct Ends {
  double lower, upper;
};

Ends around(double centre, double half) { return {centre - half, centre + half}; }

Ends ends_of(const Wall& wall, std::size_t axis) {
  const auto i = static_cast<Eigen::Index>(axis);
  const double centre = wall.start.position[i];
  const Eigen::Matrix3d turn = wall.start.rotation.toRotationMatrix();
  if (const auto* plane = std::get_if<PlaneShape>(&wall.shape))
    return is_along(normal_of(wall, *plane), axis) ? around(centre, 0) : around(0, INFINITY);
  if (const auto* box = std::get_if<BoxShape>(&wall.shape)) {
    return around(centre, turn.row(i).cwiseAbs().dot(box->size.transpose()) / 2);
  }
  if (const auto* cylinder = std::get_if<CylinderShape>(&wall.shape)) {
    const double along = std::abs(turn(i, 2));
    const double across = std::sqrt(std::max(0.0, 1 - along * along));
    return around(centre, along * cylinder->length / 2 + across * cylinder->radius);
  }
  if (const auto* mesh = std::get_if<MeshShape>(&wall.shape)) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Ends ends{kInfinity, -kInfinity};
    for (const auto& [x, y, z] : mesh->vertices) {
      const double place = wall.start(Vector3(x, y, z))[i];
      ends = {std::min(ends.lower, place), std::max(ends.upper, place)};
    }
    return ends;
  }
  return around(centre, bounding_radius(wall.shape));
}

/// The axis of the wall's frame that lies along an axis of the world; empty if there is none.
std::optional<Eigen::Index> own_axis(const Wall& wall, std::size_t axis) {
  const Eigen::Matrix3d turn = wall.start.rotation.toRotationMatrix();
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (is_along(turn.col(k), axis)) return k;
  }
  return std::nullopt;
}

/// Moves the ends of a prism outwards.
void lengthen(MeshShape& prism, const WallPose& pose, std::size_t axis, const Ends& to) {
  const auto i = static_cast<Eigen::Index>(axis);
  for (std::array<float, 3>& vertex : prism.vertices) {
    Vector3 place = pose(Vector3(vertex[0], vertex[1], vertex[2]));
    place[i] = place[i] < (to.lower + to.upper) / 2 ? to.lower : to.upper;
    const Vector3 own = pose.rotation.conjugate() * (place - pose.position);
    vertex = {static_cast<float>(own.x()), static_cast<float>(own.y()), static_cast<float>(own.z())};
  }
}

/// Whether a mesh is a prism along the axis. All its vertices are at its two ends, and both ends have the same section.
bool is_prism(const Wall& wall, const MeshShape& mesh, std::size_t axis) {
  const Ends ends = ends_of(wall, axis);
  const double tolerance = 1e-5 * (ends.upper - ends.lower);  // vertices are in single precision
  const auto i = static_cast<Eigen::Index>(axis);
  std::array<std::vector<Vector3>, 2> sections;
  for (const auto& [x, y, z] : mesh.vertices) {
    Vector3 place = wall.start(Vector3(x, y, z));
    const bool is_low = place[i] - ends.lower < tolerance;
    if (!is_low && ends.upper - place[i] > tolerance) return false;
    place[i] = 0;
    sections[is_low ? 0 : 1].push_back(place);
  }
  const auto is_in = [tolerance](const std::vector<Vector3>& section) {
    return [&section, tolerance](const Vector3& point) {
      return std::ranges::any_of(section, [&](const Vector3& other) { return (point - other).norm() < tolerance; });
    };
  };
  return std::ranges::all_of(sections[0], is_in(sections[1])) && std::ranges::all_of(sections[1], is_in(sections[0]));
}

std::optional<std::string> find_end_of_shape(const Wall& wall, std::size_t axis) {
  const Eigen::Matrix3d turn = wall.start.rotation.toRotationMatrix();
  if (const auto* plane = std::get_if<PlaneShape>(&wall.shape)) {
    return is_across(normal_of(wall, *plane), axis) ? std::nullopt
                                                    : std::optional<std::string>("the plane is not parallel to the axis");
  }
  if (std::holds_alternative<BoxShape>(wall.shape)) {
    return own_axis(wall, axis) ? std::nullopt : std::optional<std::string>("no edge of the box is along the axis");
  }
  if (std::holds_alternative<CylinderShape>(wall.shape)) {
    return is_along(turn.col(2), axis) ? std::nullopt : std::optional<std::string>("the cylinder is not along the axis");
  }
  if (const auto* mesh = std::get_if<MeshShape>(&wall.shape)) {
    return is_prism(wall, *mesh, axis) ? std::nullopt : std::optional<std::string>("the mesh is no prism along the axis");
  }
  return std::holds_alternative<GroundShape>(wall.shape) ? "a ground ends" : "a smooth body ends";
}

/// Adds the displacement (m) of a vibration along the axis to `way`.
std::optional<std::string> find_end_of_motion(const Wall& wall, const WallMotion& motion, std::size_t axis, double& way) {
  const bool is_plane = std::holds_alternative<PlaneShape>(wall.shape);
  const auto turns_across = [axis](const Rotation& turn) { return turn.rpm != 0 && !is_along(turn.axis, axis); };
  if (const auto* translation = std::get_if<Translation>(&motion.kind)) {
    if (is_plane || is_across(translation->velocity, axis)) return std::nullopt;
    return "its velocity takes it along the axis (a surface that moves is of kind \"conveyor\")";
  }
  if (const auto* vibration = std::get_if<Vibration>(&motion.kind)) {
    way += 2 * std::abs(vibration->amplitude[static_cast<Eigen::Index>(axis)]);
    return std::nullopt;
  }
  const auto* rotation = std::get_if<Rotation>(&motion.kind);
  if (turns_across(rotation != nullptr ? *rotation : std::get<Conveyor>(motion.kind).turn))
    return "it does not turn about the axis";
  return std::nullopt;
}

}  // namespace

void open_container(const PeriodicAxes& axes, double reach, std::size_t of_container, std::vector<Wall>& walls) {
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    if (!axes[axis]) continue;
    const Period& period = *axes[axis];
    const auto closes = [&](const Wall& wall) {
      const Ends ends = ends_of(wall, axis);
      return ends.upper < period.lower + kRounding || ends.lower > period.upper() - kRounding;
    };
    const auto end = walls.begin() + static_cast<std::ptrdiff_t>(of_container);
    const auto kept = std::remove_if(walls.begin(), end, closes);
    of_container = static_cast<std::size_t>(kept - walls.begin());
    walls.erase(kept, end);
    for (std::size_t i = 0; i < of_container; ++i) {
      auto* const mesh = std::get_if<MeshShape>(&walls[i].shape);
      if (mesh == nullptr) continue;  // a plane
      const Ends ends = ends_of(walls[i], axis);
      lengthen(*mesh, walls[i].start, axis,
               {std::min(ends.lower, period.lower - reach), std::max(ends.upper, period.upper() + reach)});
    }
  }
}

std::optional<std::string> find_end(const Wall& wall, std::size_t axis, const Period& period, double reach) {
  if (std::optional<std::string> end = find_end_of_shape(wall, axis)) return end;
  double way = reach;
  for (const WallMotion& motion : wall.motions) {
    if (std::optional<std::string> end = find_end_of_motion(wall, motion, axis, way)) return end;
  }
  if (wall.flight) return "it is free";
  if (wall.drive && wall.drive->turns() && !is_along(wall.drive->axis, axis)) return "its drive does not turn it about the axis";
  if (wall.drive && !wall.drive->turns() && !is_across(wall.drive->axis, axis)) return "its drive takes it along the axis";
  const Ends ends = ends_of(wall, axis);
  const Ends needed{period.lower - way, period.upper() + way};
  if (ends.lower <= needed.lower + kRounding && ends.upper >= needed.upper - kRounding) return std::nullopt;
  return "it reaches from " + rounded(ends.lower, 6) + " to " + rounded(ends.upper, 6) + " m and must from " +
         rounded(needed.lower, 6) + " to " + rounded(needed.upper, 6) + " m, where the images of grains meet it";
}

}  // namespace falling_particles
