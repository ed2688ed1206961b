// Feeders, which insert grains, and sinks, which remove them.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "geometry.hpp"

namespace falling_particles {

struct Scene;

/// A number of grains and their mass.
struct Amount {
  unsigned long long grains = 0;
  double mass = 0;  ///< kg

  void add(double mass_of_grain) {
    ++grains;
    mass += mass_of_grain;
  }
  Amount& operator+=(const Amount& other) {
    grains += other.grains;
    mass += other.mass;
    return *this;
  }
  void serialize(auto& archive) { archive(grains, mass); }
};

/// A number of grains (grains) or a mass (kg); of a rate, in grains/s or kg/s.
struct Quantity {
  enum class Of { Grains, Mass };
  double number;
  Of of;

  /// The amount in the unit of this quantity.
  double in(const Amount& amount) const { return of == Of::Mass ? amount.mass : static_cast<double>(amount.grains); }
  std::string in_words() const;  ///< "0.2 kg"
};

/// A kind of grain in the mixture of a feeder.
struct FedKind {
  std::size_t kind;  ///< index into Scene::kinds
  double fraction;   ///< the fractions sum to 1
};

/// A region into which grains are inserted at a rate, at random places where they touch nothing.
struct Feeder {
  std::string name;
  Region region;
  std::vector<FedKind> mixture;
  Quantity::Of fraction_of;  ///< whether the fractions are by number or by mass
  Quantity rate;             ///< per second
  std::optional<Quantity> total = {};
  double from = 0;                                         ///< s
  double until = std::numeric_limits<double>::infinity();  ///< s
  Point velocity = {};                                     ///< m/s, of inserted grains
  double patience = 1;  ///< s, timeout: the longest time for which the region may be too full for the rate
};

/// kg, the mass of the lightest grain that the feeder may insert.
double lightest_grain(const Feeder& feeder, const Scene& scene);

/// An upper bound of the number of grains that the feeder inserts within the duration of the scene.
double most_grains(const Feeder& feeder, const Scene& scene);

/// The same for all feeders of the scene together.
double most_fed(const Scene& scene);

/// The half-space below a plane.
struct HalfSpace {
  Point point;   ///< m, of the plane
  Point normal;  ///< unit, upwards

  bool contains(const Point& p) const {
    double above = 0;
    for (std::size_t i = 0; i < 3; ++i) above += normal[i] * (p[i] - point[i]);
    return above < 0;
  }
};

/// A region that removes grains as soon as their centres are inside.
struct Sink {
  std::string name;
  std::variant<Region, HalfSpace> region;

  bool contains(const Point& p) const {
    return std::visit([&p](const auto& kind) { return kind.contains(p); }, region);
  }
};

}  // namespace falling_particles
