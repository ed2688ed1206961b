#include <string>
#include <vector>

#include "load_sections.hpp"

namespace falling_particles {
namespace {

using By = SizeDistribution::By;

// No grain is larger, as for the half-axes of a catalogue.
constexpr double kLargestSize = 2;  // m
// Relative to the catalogue's size. Beyond it the grain is of another kind.
constexpr double kLargestFactor = 100;
// In a wider distribution the largest cells of the lattice hold few large grains among dust.
constexpr double kLargestRatio = 1000;
constexpr std::int64_t kMostOpenings = 200;

std::vector<std::string> keys_of_sizes(const std::string& distribution) {
  std::vector<std::string> keys = {"distribution", "by", "unit"};
  const auto add = [&keys](std::initializer_list<const char*> more) { keys.insert(keys.end(), more.begin(), more.end()); };
  if (distribution == "sieve") add({"openings", "passing"});
  if (distribution != "sieve") add({"smallest", "largest"});
  if (distribution == "normal") add({"mean", "deviation"});
  if (distribution == "lognormal") add({"median", "geometric_deviation"});
  return keys;
}

/// Reads the lengths of a size, in m or relative to the catalogue's size, as factors on the catalogue's size.
class Lengths {
 public:
  Lengths(const TomlTable& table, double sieve_size)
      : table_(table),
        is_relative_(table.has("unit") && table.choice("unit", {"m", "catalogue"}) == "catalogue"),
        unit_(is_relative_ ? 1 : sieve_size) {}

  double read(const char* key) const { return table_.number(key, range()) / unit_; }

  SizeDistribution::Bounds bounds() const {
    const double smallest = table_.number("smallest", range());
    const Interval above{smallest, smallest * kLargestRatio, false, true,
                         is_relative_ ? "(above size.smallest)" : "m (above size.smallest)"};
    return {smallest / unit_, table_.number("largest", above) / unit_};
  }

  std::vector<double> openings() const {
    std::vector<double> openings = table_.numbers("openings", count("openings"), range());
    for (std::size_t i = 1; i < openings.size(); ++i) {
      if (openings[i] <= openings[i - 1] || openings[i] > kLargestRatio * openings[0]) {
        table_.fail("openings", table_.full_name("openings") + "[" + std::to_string(i) + "] is " + shortest(openings[i]) +
                                    "; allowed: above the one before, " + shortest(openings[i - 1]) + ", up to " +
                                    shortest(kLargestRatio) + " times the first");
      }
    }
    for (double& opening : openings) opening /= unit_;
    return openings;
  }

  std::vector<double> passing() const {
    std::vector<double> passing = table_.numbers("passing", count("openings"), Interval::closed(0, 1, "(a share)"));
    const auto fail = [this, &passing](std::size_t i, const std::string& allowed) {
      table_.fail("passing",
                  table_.full_name("passing") + "[" + std::to_string(i) + "] is " + shortest(passing[i]) + "; allowed: " + allowed);
    };
    if (passing.front() != 0) fail(0, "0, of the sieve that nothing passes");
    if (passing.back() != 1) fail(passing.size() - 1, "1, of the sieve that everything passes");
    for (std::size_t i = 1; i < passing.size(); ++i) {
      if (passing[i] < passing[i - 1]) fail(i, "no less than the one before, " + shortest(passing[i - 1]));
    }
    return passing;
  }

 private:
  Interval range() const {
    return is_relative_ ? Interval::positive(kLargestFactor, "(times the catalogue's size)")
                        : Interval::positive(kLargestSize, "m");
  }

  std::size_t count(const char* key) const {
    const std::size_t count = table_.array_size(key);
    if (count >= 2 && count <= static_cast<std::size_t>(kMostOpenings)) return count;
    table_.fail(
        key, table_.full_name(key) + " has " + std::to_string(count) + " numbers; allowed: 2 to " + std::to_string(kMostOpenings));
  }

  const TomlTable& table_;
  bool is_relative_;
  double unit_;
};

}  // namespace

std::optional<SizeDistribution> load_sizes(const TomlTable& entry, double sieve_size) {
  if (!entry.has("size")) return std::nullopt;
  const TomlTable table = entry.table("size");
  const std::string kind = table.choice("distribution", {"uniform", "normal", "lognormal", "sieve"});
  table.refuse_unknown_keys(keys_of_sizes(kind));
  const bool is_sieve = kind == "sieve";
  const By by = (table.has("by") ? table.choice("by", {"number", "mass"}) == "mass" : is_sieve) ? By::Mass : By::Number;
  const Lengths lengths(table, sieve_size);
  if (is_sieve) return SizeDistribution::sieve(lengths.openings(), lengths.passing(), by);
  const SizeDistribution::Bounds bounds = lengths.bounds();
  if (kind == "uniform") return SizeDistribution::uniform(bounds, by);
  if (kind == "normal") return SizeDistribution::normal(lengths.read("mean"), lengths.read("deviation"), bounds, by);
  constexpr double kLargestSpread = 100;
  const double spread = table.number("geometric_deviation", Interval{1, kLargestSpread, false, true, "(a factor)"});
  return SizeDistribution::lognormal(lengths.read("median"), spread, bounds, by);
}

}  // namespace falling_particles
