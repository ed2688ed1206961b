// The measurement fabric: the directions of contacts.

#include <Eigen/Dense>
#include <cmath>

#include "measurement.hpp"
#include "region.hpp"

namespace falling_particles {
namespace {

using Eigen::Matrix3d;

void measure_fabric(const Sample& sample, TableText& table, const SamplingRegion& region, bool counts_walls) {
  const Bounds bounds = region.bounds(sample.world);
  Matrix3d F = Matrix3d::Zero();
  std::size_t contacts = 0;
  for (const PairContact& contact : sample.contacts) {
    if (!contact.bears_force() || !bounds.contains(contact.position)) continue;
    if (contact.grain2 == nullptr && !counts_walls) continue;
    F += contact.normal * contact.normal.transpose();
    ++contacts;
  }
  table.add(sample.time).add(contacts);
  if (contacts == 0) {
    constexpr int kOtherColumns = 13;
    table.blank(kOtherColumns).end_line();
    return;
  }
  F /= static_cast<double>(contacts);
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(F);
  const Vector3& values = solver.eigenvalues();  // in increasing order
  const Matrix3d deviator = 7.5 * (F - Matrix3d::Identity() / 3);
  table.add(F(0, 0)).add(F(1, 1)).add(F(2, 2)).add(F(0, 1)).add(F(0, 2)).add(F(1, 2));
  table.add(values[2]).add(values[1]).add(values[0]);
  table.add(Vector3(solver.eigenvectors().col(2))).add(std::sqrt(1.5) * deviator.norm()).end_line();
}

}  // namespace

MeasurementKind fabric_kind() {
  return {.name = "fabric",
          .measures = "the fabric tensor, the mean of n n over the normals n of force-bearing contacts",
          .parameters = {{"lower, upper", "m, corners of a box that holds the contacts; without them everywhere"},
                         {"walls", "true or false, whether contacts with walls count; false without it"}},
          .columns = "time, contacts, six components, eigenvalues, direction of the largest, anisotropy sqrt(3/2) |15/2 (F - I/3)|",
          .source = "Satake 1982; anisotropy: Guo and Zhao, Computers and Geotechnics 47 (2013)",
          .needs_contacts = true,
          .read = [](const TomlTable& table, const Scene& scene) -> MeasurementMaker {
            const SamplingRegion region(table, scene, SamplingRegion::Without::Everywhere);
            const bool walls = table.has("walls") && table.boolean("walls");
            return lines_of(
                "time_s,contacts,xx,yy,zz,xy,xz,yz,largest,middle,smallest,direction_x,direction_y,direction_z,anisotropy",
                [=](const Sample& sample, TableText& lines) { measure_fabric(sample, lines, region, walls); });
          },
          .plotted = {"anisotropy"},
          .plot_label = "anisotropy"};
}

}  // namespace falling_particles
