// Feeders and sinks of a scene: where grains come from and where they go.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "open.hpp"

namespace falling_particles {

struct Scene;

/// Grains, counted and weighed.
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
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(grains, mass);
  }
};

/// A number of grains or a mass of them, in grains or kg; of a rate, in grains/s or kg/s.
struct Quantity {
  enum class Of { Grains, Mass };
  double number;
  Of of;

  /// What of the amount is counted here.
  double in(const Amount& amount) const { return of == Of::Mass ? amount.mass : static_cast<double>(amount.grains); }
  std::string in_words() const;  ///< "0.2 kg"
};

/// A share of a kind in what a feeder feeds.
struct FedKind {
  std::size_t kind;  ///< index into Scene::kinds
  double fraction;   ///< of Feeder::fraction_of; all sum to 1
};

/// A region into which grains come at a rate, wherever in it they touch nothing.
struct Feeder {
  std::string name;
  Region region;
  std::vector<FedKind> mixture;
  Quantity::Of fraction_of;  ///< whether the fractions are of the grains or of their mass
  Quantity rate;             ///< a second
  std::optional<Quantity> total = {};
  double from = 0;                                         ///< s
  double until = std::numeric_limits<double>::infinity();  ///< s
  Point velocity = {};                                     ///< m/s, of the grains when they come
  double patience = 1;                                     ///< s, for which the region may be too full for the rate
};

/// kg, of the grains that the feeder may bring.
double lightest_grain(const Feeder& feeder, const Scene& scene);

/// A number of grains that the feeder cannot reach within the duration of the scene.
double most_grains(const Feeder& feeder, const Scene& scene);

/// The same of all feeders of the scene.
double most_fed(const Scene& scene);

/// What is below a plane.
struct HalfSpace {
  Point point;   ///< m, of the plane
  Point normal;  ///< unit, upwards

  bool contains(const Point& p) const {
    double above = 0;
    for (std::size_t i = 0; i < 3; ++i) above += normal[i] * (p[i] - point[i]);
    return above < 0;
  }
};

/// A region that takes grains away as soon as their centres are inside.
struct Sink {
  std::string name;
  std::variant<Region, HalfSpace> region;

  bool contains(const Point& p) const {
    return std::visit([&p](const auto& kind) { return kind.contains(p); }, region);
  }
};

}  // namespace falling_particles
