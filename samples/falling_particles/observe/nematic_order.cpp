// The measurement nematic_order: the alignment of an axis of one kind of grains.

#include <Eigen/Dense>
#include <algorithm>

#include "measurement.hpp"
#include "region.hpp"

namespace falling_particles {
namespace {

using Eigen::Matrix3d;

Vector3 axis_in_world(const Grain& grain, std::size_t axis) {
  const auto [w, x, y, z] = grain.quaternion();
  return Eigen::Quaterniond(w, x, y, z).toRotationMatrix().col(static_cast<Eigen::Index>(axis));
}

void measure_order(const Sample& sample, TableText& table, const SamplingRegion& region, const std::string& kind,
                   std::size_t axis) {
  const Bounds bounds = region.bounds(sample.world);
  Matrix3d sum = Matrix3d::Zero();
  std::size_t grains = 0;
  for (const Grain& grain : sample.world.present()) {
    if (grain.kind->name != kind || !bounds.contains(place_of(grain, sample.world))) continue;
    const Vector3 u = axis_in_world(grain, axis);
    sum += u * u.transpose();
    ++grains;
  }
  table.add(sample.time).add(grains);
  if (grains == 0) {
    constexpr int kOtherColumns = 5;
    table.blank(kOtherColumns).end_line();
    return;
  }
  const Matrix3d Q = 1.5 * sum / static_cast<double>(grains) - 0.5 * Matrix3d::Identity();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(Q);
  const Vector3& values = solver.eigenvalues();  // in increasing order
  table.add(values[2]).add(Vector3(solver.eigenvectors().col(2))).add(values[1] - values[0]).end_line();
}

/// The index of the half-axis that is longer, or shorter, than both others.
std::size_t find_axis(const TomlTable& table, const Scene& scene, const std::string& name, const std::string& which) {
  const auto kind = std::ranges::find(scene.kinds, name, [](const GrainCount& count) { return count.kind.name; });
  const std::array<double, 3>& axes = kind->kind.half_axes;
  const auto [least, most] = std::ranges::minmax_element(axes);
  const auto found = which == "longest" ? most : least;
  if (std::ranges::count(axes, *found) > 1) {
    table.fail("axis", "grain \"" + name + "\" has no single " + which + " half-axis (" + shortest(axes[0]) + ", " +
                           shortest(axes[1]) + ", " + shortest(axes[2]) + " m); allowed: an axis that is one of a kind");
  }
  return static_cast<std::size_t>(found - axes.begin());
}

}  // namespace

MeasurementKind nematic_order_kind() {
  return {.name = "nematic_order",
          .measures = "the alignment of an axis of one kind of grains",
          .parameters = {{"grain", "the kind's name"},
                         {"axis", "longest or shortest, the half-axis that is followed"},
                         {"lower, upper", "m, corners of a box that holds the grains' centres; without them everywhere"}},
          .columns =
              "time, grains, order parameter (largest eigenvalue of the mean of 3/2 u u - I/2), director, biaxiality (difference "
              "of the others)",
          .source = "de Gennes and Prost, The Physics of Liquid Crystals (1993)",
          .read = [](const TomlTable& table, const Scene& scene) -> MeasurementMaker {
            const SamplingRegion region(table, scene, SamplingRegion::Without::Everywhere);
            const std::string grain = table.choice("grain", names_of_grains(scene));
            const std::size_t axis = find_axis(table, scene, grain, table.choice("axis", {"longest", "shortest"}));
            return lines_of("time_s,grains,order,director_x,director_y,director_z,biaxiality",
                            [=](const Sample& sample, TableText& lines) { measure_order(sample, lines, region, grain, axis); });
          },
          .plotted = {"order", "biaxiality"},
          .plot_label = "order parameter"};
}

}  // namespace falling_particles
