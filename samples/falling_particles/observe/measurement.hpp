// The interface of measurements.
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

/// A run at one time.
struct Sample {
  double time;  ///< s
  const World& world;
  const std::vector<PairContact>& contacts;  ///< of the last step; empty for kinds that do not need them
};

/// Writes lines about a run at one time. It has no state from sample to sample: a resumed run needs only MeasurementState.
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
  std::string text;  ///< unit, range and default
};

/// A kind of measurement that a scene can name: [[measurement]] kind = "name".
struct MeasurementKind {
  std::string name;
  std::string measures;  ///< the measured quantity
  std::vector<MeasurementParameter> parameters;
  std::string columns;  ///< in words
  std::string source;   ///< reference of the definition
  bool needs_contacts;  ///< whether it needs the contacts of the sampled steps, with their forces
  /// Checks the section's parameters against the scene. The scene's container, grains and time must have been read. Throws
  /// InputError.
  MeasurementMaker (*read)(const TomlTable& table, const Scene& scene);
  std::vector<std::string> plotted = {};  ///< columns to plot over time, all of one unit
  std::string plot_label = {};            ///< of the plot's axis
};

/// All kinds, in the order of the list for users.
const std::vector<MeasurementKind>& measurement_kinds();

/// Null if there is no such kind.
const MeasurementKind* find_measurement_kind(std::string_view name);

/// The list for users, as text.
std::string list_measurements();

}  // namespace falling_particles
