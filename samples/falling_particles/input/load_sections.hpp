// Reads the sections of a scene file.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/toml_input.hpp"
#include "common/mesh.hpp"
#include "model/scene.hpp"

namespace falling_particles {

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

}  // namespace falling_particles
