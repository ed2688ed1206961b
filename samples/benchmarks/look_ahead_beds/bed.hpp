// A bed of grains of one kind, the common start of all simulations, and its simulation in an engine.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace look_ahead_beds {

inline constexpr double kDensity = 1300;             // kg/m^3
inline constexpr double kGravity = 9.81;             // m/s^2
inline constexpr double kFriction = 0.5;             // Coulomb coefficient of all surfaces
inline constexpr double kSmallestHalfAxis = 2.5e-3;  // m; of the mean grain; the unit of overlaps

struct Pose {
  std::array<double, 3> position{};    ///< m
  std::array<double, 4> quaternion{};  ///< unit; w, x, y, z
};

struct Grain {
  std::array<double, 3> half_axes{};  ///< m
  Pose start;
};

/// Grains above the floor z = 0, between the walls |x|, |y| = half_width.
struct Bed {
  double exponent = 2;  ///< of both sections
  double half_width = 0;
  std::vector<Grain> grains;

  /// The five walls, (normal, distance) as in dCreatePlane.
  std::array<std::array<double, 4>, 5> walls() const {
    return {{{0, 0, 1, 0}, {1, 0, 0, -half_width}, {-1, 0, 0, -half_width}, {0, 1, 0, -half_width}, {0, -1, 0, -half_width}}};
  }
};

struct Settings {
  double step = 1e-3;  ///< s
  int iterations = 40;
};

class Simulation {
 public:
  Simulation() = default;
  virtual ~Simulation() = default;
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  virtual void step() = 0;
  virtual Pose pose(std::size_t grain) const = 0;
};

/// Sequential impulses of Bullet, with ellipsoids by their support function. The exponent must be 2.
std::unique_ptr<Simulation> start_bullet(const Bed& bed, const Settings& settings);

}  // namespace look_ahead_beds
