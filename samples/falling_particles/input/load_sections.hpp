// Reads the sections of a scene file.
#pragma once

#include <optional>
#include <string>
#include <supernormal/effects.hpp>
#include <utility>
#include <vector>

#include "base/toml_input.hpp"
#include "common/mesh.hpp"
#include "common/motion.hpp"
#include "model/scene.hpp"

namespace falling_particles {

Vector3 read_vector(const TomlTable& table, const char* key, const Interval& allowed);

/// Reads a direction of any length but 0, and returns its unit vector.
Vector3 read_direction(const TomlTable& table, const char* key);

/// Reads `corner` and `size` (m).
Region read_region(const TomlTable& table);

/// The most revolutions of a wall in a step. The mean velocity of a step assumes the smaller rotation.
inline constexpr double kLargestTurn = 0.1;

/// Reads `rpm`, revolutions per minute, up to kLargestTurn in a step.
double read_rpm(const TomlTable& table, const Time& time);

/// Reads `from` and `until` (s); 0 and infinity if they are not given.
std::pair<double, double> read_times(const TomlTable& table);

/// Reads the motions of a wall. Throws InputError.
std::vector<WallMotion> read_motions(const TomlTable& part, const Time& time);

/// Reads `free` of a part, if it has one. The part's shape, pose, motions and drive must have been read. Throws InputError.
std::optional<Flight> read_flight(const TomlTable& part, const Wall& wall, const Time& time);

/// Reads `drive` of a part, if it has one. The part's shape, pose and motions must have been read. A plane pushes along its normal
/// unless the drive has an axis. A servo without an area is between the walls of `between`, or those that load_servos() reads if
/// there are none. Throws InputError.
std::optional<Drive> read_drive(const TomlTable& part, const Wall& wall, const std::vector<FacingWalls>& between);

/// Reads the walls between which servos are. All walls of the scene must have been read. Throws InputError.
void load_servos(const TomlTable& root, Scene& scene);

/// Reads the [container] of a scene file. Throws InputError.
Container read_container(const TomlTable& root, const Time& time);

/// Throws InputError unless the container has space for all grains of the start.
void check_fit(const TomlTable& root, const Scene& scene);

/// The walls of the container, then the walls of the [[part]] sections. Mesh files are relative to the scene's folder. Throws
/// InputError.
std::vector<Wall> load_walls(const TomlTable& root, const Scene& scene, const std::string& scene_path);

/// The tables of all walls that have one, with indices into Scene::walls.
std::vector<std::pair<TomlTable, std::size_t>> tables_of_walls(const TomlTable& root, const Scene& scene);

/// Reads the section [solver]. Throws InputError.
Solver load_solver(const TomlTable& root);

/// Throws InputError if the scene has the stepper, and something besides effects that only quickstep moves. The scene's container,
/// walls, bonds and periodic axes must have been read.
void refuse_for_stepper(const TomlTable& root, const Scene& scene);

/// Reads `size` of a [[grain]], if it has one. Throws InputError. The result is the distribution of the factor on all lengths of
/// the grain. `sieve_size` (m) is its sieve size in the catalogue.
std::optional<SizeDistribution> load_sizes(const TomlTable& entry, double sieve_size);

/// Reads the section [start] and the file that it names, a path relative to the scene's folder. Empty without the section. Throws
/// InputError, which names file, line and column.
std::optional<StartState> load_start(const TomlTable& root, const std::vector<GrainCount>& kinds, const std::string& scene_path);

/// Starts the walls of a scene where the last frame of start.parts has them, a table parts.csv. Throws InputError.
void place_walls(const TomlTable& root, const std::string& scene_path, std::vector<Wall>& walls);

/// Reads the axes along which a scene repeats, and removes the walls of the container that close it there. The scene's container,
/// walls and grains must have been read. Throws InputError, also when a wall is not uniform along such an axis.
void load_periodic(const TomlTable& root, Scene& scene);

/// Reads the sections [[bond]] and their files, whose paths are relative to the scene's folder. The scene's walls, grains and
/// periodic axes must have been read. Throws InputError.
void load_bonds(const TomlTable& root, const std::string& scene_path, Scene& scene);

/// Reads the sections [[feeder]]. The scene's container, grains and time must have been read. Throws InputError.
std::vector<Feeder> load_feeders(const TomlTable& root, const Scene& scene);

/// Reads the sections [[sink]]. Throws InputError.
std::vector<Sink> load_sinks(const TomlTable& root, const Scene& scene);

/// Reads the sections [[measurement]]. The scene's container, grains and time must have been read. Throws InputError.
std::vector<MeasurementRequest> load_measurements(const TomlTable& root, const Scene& scene);

extern "C" {

/// The sections besides parts, feeders and sinks. Below each section, or each kind of it, every key has a line with its unit, range
/// and default. A test compares the keys with those that the loader accepts.
extern const char kSectionsList[];

/// The shapes, motions and drives of [[part]] with their parameters, units and ranges.
extern const char kWallsList[];

/// The parameters of [[feeder]] and [[sink]] with units and ranges.
extern const char kPopulationList[];
}

/// The names of the sections of effects, from supernormal::effects.
std::vector<std::string> effect_sections();

/// The keys of an effect's section with their defaults, for users: the library's parameters and the additional keys of scenes.
std::string scene_parameters(const supernormal::effects::Description& effect);

/// Loads the effects whose sections the file has. Throws InputError. `smallest_half_axis` (m) is the unit of the depth of
/// [surface_layer]; `step` (s) and `solver` are the scene's.
std::vector<supernormal::effects::Effect> load_effects(const TomlTable& root, double smallest_half_axis, double step,
                                                       supernormal::effects::Solver solver);

/// Adds the effects of parts with coefficients of their own to the effects of the scene. Throws InputError if a coefficient
/// excludes one of these.
void load_wall_effects(const TomlTable& root, Scene& scene);

}  // namespace falling_particles
