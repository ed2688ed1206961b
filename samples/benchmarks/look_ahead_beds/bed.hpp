// A bed of grains of one kind: the common start of all simulations, the common measure of overlaps, and its simulation in an
// engine.
#pragma once

#include <ode/ode.h>

#include <array>
#include <cstddef>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

namespace look_ahead_beds {

inline constexpr double kDensity = 1300;             // kg/m^3
inline constexpr double kGravity = 9.81;             // m/s^2
inline constexpr double kFriction = 0.5;             // Coulomb coefficient of all surfaces
inline constexpr double kSmallestHalfAxis = 2.5e-3;  // m; of the mean grain; the unit of overlaps

struct Pose {
  std::array<double, 3> position{};    ///< m
  std::array<double, 4> quaternion{};  ///< unit; w, x, y, z
};

struct Grain {
  std::array<double, 3> half_axes{};  ///< m
  Pose start;
};

/// Grains above the floor z = 0, between the walls |x|, |y| = half_width.
struct Bed {
  double exponent = 2;  ///< of both sections
  double half_width = 0;
  std::vector<Grain> grains;

  /// The five walls, (normal, distance) as in dCreatePlane.
  std::array<std::array<double, 4>, 5> walls() const;
};

/// Layers of grains with half-axes in the ratio 4 : 3 : 2, sizes that vary by up to 20 %, and random orientations.
Bed make_bed(int count, double exponent, unsigned seed);

/// The geom of a grain in its initial pose.
dGeomID create_geom(dSpaceID space, const Bed& bed, const Grain& grain);

void set_pose(dGeomID geom, const Pose& pose);

/// Measures overlaps by snGeomProximity with its own geoms. It neither uses nor changes the warm starts of a simulation.
class Ruler {
 public:
  explicit Ruler(const Bed& bed);
  ~Ruler();
  Ruler(const Ruler&) = delete;
  Ruler& operator=(const Ruler&) = delete;

  /// Measures one instant.
  void measure(const std::vector<Pose>& poses);

  double deepest() const { return deepest_; }                                                ///< of all instants, half-axes
  double mean() const { return overlaps_ > 0 ? sum_ / static_cast<double>(overlaps_) : 0; }  ///< over all overlaps, half-axes

 private:
  static void near_callback(void* self, dGeomID o1, dGeomID o2);

  dSpaceID grains_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
  dSpaceID walls_ = dSimpleSpaceCreate(nullptr);
  std::vector<dGeomID> geoms_;
  double deepest_ = 0;
  double sum_ = 0;
  std::size_t overlaps_ = 0;
};

struct Settings {
  double step = 1e-3;  ///< s
  int iterations = 40;
};

class Simulation {
 public:
  Simulation() = default;
  virtual ~Simulation() = default;
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  virtual void step() = 0;
  virtual Pose pose(std::size_t grain) const = 0;
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
