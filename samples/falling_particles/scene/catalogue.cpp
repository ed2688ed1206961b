#include "catalogue.hpp"

#include "toml_input.hpp"

namespace falling_particles {
namespace {

// Larger lengths are millimetres typed in as metres, the usual slip: nothing that one pours is larger than this.
constexpr double kLargestHalfAxis = 1;  // m
// Osmium is the densest solid there is: 22 590 kg/m^3.
constexpr double kLargestDensity = 23000;  // kg/m^3

constexpr const char* kNameCharacters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";

Grain read_grain(const TomlTable& table, const std::string& name) {
  // The range is that of snCreateSuperellipsoid.
  const Interval exponents = Interval::closed(1.01, 1000, "");
  Grain grain{name, {}, 2, 2, 0, 0, {}};
  const std::vector<double> axes = table.numbers("half_axes", 3, Interval::positive(kLargestHalfAxis, "m"));
  grain.half_axes = {axes[0], axes[1], axes[2]};
  grain.delta = table.number("delta", exponents);
  grain.epsilon = table.number("epsilon", exponents);
  if (table.has("rounding")) {
    const double below = grain.smallest_half_axis();
    grain.rounding = table.number("rounding", Interval{0, below, true, false, "m (below the smallest half-axis)"});
  }
  grain.density = table.number("density", Interval::positive(kLargestDensity, "kg/m^3"));
  grain.source = table.text("source");
  return grain;
}

}  // namespace

std::vector<Grain> load_catalogue(const std::string& path) {
  const TomlTable root = TomlFile(path, "grain catalogue").root();
  std::vector<Grain> grains;
  for (const std::string& name : root.names()) {
    // Names are written into CSV files without quotes.
    if (name.find_first_not_of(kNameCharacters) != std::string::npos) {
      root.fail(name, "grain name \"" + name + "\"; allowed: letters, digits, _ and -");
    }
    grains.push_back(read_grain(root.table(name, {"half_axes", "delta", "epsilon", "rounding", "density", "source"}), name));
  }
  return grains;
}

}  // namespace falling_particles
