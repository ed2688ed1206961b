// A scene: kinds of grains, container, walls, effects and settings of a run.
#pragma once

#include <supernormal/supernormal.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <supernormal/effects.hpp>
#include <vector>

#include "bond.hpp"
#include "container.hpp"
#include "feeder.hpp"
#include "geometry.hpp"
#include "grain_kind.hpp"
#include "size_distribution.hpp"
#include "wall.hpp"

namespace falling_particles {

/// A grain of a state.
struct StartGrain {
  std::size_t kind = 0;                             ///< index into Scene::kinds
  double scale = 1;                                 ///< factor on the lengths of the kind
  Point position = {};                              ///< m
  std::array<double, 4> quaternion = {1, 0, 0, 0};  ///< w, x, y, z
  Point velocity = {};                              ///< m/s
  Point angular_velocity = {};                      ///< rad/s
  unsigned line = 0;                                ///< of the file
  std::size_t number = 0;                           ///< in the file: its column body, or its place from 0
};

/// The section [start] of a scene file, checked but for overlaps (refuse_bad_state).
struct StartState {
  std::filesystem::path file = {};
  std::optional<double> time = {};  ///< s, of the run that wrote the file
  bool has_velocities = false;      ///< whether the file has any; without them all grains start at rest
  double overlap = 0;               ///< the deepest allowed overlap, relative to the smallest half-axis of the smaller grain
  std::vector<StartGrain> grains = {};

  double largest_speed() const;  ///< m/s
};

class Measurement;
class World;

/// Makes a measurement for a world that has made no step.
using MeasurementMaker = std::function<std::unique_ptr<Measurement>(const World&)>;

/// A section [[measurement]] of a scene file, checked.
struct MeasurementRequest {
  std::string name;  ///< of its table, measurements/NAME.csv
  std::string kind;  ///< in measurement_kinds()
  int every;         ///< steps between two samples; samples are at multiples of it from `first` to `last`
  int first;         ///< in steps; at step 0 only kinds that need no contacts have a sample
  int last;
  bool needs_contacts;
  MeasurementMaker make;

  bool is_due(int step) const { return step % every == 0 && step >= first && step <= last; }
  bool follows(int step) const { return step > first && step <= last; }  ///< if the kind follows the run
};

struct GrainCount {
  GrainKind kind;
  int count;
  std::optional<SizeDistribution> size = {};  ///< of the factor on the grain's lengths; without one all factors are 1
  std::vector<double> scales = {};            ///< the factor of each grain, drawn or of a state; empty without a distribution
  bool is_fed = false;                        ///< whether feeders may insert more grains; their factors are drawn during the run

  double scale(std::size_t index) const { return scales.empty() ? 1 : scales[index]; }
  double smallest_scale() const;
  double largest_scale() const;
};

/// The start of the grains on a lattice (lattice.hpp). Its cells hold the largest grain in any orientation, or smaller grains.
struct Drop {
  double height;  ///< m, height of the lowest cells above the floor, a hopper's outlet or a terrain's highest peak
  double gap;     ///< free space of a cell, relative to the largest grain; grains are placed at random within it
};

struct Time {
  double duration;  ///< s
  double step;      ///< s
  double frame;     ///< s, between two lines of output
  int steps() const;
  int steps_per_frame() const;
};

/// A step that remembers its contact forces, in place of quickstep (snStepperSetAccuracy).
struct Accuracy {
  double sag = 2e-3;  ///< largest overlap of a contact at rest, relative to the least radius of gyration of its bodies
  int least = 8;      ///< sub-steps of a step
  int most = 64;
};

struct Solver {
  static constexpr int kMostIterations = 100000;
  int iterations = 0;                    ///< iterations of quickstep
  double erp = 0;                        ///< fraction of an overlap that a step of quickstep removes
  double cfm = 0;                        ///< s/kg: softness of all constraints of quickstep
  std::optional<Accuracy> stepper = {};  ///< empty for quickstep

  supernormal::effects::Solver solves_contacts() const {
    return stepper ? supernormal::effects::Solver::Stepper : supernormal::effects::Solver::QuickStep;
  }
};

/// The settings of all queries of two smooth bodies (snSetDefaultSolver, snSetWarmStart). Without a section [query] the library's
/// defaults hold.
struct Query {
  snSolver solver = SN_SOLVER_HYBRID;
  double tolerance = 1e-9;  ///< of the gap, relative to the smallest half-extent
  int max_evaluations = 1000;
  bool warm_start = true;  ///< whether a query starts from the last normal of its pair
};

std::string name_of(snSolver solver);

/// The compression of the grains in a periodic container until they jam (world/periodic_cell.hpp).
struct Compression {
  double overlap;        ///< mean, relative to the distance of two touching grains; target at the start
  double final_overlap;  ///< target at the end
  double damping;        ///< fraction of all velocities that a step removes
};

struct Scene {
  std::string name;         ///< name of the file without folder and extension
  std::string path = {};    ///< of the file, or where a text would be
  std::string called = {};  ///< in messages
  std::uint64_t seed;
  Container container;
  std::vector<GrainCount> kinds;
  Drop drop;
  Time time;
  Solver solver;
  std::vector<supernormal::effects::Effect> effects;  ///< the effects that the scene names, and no others
  std::optional<Compression> compression = {};        ///< of the grains in a periodic container
  std::vector<std::string> pictures = {};             ///< formats that a run writes besides its tables (kPictureNames)
  bool forces = false;                                ///< whether pictures show the forces of the contacts
  std::vector<Wall> walls = {};                       ///< of the container (walls_in), then of [[part]]
  std::optional<Query> query = {};                    ///< of two smooth bodies; the library's defaults if empty
  std::vector<MeasurementRequest> measurements = {};  ///< the measurements that the scene names, and no others
  std::vector<Feeder> feeders = {};                   ///< they insert grains during the run
  std::vector<Sink> sinks = {};                       ///< they remove grains during the run
  std::optional<StartState> start = {};               ///< in place of the lattice: the grains of a file
  std::vector<BondRule> bonds = {};                   ///< between grains of the start, and between grains and parts
  PeriodicAxes periodic = {};                         ///< axes along which the scene repeats; all empty for a periodic container
  std::vector<std::string> overrides = {};            ///< values that replace the file's, KEY=VALUE each (toml_override.hpp)
  std::vector<std::filesystem::path> files = {};      ///< the loaded files: the scene's own first, then those that it names

  /// Null when the scene names none.
  const supernormal::effects::Gravity* gravity() const;

  /// Whether grains look ahead: for speculative contacts, or for the stepper.
  bool looks_ahead() const;

  /// The walls of Scene::walls that messages call parts: all but the sides of a box, a hopper or a terrain, which come first.
  std::span<const Wall> parts() const;

  int grains_at_start() const;                       ///< at the start
  bool has_grains_of(const GrainCount& kind) const;  ///< at the start or by a feeder; `kind`: one of `kinds`
  std::size_t kind_of(const GrainKind& kind) const;  ///< index into kinds; the argument must be an element of it
  /// Whether grains are inserted or removed during the run.
  bool changes_population() const { return !feeders.empty() || !sinks.empty(); }
  bool has_sizes() const;                  ///< whether any kind has a distribution of sizes
  bool has_compounds() const;              ///< whether any kind is a compound
  double smallest_half_axis() const;       ///< m, over all grains
  double largest_bounding_radius() const;  ///< m, over all grains
  double smallest_cell() const;            ///< m, width and height of the cell that holds the largest grain
};

/// Whether a point may be the centre of a grain: it is in the container, or in a sink inside or outside the container. False for a
/// NaN.
bool is_inside(const Scene& scene, const Point& point);

/// Loads a scene file, with `overrides` in place of its own values (toml_override.hpp). Throws InputError.
Scene load_scene(const std::string& path, const std::vector<std::string>& overrides = {});

/// Loads the content of a scene file. `path` is where the file would be: it names the scene, and the paths in the scene are
/// relative to its folder. Scene::files has no entry for it.
Scene load_scene_text(const std::string& content, const std::string& path, const std::vector<std::string>& overrides = {});

/// The bytes that a run with this many grains needs in a bed. Measured in a bed of 5000 grains are 12 KiB per grain; the rest is
/// margin. A grain has 2 KiB of its own: body, geom, mass and start. In a bed of mixed grains, the bounding boxes of seven
/// neighbours meet its own. So it has 3.5 pairs, each with max_contacts of five (0.8 KiB). It has three contacts with their joints
/// (0.6 KiB). Quickstep has nine rows for it (0.3 KiB), or eighteen with rolling and spinning resistance.
double memory_needed(int grains);

/// The most grains for which memory_needed() is at most `bytes`.
int most_grains(double bytes);

/// Bytes: the machine's memory, or the limit of this process (ulimit -v, -d) if it is lower.
double memory_of_machine();

/// In the order in which they are listed for users. Each has an entry in picture_formats() (output/picture.hpp).
inline constexpr std::array<std::string_view, 6> kPictureNames = {"page", "glb", "lammps", "vtk", "povray", "plots"};

/// The formats that a run writes when its scene names none.
inline std::vector<std::string> default_pictures() { return {"page", "glb", "plots"}; }

}  // namespace falling_particles
