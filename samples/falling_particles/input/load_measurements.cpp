#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "common/nearest_word.hpp"
#include "load_sections.hpp"
#include "observe/measurement.hpp"

namespace falling_particles {
namespace {

const MeasurementKind& read_kind(const TomlTable& table) {
  std::vector<std::string> names;
  for (const MeasurementKind& kind : measurement_kinds()) names.push_back(kind.name);
  return *find_measurement_kind(table.choice("kind", names));
}

/// The keys of a kind's parameters. Some are described together: "lower, upper".
std::vector<std::string> keys_of(const MeasurementKind& kind) {
  std::vector<std::string> keys = {"kind", "name", "interval", "from", "until"};
  for (const MeasurementParameter& parameter : kind.parameters) {
    for (std::size_t at = 0; at < parameter.key.size();) {
      const std::size_t end = std::min(parameter.key.find(", ", at), parameter.key.size());
      keys.push_back(parameter.key.substr(at, end - at));
      at = end + 2;
    }
  }
  return keys;
}

/// The name is also the name of a file.
std::string read_name(const TomlTable& table, const MeasurementKind& kind) {
  if (!table.has("name")) return kind.name;
  constexpr std::size_t kLongest = 64;
  std::string name = table.text("name");
  const bool is_plain = name.find_first_not_of(kNameCharacters) == std::string::npos;
  if (!is_plain || name.size() > kLongest) {
    table.refuse("name", " is \"" + name + "\"; allowed: up to 64 letters, digits, - and _");
  }
  return name;
}

int read_every(const TomlTable& table, const Time& time) {
  const double interval =
      table.number("interval", Interval::closed(time.step, time.duration, "s, a multiple of time.step (up to time.duration)"));
  const double steps = std::round(interval / time.step);
  constexpr double kRounding = 1e-6;  // tolerance for typed numbers: a step of 0.000333 and an interval of 0.00999 agree to this
  if (std::abs(interval - steps * time.step) > kRounding * time.step) {
    table.refuse("interval", " is " + shortest(interval) + "; allowed: a multiple of time.step, " + shortest(time.step) + " s");
  }
  return static_cast<int>(steps);
}

/// Samples are at multiples of the interval; contacts have forces from the first step on.
void refuse_without_sample(const TomlTable& table, const MeasurementRequest& request, double step) {
  const int first = request.needs_contacts ? std::max(request.first, 1) : request.first;
  if ((first + request.every - 1) / request.every * request.every <= request.last) return;
  table.refuse("interval", " is " + shortest(request.every * step) +
                               ", and the measurement has no sample: no multiple of it is from " + shortest(first * step) + " to " +
                               shortest(request.last * step) + " s; allowed: an interval with a multiple from " +
                               table.full_name("from") + " to " + table.full_name("until"));
}

}  // namespace

std::vector<MeasurementRequest> load_measurements(const TomlTable& root, const Scene& scene) {
  std::vector<MeasurementRequest> requests;
  if (!root.has("measurement")) return requests;
  std::set<std::string> names;
  const Time& time = scene.time;
  for (const TomlTable& table : root.tables("measurement")) {
    const MeasurementKind& kind = read_kind(table);
    table.refuse_unknown_keys(keys_of(kind));
    std::string name = read_name(table, kind);
    if (!names.insert(name).second) {
      table.fail("name", "measurement \"" + name + "\" is listed twice; allowed: once, others with a name of their own");
    }
    const int every = read_every(table, time);
    const double from = table.has("from") ? table.number("from", Interval::closed(0, time.duration, "s (up to time.duration)")) : 0;
    const double until = table.has("until")
                             ? table.number("until", Interval::closed(from, time.duration, "s (up to time.duration)"))
                             : time.duration;
    constexpr double kRounding = 1e-6;  // of a step
    const int first = static_cast<int>(std::ceil(from / time.step - kRounding));
    const int last = static_cast<int>(std::floor(until / time.step + kRounding));
    requests.push_back({std::move(name), kind.name, every, first, last, kind.needs_contacts, kind.read(table, scene)});
    refuse_without_sample(table, requests.back(), time.step);
  }
  return requests;
}

}  // namespace falling_particles
