// What a picture shows of a run.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "container/geometry.hpp"
#include "measure/energy.hpp"
#include "scene/scene.hpp"

namespace falling_particles {

class Stepper;

/// A body at one time, in the world's frame.
struct BodyState {
  Point position;                    ///< m, of the centre
  std::array<double, 4> quaternion;  ///< w, x, y, z; unit: from the body's frame to the world's
  Point velocity;                    ///< m/s
  Point angular_velocity;            ///< rad/s
};

/// A contact of the last step, in the world's frame.
struct ContactState {
  Point position;  ///< m
  Point normal;    ///< unit, towards body 1, as in dContactGeom
  double depth;    ///< m
  int body1;       ///< index of the body; kWall for a wall
  int body2;
};

inline constexpr int kWall = -1;

/// One moment of a run. The bodies are those of the scene, always in the same order.
struct Frame {
  double time = 0;  ///< s
  std::vector<BodyState> bodies;
  std::vector<ContactState> contacts;  ///< of the step that led to this moment; none at the start. Those of a pair are consecutive
  Energy energy;
};

/// The bodies of a run: what does not change from frame to frame. The scene must outlive it.
struct Cast {
  const Scene* scene;
  std::vector<std::size_t> kinds;  ///< of each body: index into scene->grains
};

Cast cast_of(const World& world, const Scene& scene);

/// `stepper`: null at the start, before the first step.
Frame frame_of(double time, const World& world, const Scene& scene, const Stepper* stepper);

}  // namespace falling_particles
