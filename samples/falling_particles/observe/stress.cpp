// The measurement stress: the stress of a box or of slices.

#include <Eigen/Dense>
#include <cmath>

#include "measurement.hpp"
#include "region.hpp"
#include "world/grain.hpp"

namespace falling_particles {
namespace {

using Eigen::Matrix3d;

/// Sums over a slice.
struct SliceSums {
  Matrix3d contacts = Matrix3d::Zero();  // N m
  Matrix3d momentum = Matrix3d::Zero();  // kg m^2/s^2, sum of m v v^T
  Vector3 velocity = Vector3::Zero();    // kg m/s, sum of m v
  double mass = 0;                       // kg
  double volume = 0;                     // m^3, of the grains
  std::size_t grains = 0;
};

Bounds slice_of(const Bounds& all, Eigen::Index axis, std::size_t index, std::size_t count) {
  Bounds slice = all;
  const auto at = [&](std::size_t k) {
    return std::lerp(all.lower[axis], all.upper[axis], static_cast<double>(k) / static_cast<double>(count));
  };
  slice.lower[axis] = at(index);
  slice.upper[axis] = at(index + 1);
  return slice;
}

/// Adds a contact's force to a slice. It acts along the branch: through grain 1 from its centre to the contact, and through grain 2
/// to its centre.
void add_contact(SliceSums& sums, const Bounds& slice, const PairContact& contact, const Vector3& periods) {
  const Vector3 way1 = contact.centre1 - contact.position;
  const Vector3 way2 = contact.position - contact.centre2;
  const double share1 = share_of_images(slice, contact.centre1, contact.position, periods);
  const double share2 = contact.grain2 == nullptr ? 0 : share_of_images(slice, contact.position, contact.centre2, periods);
  if (share1 == 0 && share2 == 0) return;
  sums.contacts += contact.force * (share1 * way1 + share2 * way2).transpose();
}

void add_grain(SliceSums& sums, const Grain& grain) {
  const Vector3 velocity = to_vector(grain.velocity());
  sums.mass += grain.mass.mass;
  sums.volume += grain.volume();
  sums.velocity += grain.mass.mass * velocity;
  sums.momentum += grain.mass.mass * velocity * velocity.transpose();
  ++sums.grains;
}

std::string stress_columns(const SamplingRegion& region) {
  std::string text = "time_s,slice,lower_m,upper_m,grains";
  for (const char* prefix : {"contact", "kinetic"}) {
    for (const char* entry : {"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"}) {
      text += std::string(",") + prefix + '_' + entry + "_Pa";
    }
  }
  text += ",pressure_Pa,deviator_Pa,volume_fraction";
  if (region.start_lengths()) text += ",length_x_m,length_y_m,length_z_m,strain_x,strain_y,strain_z,volumetric_strain";
  return text;
}

void write(const SliceSums& sums, double volume, TableText& table) {
  const Matrix3d contact = sums.contacts / volume;
  Matrix3d kinetic = Matrix3d::Zero();
  if (sums.mass > 0) kinetic = (sums.momentum - sums.velocity * sums.velocity.transpose() / sums.mass) / volume;
  const Matrix3d total = contact + kinetic;
  const double pressure = total.trace() / 3;
  const Matrix3d deviator = (total + total.transpose()) / 2 - pressure * Matrix3d::Identity();
  for (const Matrix3d& stress : {contact, kinetic}) {
    for (Eigen::Index row = 0; row < 3; ++row) table.add(Vector3(stress.row(row)));
  }
  table.add(pressure).add(std::sqrt(1.5) * deviator.norm()).add(sums.volume / volume);
}

void write_strain(const Vector3& lengths, const Vector3& at_start, TableText& table) {
  const Vector3 strain = (at_start.array() / lengths.array()).log();
  table.add(lengths).add(strain).add(strain.sum());
}

void measure_stress(const Sample& sample, TableText& table, const SamplingRegion& region, Eigen::Index axis, std::size_t slices) {
  const Bounds all = region.bounds(sample.world);
  const Vector3 periods = periods_of(sample.world);
  for (std::size_t index = 0; index < slices; ++index) {
    const Bounds slice = slice_of(all, axis, index, slices);
    SliceSums sums;
    for (const PairContact& contact : sample.contacts) add_contact(sums, slice, contact, periods);
    for (const Grain& grain : sample.world.present()) {
      if (slice.contains(place_of(grain, sample.world))) add_grain(sums, grain);
    }
    table.add(sample.time).add(index).add(slice.lower[axis]).add(slice.upper[axis]).add(sums.grains);
    write(sums, slice.volume(), table);
    if (region.start_lengths()) write_strain(all.upper - all.lower, *region.start_lengths(), table);
    table.end_line();
  }
}

}  // namespace

MeasurementKind stress_kind() {
  constexpr std::int64_t kMostSlices = 1000;
  return {.name = "stress",
          .measures = "the stress tensor of a box or of slices of it, pressure positive",
          .parameters = {{"lower, upper",
                          "m, corners of the box, which should lie within the container; without them all of a periodic cell"},
                         {"between",
                          "in place of lower and upper: six names of walls that face each other two by two, across x, y and z; the "
                          "box follows them"},
                         {"axis", "x, y or z, across which the box is sliced; z without it"},
                         {"slices", "1 to 1000, of equal thickness; 1 without it"}},
          .columns =
              "time, slice, its ends, grains; contact part and kinetic part, nine components each; pressure, deviator, volume "
              "fraction of "
              "the grains with centres inside; with between: lengths, logarithmic strains along x, y and z, their sum",
          .source =
              "Love 1927, Weber 1966; a slice takes the fraction of each branch that is in it: Weinhart et al., Granular "
              "Matter 14 (2012)",
          .needs_contacts = true,
          .read = [](const TomlTable& table, const Scene& scene) -> MeasurementMaker {
            const SamplingRegion region(table, scene, SamplingRegion::Without::Refused);
            const std::size_t axis = table.has("axis") ? read_axis(table, "axis") : 2;
            const std::int64_t slices = table.has("slices") ? table.integer("slices", 1, kMostSlices) : 1;
            return lines_of(stress_columns(region), [=](const Sample& sample, TableText& lines) {
              measure_stress(sample, lines, region, static_cast<Eigen::Index>(axis), static_cast<std::size_t>(slices));
            });
          },
          .plotted = {"pressure_Pa", "deviator_Pa"},
          .plot_label = "stress, Pa"};
}

}  // namespace falling_particles
