// Measurements and their kinds.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/toml_input.hpp"
#include "common/interval.hpp"
#include "model/scene.hpp"
#include "pair_contact.hpp"
#include "world/world.hpp"

namespace falling_particles {

using namespace common;

/// Builds the lines of a table. Numbers are written as the shortest text that reads back exactly.
class TableText {
 public:
  TableText& add(double value) { return add(std::string_view(shortest(value))); }
  TableText& add(std::size_t value) { return add(std::string_view(std::to_string(value))); }
  TableText& add(const Eigen::Vector3d& v) { return add(v[0]).add(v[1]).add(v[2]); }
  TableText& add(const Eigen::Quaterniond& q) { return add(q.w()).add(q.vec()); }
  template <std::size_t Count>
  TableText& add(const std::array<double, Count>& values) {
    for (const double value : values) add(value);
    return *this;
  }
  /// Adds an empty field for a missing value.
  TableText& add(const std::optional<double>& value) { return value ? add(*value) : blank(); }
  TableText& add(std::string_view field) {
    if (!is_start_) text_ += ',';
    text_ += field;
    is_start_ = false;
    return *this;
  }
  /// Adds empty fields for missing values.
  TableText& blank(int count = 1) {
    for (int i = 0; i < count; ++i) add(std::string_view());
    return *this;
  }
  void end_line() {
    text_ += '\n';
    is_start_ = true;
    ++lines_;
  }

  const std::string& text() const { return text_; }
  std::size_t lines() const { return lines_; }

 private:
  std::string text_;
  std::size_t lines_ = 0;
  bool is_start_ = true;
};

/// A number on each triangle of some walls, for pictures.
struct TriangleField {
  std::string name;
  std::vector<std::vector<double>> of_walls;  ///< in the order of the triangles; empty for walls without numbers

  bool operator==(const TriangleField&) const = default;

  void serialize(auto& archive) { archive(name, of_walls); }
};

class Simulation;

/// A run at one time.
struct Sample {
  double time;  ///< s
  const World& world;
  const std::vector<PairContact>& contacts;  ///< of the last step; empty for kinds that do not need them
  const Simulation* simulation = nullptr;    ///< the simulation of the world; never null in a run
  std::size_t lines = 0;                     ///< number of lines that the table has already
};

/// Writes lines about a run at one time. Most measurements know only this time. One of a kind that follows the run also has a
/// memory, which a resumed run restores.
class Measurement {
 public:
  virtual ~Measurement() = default;

  /// The names of the columns, units included, separated by commas.
  virtual std::string columns() const = 0;
  virtual void measure(const Sample& sample, TableText& table) const = 0;

  /// Called once, after the step at which the measurement begins, before its first sample; after the start for the first step.
  virtual void begin(const Sample& /*sample*/) {}
  /// Called after each later step, before the sample of the step. `contacts` of the sample are empty; the stepper has the forces if
  /// the kind needs them.
  virtual void follow(const Sample& /*sample*/) {}
  /// Called after measure(), with the same sample.
  virtual void forget(const Sample& /*written*/) {}
  /// Whether events wait for the next sample, of a table that has a line for each event. The end of a run writes them.
  virtual bool has_unwritten() const { return false; }
  /// The bytes of a line of such a table; 0 for other tables.
  virtual double bytes_of_event() const { return 0; }
  /// What pictures show on the walls of the scene, the most important one first. None for most measurements.
  virtual std::vector<TriangleField> fields() const { return {}; }
  /// The memory as bytes, and back.
  virtual std::string save() const { return {}; }
  virtual void restore(const std::string& /*memory*/) {}
};

/// Makes measurements without a memory. `columns` are their names as in Measurement, `write` is Measurement::measure().
MeasurementMaker lines_of(std::string columns, std::function<void(const Sample& sample, TableText& table)> write);

struct MeasurementParameter {
  std::string key;
  std::string text;  ///< unit, range and default
};

/// The scenes in which a kind is on without a section. Its table is NAME.csv.
struct OnByDefault {
  std::string lines;   ///< what each line is about
  std::string scenes;  ///< the scenes, in words
  bool (*is_on)(const Scene& scene);
  MeasurementMaker make;
  bool is_of_end = false;  ///< whether it has one sample, at the end of the run, and not one in each frame
};

/// A kind of measurement. A scene requests it by a section [[measurement]] with kind = "name".
struct MeasurementKind {
  std::string name;
  std::string measures;                               ///< the measured quantity
  std::vector<MeasurementParameter> parameters = {};  ///< of the section
  std::string columns;                                ///< in words; their names if the kind may be on by default
  std::string source = {};                            ///< reference of the definition
  bool needs_contacts = false;                        ///< whether it needs the contacts of the sampled steps, with their forces
  bool follows = false;                               ///< whether it needs every step from `from` to `until` (Measurement::follow)
  /// Checks the section's parameters against the scene. The scene's container, grains and time must have been read. Throws
  /// InputError.
  std::function<MeasurementMaker(const TomlTable& table, const Scene& scene)> read;
  std::vector<std::string> plotted = {};  ///< columns to plot over time, all of one unit
  std::string plot_label = {};            ///< of the plot's axis
  std::optional<OnByDefault> on_by_default = {};

  bool is_on(const Scene& scene) const { return on_by_default && on_by_default->is_on(scene); }
};

/// All kinds: first the measurements that a scene must request, then the tables that are on by default, each in the order of the
/// list for users.
const std::vector<MeasurementKind>& measurement_kinds();

/// The kinds that are on by default (tables.cpp).
std::vector<MeasurementKind> table_kinds();

/// Null if there is no such kind.
const MeasurementKind* find_measurement_kind(std::string_view name);

/// The name of the table of a kind that is on by default.
inline std::string default_file(const MeasurementKind& kind) { return kind.name + ".csv"; }

/// The list of the measurements that a scene must request, for users, as text.
std::string list_measurements();

/// The list of the tables that are on by default, for users, as text.
std::string list_tables();

}  // namespace falling_particles
