#include "proximity/local/degenerate_directions.hpp"

#include <algorithm>
#include <cmath>

namespace supernormal {
namespace {

// A normal is not near a plane of symmetry when it is turned out of it by more (sine), whatever the distance.
constexpr double kNearPlane = 0.1;

}  // namespace

DegenerateDirections::DegenerateDirections(const GapFunction& gap, const LocalModel& local, double distance) {
  const Eigen2 curvature(local.model.A);
  const double flat = kFlatRadius * gap.length_unit();
  if (curvature.high > flat) add(curvature.high_vector);
  if (curvature.low > flat) add(curvature.low_vector);
  add_planes(gap.shape1(), local.plane1, distance);
  add_planes(gap.shape2(), local.plane2, distance);
}

void DegenerateDirections::add_planes(const Shape& shape, const TangentPlane& plane, double distance) {
  if (!shape.has_flat_faces()) return;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(plane.n[axis]) < std::min(distance, kNearPlane)) add(plane.project(Vector3::Unit(axis)).normalized());
  }
}

}  // namespace supernormal
