#include "grain_shape.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <supernormal/proximity/clearance.hpp>
#include <supernormal/raycast/ray.hpp>
#include <supernormal/shapes/capsule.hpp>
#include <supernormal/shapes/rounded.hpp>
#include <supernormal/shapes/superellipsoid.hpp>
#include <supernormal/shapes/superovoid.hpp>
#include <utility>

namespace falling_particles {
namespace {

using supernormal::Vector3;

std::shared_ptr<const supernormal::Shape> core_of(const ConvexBody& body, double scale) {
  const auto [a, b, c] = body.core_half_axes();
  const Vector3 half_axes = scale * Vector3(a, b, c);
  switch (body.shape) {
    case ConvexBody::Shape::Superovoid:
      return std::make_shared<supernormal::Superovoid>(half_axes, body.delta, body.epsilon, body.taper[0], body.taper[1]);
    case ConvexBody::Shape::Capsule:
      return std::make_shared<supernormal::Capsule>(half_axes.x(), half_axes.z() - half_axes.x());
    case ConvexBody::Shape::Superellipsoid:
      break;
  }
  return std::make_shared<supernormal::Superellipsoid>(half_axes, body.delta, body.epsilon);
}

using supernormal::Matrix3;
using supernormal::Pose;
/// Integrals over a body.
struct Moments {
  double volume = 0;                 // m^3
  double mass = 0;                   // kg
  Vector3 first = Vector3::Zero();   // kg m
  Matrix3 second = Matrix3::Zero();  // kg m^2, of x x^T
};

/// An interval of a vertical line; empty unless its end is above its start.
struct Stretch {
  double start = 0, end = 0;
  double length() const { return std::max(0.0, end - start); }
};

struct PlacedComponent {
  std::shared_ptr<const supernormal::Shape> shape;
  Pose pose;
  double density;

  Moments moments() const {
    const supernormal::MassProperties own = shape->mass_properties();
    const Matrix3& R = pose.rotation;
    const Vector3& p = pose.position;
    const Vector3 first = own.volume * (R * own.centroid);
    const Matrix3 second =
        R * own.second_moment * R.transpose() + first * p.transpose() + p * first.transpose() + own.volume * p * p.transpose();
    return {own.volume, density * own.volume, density * (first + own.volume * p), density * second};
  }

  /// m, lower and upper end of the component along an axis of the grain.
  std::pair<double, double> range(int axis) const { return ranges[static_cast<std::size_t>(axis)]; }
  bool is_in_range(int axis, double x) const { return x >= range(axis).first && x <= range(axis).second; }

  /// The interval of the vertical line through x and y that lies within the component.
  Stretch chord(double x, double y) const;

  std::array<std::pair<double, double>, 3> ranges = find_ranges();
  std::optional<Matrix3> to_ball = find_to_ball();  // of an ellipsoid: into a frame in which it is the unit ball

 private:
  std::optional<Matrix3> find_to_ball() const {
    const auto* const body = dynamic_cast<const supernormal::Superellipsoid*>(shape.get());
    if (body == nullptr || body->delta() != 2 || body->epsilon() != 2) return std::nullopt;
    return Matrix3(body->half_axes().cwiseInverse().asDiagonal() * pose.rotation.transpose());
  }
  std::array<std::pair<double, double>, 3> find_ranges() const {
    std::array<std::pair<double, double>, 3> found;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 e = pose.rotation.row(axis).transpose();
      found[static_cast<std::size_t>(axis)] = {pose.position[axis] - shape->support(-e), pose.position[axis] + shape->support(e)};
    }
    return found;
  }
};

/// The chord of the unit ball; its half length is the root of a quadratic equation.
Stretch chord_of_ball(const Vector3& from_centre, const Vector3& up) {
  const double closest = -from_centre.dot(up) / up.squaredNorm();
  const double squared = 1 - (from_centre + closest * up).squaredNorm();
  if (!(squared > 0)) return {};
  const double half = std::sqrt(squared / up.squaredNorm());
  return {closest - half, closest + half};
}

Stretch PlacedComponent::chord(double x, double y) const {
  if (!is_in_range(0, x) || !is_in_range(1, y)) return {};  // a ray costs a hundred times as much
  if (to_ball) return chord_of_ball(*to_ball * (Vector3(x, y, 0) - pose.position), to_ball->col(2));
  const auto [bottom, top] = range(2);
  const double margin = top - bottom;
  const Vector3 below(x, y, bottom - margin);
  const Vector3 above(x, y, top + margin);
  const supernormal::RayHit up = find_ray_hit(*shape, pose, below, Vector3::UnitZ(), 3 * margin);
  if (!up.hit) return {};
  const supernormal::RayHit down = find_ray_hit(*shape, pose, above, -Vector3::UnitZ(), 3 * margin);
  if (!down.hit) return {};
  return {below.z() + up.distance, above.z() - down.distance};
}

/// The disjoint pieces of an interval that the other intervals cover.
std::vector<Stretch> covered(const Stretch& whole, std::vector<Stretch> others) {
  std::ranges::sort(others, {}, &Stretch::start);
  std::vector<Stretch> result;
  double reached = whole.start;
  for (const Stretch& other : others) {
    const Stretch piece{std::max(reached, other.start), std::min(whole.end, other.end)};
    if (piece.length() == 0) continue;
    result.push_back(piece);
    reached = piece.end;
  }
  return result;
}

bool overlaps(const PlacedComponent& one, const PlacedComponent& other) {
  constexpr double kTouching = 1e-6;  // of the smaller body: tolerance for components that touch, given to six digits
  const double size = std::min(one.shape->half_extents().minCoeff(), other.shape->half_extents().minCoeff());
  return !is_farther_than(*one.shape, one.pose, *other.shape, other.pose, -kTouching * size);
}

/// Subtracts from `sum` the volume that a component shares with earlier ones.
void subtract_shared(const PlacedComponent& component, const std::vector<PlacedComponent>& earlier, Moments& sum) {
  constexpr int kLines = 160;  // along each axis
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<Stretch, 2> box{{{kInfinity, -kInfinity}, {kInfinity, -kInfinity}}};  // around all shared volume, seen from above
  for (const PlacedComponent& other : earlier) {
    for (const int axis : {0, 1}) {
      const auto [low1, high1] = component.range(axis);
      const auto [low2, high2] = other.range(axis);
      Stretch& side = box[static_cast<std::size_t>(axis)];
      side = {std::min(side.start, std::max(low1, low2)), std::max(side.end, std::min(high1, high2))};
    }
  }
  const double dx = box[0].length() / kLines;
  const double dy = box[1].length() / kLines;
  for (int i = 0; i < kLines; ++i) {
    for (int j = 0; j < kLines; ++j) {
      const double x = box[0].start + (i + 0.5) * dx;
      const double y = box[1].start + (j + 0.5) * dy;
      const auto is_above = [&](const PlacedComponent& other) { return other.is_in_range(0, x) && other.is_in_range(1, y); };
      if (std::ranges::none_of(earlier, is_above)) continue;
      const Stretch own = component.chord(x, y);
      if (own.length() == 0) continue;
      std::vector<Stretch> others;
      others.reserve(earlier.size());
      for (const PlacedComponent& other : earlier) others.push_back(other.chord(x, y));
      for (const Stretch& shared : covered(own, std::move(others))) {
        const double volume = dx * dy * shared.length();
        const double mass = component.density * volume;
        const Vector3 middle(x, y, (shared.start + shared.end) / 2);
        sum.volume -= volume;
        sum.mass -= mass;
        sum.first -= mass * middle;
        sum.second -= mass * middle * middle.transpose();
        const Vector3 spread(dx, dy, shared.length());
        sum.second.diagonal() -= mass / 12 * spread.cwiseAbs2();
      }
    }
  }
}

/// Prints one line to stderr if integrating the shared volume of a compound takes long.
class ProgressNote {
 public:
  explicit ProgressNote(std::string name) : name_(std::move(name)) {}
  void after(std::size_t done, std::size_t all) {
    constexpr std::chrono::milliseconds kLong(500);
    if (has_told_ || done == all || std::chrono::steady_clock::now() - start_ < kLong) return;
    has_told_ = true;
    std::fprintf(stderr, "Mass of grain \"%s\": what its %zu bodies share is being worked out\n", name_.c_str(), all);
  }

 private:
  std::string name_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  bool has_told_ = false;
};

Moments moments_of(const std::string& name, const std::vector<PlacedComponent>& components) {
  Moments sum;
  ProgressNote note(name);
  std::vector<PlacedComponent> before;
  before.reserve(components.size());
  for (const PlacedComponent& component : components) {
    const Moments own = component.moments();
    sum.volume += own.volume;
    sum.mass += own.mass;
    sum.first += own.first;
    sum.second += own.second;
    std::vector<PlacedComponent> earlier;
    std::ranges::copy_if(before, std::back_inserter(earlier),
                         [&component](const PlacedComponent& other) { return overlaps(other, component); });
    if (!earlier.empty()) subtract_shared(component, earlier, sum);
    before.push_back(component);
    note.after(before.size(), components.size());
  }
  return sum;
}

}  // namespace

std::shared_ptr<const supernormal::Shape> shape_of(const ConvexBody& body, double scale) {
  auto core = core_of(body, scale);
  if (body.rounding == 0) return core;
  return std::make_shared<supernormal::Rounded>(std::move(core), scale * body.rounding);
}

supernormal::Matrix3 lammps_inertia(const GrainKind& kind, double scale, const std::array<double, 4>& quaternion) {
  const Vector3 half_axes = scale * Vector3(kind.half_axes[0], kind.half_axes[1], kind.half_axes[2]);
  const auto [w, x, y, z] = quaternion;
  const supernormal::Matrix3 rotation = Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
  const supernormal::MassProperties unit = supernormal::Superellipsoid(half_axes, kind.delta, kind.epsilon).mass_properties();
  return kind.density * rotation * unit.inertia() * rotation.transpose();
}

double mass_of(const GrainKind& kind) {
  if (kind.compound_mass) return kind.compound_mass->mass;
  return kind.density * shape_of(kind.all_components().front().body)->mass_properties().volume;
}

supernormal::Pose pose_of(const Component& component, double scale) {
  const auto [w, x, y, z] = component.quaternion;
  const auto [px, py, pz] = component.position;
  return {scale * Vector3(px, py, pz), Eigen::Quaterniond(w, x, y, z).toRotationMatrix()};
}

supernormal::Tessellation mesh_of(const GrainKind& kind, double chord_error) {
  supernormal::Tessellation mesh;
  for (const Component& component : kind.all_components()) {
    supernormal::Tessellation body = tessellate(*shape_of(component.body), chord_error * component.body.smallest_half_axis());
    if (kind.components.empty()) return body;
    const supernormal::Pose pose = pose_of(component);
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const auto& point : body.points) mesh.points.emplace_back(pose.rotation * point + pose.position);
    for (const auto& normal : body.normals) mesh.normals.emplace_back(pose.rotation * normal);
    for (const auto& [a, b, c] : body.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
  }
  return mesh;
}

GrainKind make_compound(std::string name, std::vector<Component> components, std::string source) {
  std::vector<PlacedComponent> placed;
  placed.reserve(components.size());
  for (const Component& component : components) placed.push_back({shape_of(component.body), pose_of(component), component.density});
  const Moments moments = moments_of(name, placed);
  const Vector3 centre = moments.first / moments.mass;
  const Matrix3 central = moments.second - moments.mass * centre * centre.transpose();
  const Matrix3 inertia = central.trace() * Matrix3::Identity() - central;

  GrainKind kind{std::move(name), {}, 2, 2, 0, moments.mass / moments.volume, std::move(source)};
  CompoundMass& mass = kind.compound_mass.emplace(CompoundMass{moments.mass, {}});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<int>(axis);
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (const PlacedComponent& component : placed) {
      const auto [low, high] = component.range(i);
      least = std::min(least, low);
      most = std::max(most, high);
    }
    kind.half_axes[axis] = (most - least) / 2;
    for (std::size_t other = 0; other < 3; ++other) mass.inertia[axis][other] = inertia(i, static_cast<int>(other));
    for (Component& component : components) component.position[axis] -= centre[i];
  }
  kind.components = std::move(components);
  return kind;
}

}  // namespace falling_particles
