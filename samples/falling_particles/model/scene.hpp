// A scene: the grains, their container, the effects and the settings of a run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <supernormal/effects.hpp>
#include <vector>

#include "axis.hpp"
#include "container.hpp"
#include "feeder.hpp"
#include "grain_kind.hpp"
#include "query.hpp"
#include "request.hpp"
#include "size_distribution.hpp"
#include "wall.hpp"

namespace falling_particles {

struct GrainCount {
  GrainKind kind;
  int count;
  std::optional<SizeDistribution> size = {};  ///< of the factor on the grain's lengths; all are 1 without one
  std::vector<double> scales = {};            ///< factors drawn, one a grain; none without a distribution
  bool is_fed = false;                        ///< whether feeders may bring more, whose factors are drawn during the run

  double scale(std::size_t index) const { return scales.empty() ? 1 : scales[index]; }
  double smallest_scale() const;
  double largest_scale() const;
};

/// The start of the grains: on a lattice whose cells hold the largest grain in any orientation, or smaller ones (lattice.hpp).
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
  int iterations;  ///< iterations of quickstep
  double erp;      ///< share of an overlap that a step removes
  double cfm;      ///< s/kg: softness of all constraints
};

/// The compression of the grains in a periodic container until they jam (compression.hpp).
struct Compression {
  double overlap;        ///< mean, relative to the distance of two grains that touch, that ends the compression; at the start
  double final_overlap;  ///< the same at the end
  double damping;        ///< share of all velocities that a step takes away
};

struct Scene {
  std::string name;  ///< name of the file, without folder and extension
  std::uint64_t seed;
  Container container;
  std::vector<GrainCount> kinds;
  Drop drop;
  Time time;
  Solver solver;
  std::vector<supernormal::effects::Effect> effects;  ///< those that the scene names, and no others
  std::optional<Compression> compression = {};        ///< for the grains in a periodic container
  std::vector<std::string> pictures = {};             ///< formats that a run leaves besides its tables (picture_names.hpp)
  bool forces = false;                                ///< whether pictures show the forces of the contacts
  std::vector<Wall> walls = {};                       ///< walls besides those of the container, or in its place
  std::optional<Query> query = {};                    ///< of two smooth bodies; the library's defaults if empty
  std::optional<Axis> sweep_axis = {};                ///< of the broad phase; chosen by the positions of the grains if empty
  std::vector<MeasurementRequest> measurements = {};  ///< those that the scene names, and no others
  std::vector<Feeder> feeders = {};                   ///< from which grains come during the run
  std::vector<Sink> sinks = {};                       ///< into which they go
  PeriodicAxes periodic = {};                         ///< along which it repeats, beside a container that does in all directions
  std::vector<std::string> overrides = {};            ///< values that were not the file's, KEY=VALUE each (toml_override.hpp)
  std::vector<std::filesystem::path> files = {};      ///< that it was loaded from: its own first, then those that it names

  /// Null when the scene names none.
  const supernormal::effects::Gravity* gravity() const;

  /// Whether it names speculative contacts, for which grains look ahead.
  bool looks_ahead() const;

  int grains_at_start() const;                       ///< at the start
  std::size_t kind_of(const GrainKind& kind) const;  ///< index into grains, of one of these objects
  /// Whether grains come or go during the run.
  bool changes_population() const { return !feeders.empty() || !sinks.empty(); }
  bool has_sizes() const;                  ///< whether any kind has a distribution of sizes
  bool has_compounds() const;              ///< whether any kind is a union of bodies
  double smallest_half_axis() const;       ///< m, over all grains
  double largest_bounding_radius() const;  ///< m, over all grains
  double smallest_cell() const;            ///< m, width and height of the cell that holds the largest grain
};

/// Whether a point may be the centre of a grain: in the container, or in a sink, beyond it or not. False for a NaN.
bool is_inside(const Scene& scene, const Point& point);

/// Loads a scene file, with values in place of its own (toml_override.hpp). Throws InputError.
Scene load_scene(const std::string& path, const std::vector<std::string>& overrides = {});

}  // namespace falling_particles
