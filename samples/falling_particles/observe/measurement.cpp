#include "measurement.hpp"

#include <algorithm>

#include "measurement_kinds.hpp"  // made by CMake: MEASUREMENT_KINDS(KIND) is KIND(name) for each measurement of its list

namespace falling_particles {
namespace {

using LineWriter = std::function<void(const Sample& sample, TableText& table)>;

class Lines final : public Measurement {
 public:
  Lines(std::string columns, LineWriter write) : columns_(std::move(columns)), write_(std::move(write)) {}
  std::string columns() const override { return columns_; }
  void measure(const Sample& sample, TableText& table) const override { write_(sample, table); }

 private:
  std::string columns_;
  LineWriter write_;
};

}  // namespace

MeasurementMaker lines_of(std::string columns, LineWriter write) {
  return [columns = std::move(columns), write = std::move(write)](const World&) { return std::make_unique<Lines>(columns, write); };
}

#define DECLARE(name) MeasurementKind name##_kind();
MEASUREMENT_KINDS(DECLARE)
#undef DECLARE

const std::vector<MeasurementKind>& measurement_kinds() {
  static const std::vector<MeasurementKind> kinds = [] {
#define MAKE(name) name##_kind(),
    std::vector<MeasurementKind> all = {MEASUREMENT_KINDS(MAKE)};
#undef MAKE
    for (MeasurementKind& kind : table_kinds()) all.push_back(std::move(kind));
    return all;
  }();
  return kinds;
}

const MeasurementKind* find_measurement_kind(std::string_view name) {
  const auto found = std::ranges::find(measurement_kinds(), name, &MeasurementKind::name);
  return found == measurement_kinds().end() ? nullptr : &*found;
}

std::string list_measurements() {
  std::string text;
  for (const MeasurementKind& kind : measurement_kinds()) {
    if (kind.on_by_default) continue;
    text += "[[measurement]] kind = \"" + kind.name + "\"\n  measures    " + kind.measures + '\n';
    for (const MeasurementParameter& parameter : kind.parameters) {
      text += std::string("  ") + (&parameter == &kind.parameters.front() ? "parameters  " : "            ") + parameter.key +
              ": " + parameter.text + '\n';
    }
    text += "  columns     " + kind.columns + '\n';
    const std::string steps = kind.follows ? "all" : "the sampled";
    text += "  cost        " +
            (kind.needs_contacts ? "the forces of " + steps + " steps' joints" : "a pass over the grains in " + steps + " steps") +
            "\n  source      " + kind.source + '\n';
  }
  return text;
}

std::string list_tables() {
  std::string text;
  for (const MeasurementKind& kind : measurement_kinds()) {
    if (!kind.on_by_default) continue;
    text += default_file(kind) + "\n  measures    " + kind.measures + "\n  lines       one for " + kind.on_by_default->lines +
            "; of " + kind.on_by_default->scenes + "\n  columns     " + kind.columns + '\n';
  }
  return text;
}

}  // namespace falling_particles
