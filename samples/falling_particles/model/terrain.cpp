#include "terrain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/random.hpp"

namespace falling_particles {

using namespace common;
namespace {

constexpr std::array kRelativeAmplitudes = {1.0, 1.0 / 4, 1.0 / 16};
constexpr std::array kRelativeLengths = {1.0, 1.0 / 2, 1.0 / 4, 1.0};  // of the three waves and the ridges

struct Cell {
  std::size_t index;  // index of the lower sample
  double share;       // fraction of the distance to the next sample
};

Cell find_cell(double x, double spacing, std::size_t per_side) {
  const double position = x / spacing + 1;  // the first sample lies one cell outside the wall
  const double cell = std::clamp(std::floor(position), 0.0, static_cast<double>(per_side - 2));
  return {static_cast<std::size_t>(cell), position - cell};
}

}  // namespace

Landscape::Landscape(const TerrainParameters& parameters)
    : amplitude_(parameters.amplitude), ridge_height_(parameters.ridge_height), waves_() {
  Random random(parameters.seed);
  for (std::size_t k = 0; k < waves_.size(); ++k) {
    const double length = parameters.wavelength * kRelativeLengths[k];
    const double direction = 2 * std::numbers::pi * random.uniform();
    waves_[k] = {std::cos(direction) / length, std::sin(direction) / length, random.uniform()};
  }
}

double Landscape::height(double x, double y) const {
  double sum = 0;
  for (std::size_t k = 0; k < kRelativeAmplitudes.size(); ++k) {
    sum += amplitude_ * kRelativeAmplitudes[k] * std::sin(2 * std::numbers::pi * waves_[k].turns(x, y));
  }
  const double turns = waves_.back().turns(x, y);
  const double from_crest = std::abs(turns - std::round(turns));  // in wavelengths
  return sum + ridge_height_ * std::max(0.0, 1 - 4 * from_crest);
}

Terrain::Terrain(const TerrainParameters& parameters)
    : parameters_(parameters), per_side_(static_cast<std::size_t>(parameters.samples) + 2), spacing_() {
  for (std::size_t axis : {0U, 1U}) spacing_[axis] = parameters.width[axis] / (parameters.samples - 1);
  const Landscape landscape(parameters);
  heights_.reserve(per_side_ * per_side_);
  for (std::size_t j = 0; j < per_side_; ++j) {
    for (std::size_t i = 0; i < per_side_; ++i) {
      heights_.push_back(landscape.height((static_cast<double>(i) - 1) * spacing_[0], (static_cast<double>(j) - 1) * spacing_[1]));
    }
  }
  const auto [lowest, highest] = std::ranges::minmax(heights_);
  lowest_ = lowest;
  highest_ = highest;
}

double Terrain::height(double x, double y) const {
  const auto [i, u] = find_cell(x, spacing_[0], per_side_);
  const auto [j, v] = find_cell(y, spacing_[1], per_side_);
  const double origin = sample(i, j);
  const double far = sample(i + 1, j + 1);
  if (u > v) return origin + u * (sample(i + 1, j) - origin) + v * (far - sample(i + 1, j));
  return origin + v * (sample(i, j + 1) - origin) + u * (far - sample(i, j + 1));
}

Region Terrain::room() const { return {{0, 0, lowest_}, {parameters_.width[0], parameters_.width[1], INFINITY}}; }

bool Terrain::contains(const Point& p) const { return plan().contains(p[0], p[1]) && p[2] > height(p[0], p[1]) && p[2] < INFINITY; }

}  // namespace falling_particles
