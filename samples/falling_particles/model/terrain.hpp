// An uneven ground between walls.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry.hpp"

namespace falling_particles {

struct TerrainParameters {
  std::array<double, 2> width;  ///< m, between the walls
  double amplitude;             ///< m, of the longest wave
  double wavelength;            ///< m, of the longest wave; also the distance between the ridges
  double ridge_height;          ///< m
  int samples;                  ///< from wall to wall, along x and along y
  std::uint64_t seed;           ///< of the directions and the phases
};

/// The landscape of which the terrain has samples:
///
///   z = sum over k = 0, 1, 2 of  amplitude 4^-k sin(2 pi (u_k / (wavelength 2^-k) + phase_k))
///     + ridge_height max(0, 1 - 4 d / wavelength)
///
/// with u_k = x cos alpha_k + y sin alpha_k. d is the distance from the nearest of the parallel crests u_3 / wavelength + phase_3 =
/// 0, 1, -1, 2 …: sharp crests on smooth waves. The seed determines alpha_k and phase_k.
class Landscape {
 public:
  explicit Landscape(const TerrainParameters& parameters);
  double height(double x, double y) const;  ///< m

 private:
  struct Wave {
    double per_x, per_y, phase;  // cycles per metre, cycles
    double turns(double x, double y) const { return per_x * x + per_y * y + phase; }
  };
  double amplitude_, ridge_height_;
  std::array<Wave, 4> waves_;
};

/// The ground: triangles over a landscape's samples on a grid, as ODE lays them. Each cell is divided by the diagonal from its
/// lowest x and y to its highest. The ground lies between walls of infinite height at x = 0, x = width[0], y = 0 and y = width[1].
/// The grid extends one sample beyond each wall, so that no grain meets the end of the ground.
class Terrain {
 public:
  explicit Terrain(const TerrainParameters& parameters);

  const TerrainParameters& parameters() const { return parameters_; }
  std::size_t samples_per_side() const { return per_side_; }       ///< those beyond the walls included
  std::array<double, 2> spacing() const { return spacing_; }       ///< m
  const std::vector<double>& samples() const { return heights_; }  ///< m, rows along x, from the lowest y on
  double sample(std::size_t i, std::size_t j) const { return heights_[j * per_side_ + i]; }  ///< m, at x_i and y_j
  double height(double x, double y) const;  ///< m, of the triangles; between the walls

  Rectangle plan() const { return {{0, 0}, parameters_.width}; }
  double lowest() const { return highest_; }  ///< m, lowest height at which grains may start: above the peaks
  Region room() const;
  bool contains(const Point& p) const;

 private:
  TerrainParameters parameters_;
  std::size_t per_side_;
  std::array<double, 2> spacing_;
  std::vector<double> heights_;
  double lowest_, highest_;  // m, of the heights
};

}  // namespace falling_particles
