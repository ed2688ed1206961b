// Small worlds, and a run of one with some settings.
#pragma once

#include <array>
#include <vector>

#include "common/ode_world.hpp"

namespace quickstep_settings {

/// Bodies over a floor, z = 0.
class Scene {
 public:
  /// `size` is the smallest half-axis of the bodies, m.
  explicit Scene(double size);

  /// A body with half-axes 2, 1.4 and 1 times the size, and equal exponents. Position in sizes, density in kg/m^3.
  void add(double exponent, double density, std::array<double, 3> position, std::array<double, 4> quaternion = {1, 0, 0, 0});
  void add_walls(double half_width);  ///< in sizes

  common::OdeWorld& world() { return world_; }
  const std::vector<dBodyID>& bodies() const { return bodies_; }
  double size() const { return size_; }
  double mass() const;  ///< kg, of the first body

 private:
  double size_;
  common::OdeWorld world_;
  std::vector<dBodyID> bodies_;
};

void fill_brick(Scene& scene);   ///< a boxy body (exponents 20), dropped tilted
void fill_stack(Scene& scene);   ///< ten boxy bodies dropped on one another, slightly tilted
void fill_heavy(Scene& scene);   ///< likewise two boxy bodies, and on them a body that is twenty times as heavy
void fill_pebble(Scene& scene);  ///< an ellipsoid, dropped tilted
void fill_sunk(Scene& scene);    ///< a boxy body that starts 30 % of its smallest half-axis deep in the floor
void fill_grains(Scene& scene);  ///< forty grains, round and boxy, dropped between walls

/// ODE's defaults, with ODE's names unless said otherwise.
struct Settings {
  double step = 2e-3;  ///< s
  int iterations = 20;
  double erp = 0.2;
  double softness = 0;             ///< CFM times the mass of a body, over the step: 0.1 makes a contact 10 % softer than rigid
  double surface_layer = 0;        ///< relative to the smallest half-axis
  double correcting_velocity = 0;  ///< m/s; 0: unlimited
  double angular_damping = 0;      ///< fraction of the velocity that each step removes
  bool auto_disable = false;
  int average_samples = 1;
  double linear_threshold = 0.01;   ///< m/s
  double angular_threshold = 0.01;  ///< rad/s
};

struct Outcome {
  double speed;    ///< m/s; root mean square over the mass, in the second half of the time
  double overlap;  ///< the deepest overlap in the second half, relative to the smallest half-axis
  double asleep;   ///< s; when the last body fell asleep; negative: never
  double rise;     ///< largest height of a body's centre above its start, relative to the smallest half-axis
};

/// Steps the scene for a time, s.
Outcome run(Scene& scene, const Settings& settings, double time);

}  // namespace quickstep_settings
