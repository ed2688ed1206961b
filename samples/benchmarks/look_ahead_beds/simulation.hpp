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

/// The cost of the steps. For an engine with a single call everything counts as solving.
struct Costs {
  double finding = 0;      ///< s of processor time, for pairs and contacts
  double solving = 0;      ///< s of processor time
  double rows = 0;         ///< constraint rows, three per contact, times iterations
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
  virtual double kinetic_energy() const = 0;  ///< J; of translation

  const Costs& costs() const { return costs_; }
  void forget_costs() { costs_ = {}; }

 protected:
  Costs& spent() { return costs_; }

 private:
  Costs costs_;
};

/// A method: its name in tables, and how it simulates a bed. The bed must outlive the simulation.
struct Method {
  std::string name;
  std::unique_ptr<Simulation> (*start)(const Bed& bed, const Settings& settings);
};

/// dWorldQuickStep with contacts of overlaps, or with contacts before overlap.
std::unique_ptr<Simulation> start_plain(const Bed& bed, const Settings& settings);
std::unique_ptr<Simulation> start_ahead(const Bed& bed, const Settings& settings);

/// Sequential impulses of Bullet, with ellipsoids by their support function. The exponent must be 2.
std::unique_ptr<Simulation> start_bullet(const Bed& bed, const Settings& settings);

/// The processor time of this program, s.
inline double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace look_ahead_beds
