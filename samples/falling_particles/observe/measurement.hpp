// What a scene can measure of its grains.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/toml_input.hpp"
#include "model/request.hpp"
#include "model/scene.hpp"
#include "pair_contact.hpp"
#include "table_text.hpp"
#include "world/world.hpp"

namespace falling_particles {

/// A moment of a run.
struct Sample {
  double time;  ///< s
  const World& world;
  const std::vector<PairContact>& contacts;  ///< of the step that led to this moment; empty for kinds that do not need them
};

/// Writes lines about a moment. It keeps nothing from sample to sample: what a resumed run needs of it is MeasurementState.
class Measurement {
 public:
  Measurement() = default;
  virtual ~Measurement() = default;
  Measurement(const Measurement&) = delete;
  Measurement& operator=(const Measurement&) = delete;

  /// The names of the columns, units included, separated by commas; the first is time_s.
  virtual std::string columns() const = 0;
  virtual void measure(const Sample& sample, TableText& table) const = 0;
};

struct MeasurementParameter {
  std::string key;
  std::string text;  ///< unit, range, what it is without
};

/// A kind that a scene can name: [[measurement]] kind = "name".
struct MeasurementKind {
  std::string name;
  std::string measures;  ///< what it tells
  std::vector<MeasurementParameter> parameters;
  std::string columns;  ///< in words
  std::string source;   ///< of the definition
  bool needs_contacts;  ///< of the steps that it samples, whose joints then tell their forces
  /// Checks the section's parameters against the scene, of which the container, the grains and the time have been read. Throws
  /// InputError.
  MeasurementMaker (*read)(const TomlTable& table, const Scene& scene);
  std::vector<std::string> plotted = {};  ///< columns that are worth a plot over time, all of one unit
  std::string plot_label = {};            ///< of the plot's axis
};

/// All kinds, in the order in which they are listed for users.
const std::vector<MeasurementKind>& measurement_kinds();

/// Null if there is no such kind.
const MeasurementKind* find_measurement_kind(std::string_view name);

/// The list for users, as text.
std::string list_measurements();

}  // namespace falling_particles
