// What a picture shows of a run.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "container/geometry.hpp"
#include "scene/scene.hpp"

namespace falling_particles {

class Stepper;
class World;

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
};

/// A box along the axes.
struct Extent {
  Point least, most;  ///< m
};

/// The least box around spheres of that radius (m) about the bodies.
Extent extent_of(const Frame& frame, double radius);

/// What the bodies of a run are, which does not change from frame to frame. The scene must outlive it.
struct BodyKinds {
  const Scene* scene;
  std::vector<std::size_t> of_body;  ///< index into scene->grains

  const Grain& grain(std::size_t body) const { return scene->grains[of_body[body]].grain; }
};

BodyKinds kinds_of(const World& world, const Scene& scene);

/// `stepper`: null at the start, before the first step.
Frame frame_of(double time, const World& world, const Stepper* stepper);

}  // namespace falling_particles
