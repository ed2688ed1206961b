// The measurement grid: fields on a grid of cells.

#include <Eigen/Dense>
#include <vector>

#include "measurement.hpp"
#include "region.hpp"
#include "world/grain.hpp"

namespace falling_particles {
namespace {

using Eigen::Matrix3d;

/// Sums over the grains whose centres are in a cell.
struct CellSums {
  double mass = 0;                     // kg
  double volume = 0;                   // m^3, of the grains
  Vector3 place = Vector3::Zero();     // kg m, sum of m x
  Vector3 velocity = Vector3::Zero();  // kg m/s, sum of m v
  Matrix3d spread = Matrix3d::Zero();  // kg m^2, sum of m x x^T, then about the mean
  Matrix3d shear = Matrix3d::Zero();   // kg m^2/s, sum of m x v^T, then about the means
  double energy = 0;                   // kg m^2/s^2, sum of m v^2, then about the mean
  std::size_t grains = 0;
};

/// The energy that remains after subtracting the best linear fit of the velocity field, in the directions in which the grains are
/// spread. `unknowns`: of the fit, per component of velocity.
double energy_beside_field(const CellSums& sums, int& unknowns) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(sums.spread);
  constexpr double kFlat = 1e-9;
  double energy = sums.energy;
  unknowns = 1;
  for (int i = 0; i < 3; ++i) {
    const double spread = solver.eigenvalues()[i];
    if (spread <= kFlat * solver.eigenvalues()[2]) continue;
    energy -= (sums.shear.transpose() * solver.eigenvectors().col(i)).squaredNorm() / spread;
    ++unknowns;
  }
  return std::max(0.0, energy);
}

void visit_cells(const Bounds& bounds, const CellCounts& cells, const World& world, auto visit, std::vector<CellSums>& all) {
  for (const Grain& grain : world.present()) {
    const Vector3 place = place_of(grain, world);
    if (const auto cell = cell_of(place, bounds, cells)) visit(all[*cell], grain, place, to_vector(grain.velocity()));
  }
}

void write(const CellSums& sums, double volume, TableText& table) {
  table.add(sums.grains).add(sums.mass / volume).add(sums.volume / volume);
  if (sums.grains == 0) {
    constexpr int kOtherColumns = 5;
    table.blank(kOtherColumns).end_line();
    return;
  }
  table.add(Vector3(sums.velocity / sums.mass));
  int unknowns = 0;
  const double energy = energy_beside_field(sums, unknowns);
  const auto grains = static_cast<double>(sums.grains);
  grains > unknowns ? table.add(energy / sums.mass / 3 * grains / (grains - unknowns)) : table.blank();
  table.add(sums.energy / sums.mass / 3).end_line();
}

void measure_cells(const Sample& sample, TableText& table, const SamplingRegion& region, const CellCounts& cells) {
  const Bounds bounds = region.bounds(sample.world);
  std::vector<CellSums> all(number_of(cells));
  // Two passes: moments about the means of the cells avoid cancellation.
  visit_cells(
      bounds, cells, sample.world,
      [&](CellSums& sums, const Grain& grain, const Vector3& place, const Vector3& velocity) {
        sums.mass += grain.mass.mass;
        sums.volume += grain.volume();
        sums.place += grain.mass.mass * place;
        sums.velocity += grain.mass.mass * velocity;
        ++sums.grains;
      },
      all);
  visit_cells(
      bounds, cells, sample.world,
      [](CellSums& sums, const Grain& grain, const Vector3& place, const Vector3& velocity) {
        const Vector3 x = place - sums.place / sums.mass;
        const Vector3 v = velocity - sums.velocity / sums.mass;
        sums.spread += grain.mass.mass * x * x.transpose();
        sums.shear += grain.mass.mass * x * v.transpose();
        sums.energy += grain.mass.mass * v.squaredNorm();
      },
      all);
  const Vector3 size =
      (bounds.upper - bounds.lower)
          .cwiseQuotient(Vector3(static_cast<double>(cells[0]), static_cast<double>(cells[1]), static_cast<double>(cells[2])));
  for (std::size_t index = 0; index < all.size(); ++index) {
    const std::size_t i = index % cells[0];
    const std::size_t j = index / cells[0] % cells[1];
    const std::size_t k = index / cells[0] / cells[1];
    const Vector3 middle =
        bounds.lower +
        size.cwiseProduct(Vector3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)) + Vector3::Constant(0.5));
    table.add(sample.time).add(i).add(j).add(k).add(middle);
    write(all[index], size.prod(), table);
  }
}

}  // namespace

MeasurementKind grid_kind() {
  return {
      .name = "grid",
      .measures =
          "velocity, density, volume fraction and granular temperature in the cells of a grid; a grain counts where its centre is",
      .parameters = {{"lower, upper", "m, corners of the grid; without them all of a periodic cell"},
                     {"cells", "three whole numbers from 1 to 1000, along x, y and z; up to 1e6 cells"}},
      .columns =
          "time, cell, its middle, grains, density, volume fraction, mean velocity by mass, granular temperature, velocity "
          "variance",
      .source = "granular temperature about the velocity gradient of the cell: Glasser and Goldhirsch, Phys. Fluids 13 (2001) 407",
      .read = [](const TomlTable& table, const Scene& scene) -> MeasurementMaker {
        const SamplingRegion region(table, scene, SamplingRegion::Without::Refused);
        const CellCounts cells = read_cells(table);
        return lines_of(
            "time_s,cell_x,cell_y,cell_z,x_m,y_m,z_m,grains,density_kg/m3,volume_fraction,velocity_x_m/s,velocity_y_m/s,"
            "velocity_z_m/s,granular_temperature_m2/s2,velocity_variance_m2/s2",
            [=](const Sample& sample, TableText& lines) { measure_cells(sample, lines, region, cells); });
      }};
}

}  // namespace falling_particles
