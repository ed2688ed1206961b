#pragma once

#include <cstdint>
#include <string>
#include <supernormal/effects.hpp>
#include <vector>

#include "container/container.hpp"
#include "grain.hpp"
#include "simulation/sweep_space.hpp"

namespace falling_particles {

struct GrainCount {
  Grain grain;
  int count;
};

/// How the grains start: on a lattice whose cells hold the largest grain in any attitude.
struct Drop {
  double height;  ///< m, of the lowest cells above the floor, a hopper's outlet or a terrain's highest peak
  double gap;     ///< free part of a cell, relative to the largest grain; the grains are placed at random within it
};

struct Time {
  double duration;  ///< s
  double step;      ///< s
  double frame;     ///< s, between two lines of output
  int steps() const;
  int steps_per_frame() const;
};

struct Solver {
  int iterations;  ///< of quickstep
  double erp;      ///< share of an overlap that a step removes
  double cfm;      ///< s/kg: softness of all constraints
};

/// Of the grains in a periodic container, until they jam (compression.hpp).
struct Compression {
  double overlap;        ///< mean, relative to the distance of two grains that touch, that ends the compression; at the start
  double final_overlap;  ///< and at the end
  double damping;        ///< share of all velocities that a step takes away
};

struct Scene {
  std::string name;  ///< of the file, without folder and extension
  std::uint64_t seed;
  Container container;
  std::vector<GrainCount> grains;
  Drop drop;
  Time time;
  Solver solver;
  std::vector<supernormal::effects::Effect> effects;  ///< those that the scene names; nothing else exists for it
  std::optional<Compression> compression = {};        ///< of the grains in a periodic container
  std::optional<Axis> sweep_axis = {};                ///< of the broad phase; chosen from where the grains are if there is none

  /// Null when the scene names none.
  const supernormal::effects::Gravity* gravity() const;

  int bodies() const;
  double smallest_half_axis() const;       ///< m, of all grains
  double largest_bounding_radius() const;  ///< m, of all grains
  double smallest_cell() const;            ///< m, width and height of the cell that holds the largest grain
};

/// Throws InputError.
Scene load_scene(const std::string& path);

}  // namespace falling_particles
