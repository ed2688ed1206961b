// A run of a scene with some settings, and its outcome.
#pragma once

#include "scenes.hpp"

namespace quickstep_settings {

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
