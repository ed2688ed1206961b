// A bed in a rigid-body engine.
#pragma once

#include <cstddef>
#include <ctime>
#include <memory>
#include <string>

#include "bed.hpp"

namespace look_ahead_beds {

struct Settings {
  double step = 1e-3;  ///< s
  int iterations = 40;
};

/// What the steps have cost. An engine that does everything in one call counts all of it as solving.
struct Costs {
  double finding = 0;      ///< s of the processor, for pairs and contacts
  double solving = 0;      ///< s of the processor
  double rows = 0;         ///< rows of constraints, three for each contact, times iterations
  double evaluations = 0;  ///< of the gap function
  double seconds() const { return finding + solving; }
};

class Simulation {
 public:
  Simulation() = default;
  virtual ~Simulation() = default;
  Simulation(const Simulation&) = delete;
  Simulation(Simulation&&) = delete;
  Simulation& operator=(const Simulation&) = delete;
  Simulation& operator=(Simulation&&) = delete;

  virtual void step() = 0;
  virtual Pose pose(std::size_t grain) const = 0;
  virtual double kinetic_energy() const = 0;  ///< J; of the translation

  const Costs& costs() const { return costs_; }
  void forget_costs() { costs_ = {}; }

 protected:
  Costs& spent() { return costs_; }

 private:
  Costs costs_;
};

/// A method that is compared: its name in tables, and how a bed is simulated by it. The bed must outlive the simulation.
struct Method {
  std::string name;
  std::unique_ptr<Simulation> (*start)(const Bed& bed, const Settings& settings);
};

/// dWorldQuickStep with the contacts of overlaps, and with contacts before overlap.
std::unique_ptr<Simulation> start_plain(const Bed& bed, const Settings& settings);
std::unique_ptr<Simulation> start_ahead(const Bed& bed, const Settings& settings);

/// Bullet's sequential impulses with ellipsoids by their support function; the exponent must be 2.
std::unique_ptr<Simulation> start_bullet(const Bed& bed, const Settings& settings);

/// s; the time that the processor has worked for this program.
inline double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace look_ahead_beds
