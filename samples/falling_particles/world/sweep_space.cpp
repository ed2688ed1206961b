#include "sweep_space.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace falling_particles {
namespace {

// A choice takes less time than a sweep. A bed takes hundreds of steps to change its shape.
constexpr int kStepsBetweenChoices = 50;
// The least ratio of the variances along another axis and the present one. A change then saves a third of the tests. Square beds
// keep their axis.
constexpr double kWorthAMove = 2;

constexpr unsigned long kMarkerBit = 1UL << 31U;

std::size_t index_of(Axis axis) { return static_cast<std::size_t>(axis); }

dSpaceID create_space(const std::array<Axis, 3>& order) {
  // The order is encoded as in dSAP_AXES_XYZ and its permutations.
  return dSweepAndPruneSpaceCreate(nullptr,
                                   static_cast<int>(index_of(order[0]) | index_of(order[1]) << 2U | index_of(order[2]) << 4U));
}

/// Creates a plane that collides only with its twin.
dGeomID create_marker(dSpaceID space) {
  dGeomID plane = dCreatePlane(space, 0.6, 0, 0.8, 0);
  dGeomSetCategoryBits(plane, kMarkerBit);
  dGeomSetCollideBits(plane, kMarkerBit);
  return plane;
}

std::vector<dGeomID> geoms_of(dSpaceID space) {
  std::vector<dGeomID> geoms;
  const int count = dSpaceGetNumGeoms(space);
  geoms.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) geoms.push_back(dSpaceGetGeom(space, i));
  return geoms;
}

bool is_body(dGeomID geom) { return dGeomGetClass(geom) != dPlaneClass && dGeomIsEnabled(geom) != 0; }

/// The variances of the bodies' positions along the three axes.
std::array<double, 3> variances(dSpaceID space) {
  std::array<double, 3> mean{};
  std::array<double, 3> squares{};
  double count = 0;
  for (dGeomID geom : geoms_of(space)) {
    if (!is_body(geom)) continue;
    ++count;
    const dReal* position = dGeomGetPosition(geom);
    for (std::size_t i = 0; i < 3; ++i) {  // Welford's update, which does not cancel
      const double deviation = position[i] - mean[i];
      mean[i] += deviation / count;
      squares[i] += deviation * (position[i] - mean[i]);
    }
  }
  if (count > 0) {
    for (double& square : squares) square /= count;
  }
  return squares;
}

}  // namespace

SweepSpace::SweepSpace() {
  // A plane that is not parallel to an axis has no bounding box. ODE names its pairs after the sweep.
  for (dGeomID& marker : markers_) marker = create_marker(space_);
}

SweepSpace::~SweepSpace() { dSpaceDestroy(space_); }

void SweepSpace::before_step() {
  if (steps_ % kStepsBetweenChoices == 0) choose_axis();
  ++steps_;
}

void SweepSpace::choose_axis() {
  const std::array<double, 3> spread = variances(space_);
  const auto spread_along = [&spread](Axis axis) { return spread[index_of(axis)]; };
  Order order = order_;
  // Comparisons are false for a NaN.
  if (spread_along(order[2]) > spread_along(order[1])) std::swap(order[1], order[2]);
  if (!(spread_along(order[1]) > kWorthAMove * spread_along(order[0]))) return;
  std::swap(order[0], order[1]);
  if (spread_along(order[2]) > spread_along(order[1])) std::swap(order[1], order[2]);
  move_to(order);
}

void SweepSpace::move_to(const Order& order) {
  dSpaceID old = std::exchange(space_, create_space(order));
  for (dGeomID geom : geoms_of(old)) {
    dSpaceRemove(old, geom);
    dSpaceAdd(space_, geom);
  }
  dSpaceDestroy(old);
  order_ = order;
}

}  // namespace falling_particles
