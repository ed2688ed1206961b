// Measures the benefit of contacts before overlap in a bed of grains. Pours the same beds with plain contacts, with contacts ahead
// and, if available, with Bullet, at several steps, and writes overlaps and costs.

#include <ode/ode.h>
#include <supernormal/supernormal.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "bed.hpp"
#include "common/ode_world.hpp"

namespace {

using namespace look_ahead_beds;

constexpr double kColumn = 6 * kSmallestHalfAxis;  // m; between grains of a layer: three times the longest half-axis
constexpr double kLayersPerSide = 3;               // initial layers per grain along a side
constexpr double kSpread = 0.2;                    // relative variation of the sizes
constexpr int kMaxContacts = 8;                    // contacts per pair
constexpr double kCorrectingVelocity = 0.1;        // m/s; as recommended for grains that overlap deeply
constexpr int kMoments = 25;                       // instants in the second half at which overlaps are measured

/// Layers of grains with half-axes in the ratio 4 : 3 : 2, sizes that vary by up to 20 %, and random orientations.
Bed make_bed(int count, double exponent) {
  const int side = std::max(1, static_cast<int>(std::ceil(std::cbrt(count / kLayersPerSide))));
  Bed bed{exponent, 0.5 * kColumn * side, {}};
  std::mt19937_64 engine(1);
  const auto uniform = [&engine] { return static_cast<double>(engine() >> 11U) * 0x1p-52 - 1; };  // in [-1, 1)
  for (int i = 0; i < count; ++i) {
    const double size = kSmallestHalfAxis * (1 + kSpread * uniform());
    Grain grain{{2 * size, 1.5 * size, size}, {}};
    const auto place = [side](int index) { return kColumn * (index + 0.5 * (1 - side)); };
    const int layer = i / (side * side);
    grain.start.position = {place(i % side), place(i / side % side), kColumn * (1 + layer)};
    double square = 0;
    for (double& q : grain.start.quaternion) square += std::pow(q = uniform(), 2);
    for (double& q : grain.start.quaternion) q /= std::sqrt(square);
    bed.grains.push_back(grain);
  }
  return bed;
}

/// The geoms of a bed. In a simulation they have bodies; those that measure overlaps have none.
class OdeBed {
 public:
  explicit OdeBed(const Bed& bed) {
    for (const Grain& grain : bed.grains) {
      const auto [a, b, c] = grain.half_axes;
      const auto exponent = static_cast<dReal>(bed.exponent);
      geoms_.push_back(snCreateSuperellipsoid(world_.space(), dReal(a), dReal(b), dReal(c), exponent, exponent));
      if (geoms_.back() == nullptr) throw std::runtime_error(snLastError());
      move(geoms_.size() - 1, grain.start);
    }
    for (const auto& w : bed.walls()) dCreatePlane(walls_, dReal(w[0]), dReal(w[1]), dReal(w[2]), dReal(w[3]));
  }
  ~OdeBed() { dSpaceDestroy(walls_); }
  OdeBed(const OdeBed&) = delete;
  OdeBed& operator=(const OdeBed&) = delete;

  common::OdeWorld& world() { return world_; }
  const std::vector<dGeomID>& geoms() const { return geoms_; }

  void move(std::size_t grain, const Pose& pose) {
    dQuaternion quaternion;
    for (std::size_t k = 0; k < 4; ++k) quaternion[k] = static_cast<dReal>(pose.quaternion[k]);
    dGeomSetPosition(geoms_[grain], dReal(pose.position[0]), dReal(pose.position[1]), dReal(pose.position[2]));
    dGeomSetQuaternion(geoms_[grain], quaternion);
  }

  /// Calls near(geom1, geom2) for each pair of grains, and of a grain and a wall, whose bounding boxes meet.
  void collide(const auto& near) {
    world_.collide(near);
    world_.collide_with(walls_, near);
  }

 private:
  common::OdeWorld world_{dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ)};
  dSpaceID walls_ = dSimpleSpaceCreate(nullptr);
  std::vector<dGeomID> geoms_;
};

/// dWorldQuickStep with contacts of overlaps, or with contacts before overlap.
class OdeSimulation final : public Simulation {
 public:
  OdeSimulation(const Bed& bed, const Settings& settings, bool looks_ahead) : settings_(settings), bed_(bed) {
    const dWorldID world = bed_.world().id();
    dWorldSetGravity(world, 0, 0, static_cast<dReal>(-kGravity));
    dWorldSetQuickStepNumIterations(world, settings.iterations);
    dWorldSetContactMaxCorrectingVel(world, static_cast<dReal>(kCorrectingVelocity));
    dRandSetSeed(1);
    for (std::size_t grain = 0; grain < bed.grains.size(); ++grain) {
      const dGeomID geom = bed_.geoms()[grain];
      bed_.world().add(geom, kDensity);
      bed_.move(grain, bed.grains[grain].start);
      if (looks_ahead && snGeomSetLookAhead(geom, static_cast<dReal>(settings.step)) == 0) throw std::runtime_error(snLastError());
    }
  }

  void step() override {
    bed_.collide([this](dGeomID o1, dGeomID o2) { add_contacts(o1, o2); });
    bed_.world().step(settings_.step);
  }

  Pose pose(std::size_t grain) const override {
    const dReal* const p = dGeomGetPosition(bed_.geoms()[grain]);
    dQuaternion q;
    dGeomGetQuaternion(bed_.geoms()[grain], q);
    return {{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}};
  }

 private:
  void add_contacts(dGeomID o1, dGeomID o2) {
    std::array<dContact, kMaxContacts> found;
    const int count = dCollide(o1, o2, kMaxContacts, &found[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      dContact& contact = found[static_cast<std::size_t>(i)];
      contact.surface.mode = dContactApprox1;
      contact.surface.mu = static_cast<dReal>(kFriction);
      snContactLookAhead(&contact, static_cast<dReal>(settings_.step));
      bed_.world().join(contact);
    }
  }

  Settings settings_;
  OdeBed bed_;
};

/// A method: its name in tables, and how it simulates a bed. The bed must outlive the simulation.
struct Method {
  const char* name;
  std::unique_ptr<Simulation> (*start)(const Bed& bed, const Settings& settings);
};

const std::vector<Method>& methods() {
  static const std::vector<Method> all = {
      {"plain",
       [](const Bed& bed, const Settings& s) -> std::unique_ptr<Simulation> {
         return std::make_unique<OdeSimulation>(bed, s, false);
       }},
      {"ahead",
       [](const Bed& bed, const Settings& s) -> std::unique_ptr<Simulation> {
         return std::make_unique<OdeSimulation>(bed, s, true);
       }},
#ifdef LOOK_AHEAD_BEDS_BULLET
      {"Bullet", start_bullet},
#endif
  };
  return all;
}

struct Options {
  std::vector<std::string> methods = {"plain", "ahead"};
  int grains = 600;
  std::vector<double> exponents = {2, 4, 8, 20, 60};
  std::vector<double> steps = {0.00025, 0.0005, 0.001, 0.002, 0.004, 0.008};
  std::vector<int> iterations = {40};
  double duration = 1;  // s
  std::string csv = "beds.csv";
};

/// The second half of a run, when the bed is at rest.
struct Outcome {
  double deepest = 0;  ///< smallest half-axes of the mean grain
  double sum = 0;      ///< of the overlapping pairs, in the same unit
  int overlaps = 0;
  double seconds = 0;  ///< s of processor time, of a simulated second

  double mean() const { return overlaps > 0 ? sum / overlaps : 0; }
};

double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Outcome pour(const Method& method, const Bed& bed, const Settings& settings, double duration) {
  const std::unique_ptr<Simulation> simulation = method.start(bed, settings);
  const int half = std::max(kMoments, static_cast<int>(std::lround(0.5 * duration / settings.step)));
  for (int step = 0; step < half; ++step) simulation->step();
  // Geoms of their own measure the overlaps, so that the warm starts of the simulation are neither used nor changed.
  OdeBed ruler(bed);
  Outcome outcome;
  for (int step = 1; step <= half; ++step) {
    const double start = processor_time();
    simulation->step();
    outcome.seconds += (processor_time() - start) / (half * settings.step);
    if (step % (half / kMoments) != 0) continue;
    for (std::size_t i = 0; i < bed.grains.size(); ++i) ruler.move(i, simulation->pose(i));
    ruler.collide([&outcome](dGeomID o1, dGeomID o2) {
      snProximity proximity;
      if (snGeomProximity(o1, o2, &proximity) == 0) throw std::runtime_error(snLastError());
      const double overlap = -double{proximity.gap} / kSmallestHalfAxis;
      if (!(overlap > 0)) return;
      outcome.deepest = std::max(outcome.deepest, overlap);
      outcome.sum += overlap;
      ++outcome.overlaps;
    });
  }
  return outcome;
}

void pour_all(const Options& options) {
  std::ofstream csv(options.csv, std::ios::app);
  if (!csv) throw std::runtime_error("cannot write " + options.csv);
  if (csv.tellp() == 0) csv << "method,grains,exponent,iterations,step_s,deepest,mean,time_s\n";
  for (const double exponent : options.exponents) {
    const Bed bed = make_bed(options.grains, exponent);
    for (const int iterations : options.iterations) {
      for (const Method& method : methods()) {
        if (std::ranges::find(options.methods, method.name) == options.methods.end()) continue;
        for (const double step : options.steps) {
          const Outcome o = pour(method, bed, {step, iterations}, options.duration);
          csv << method.name << ',' << options.grains << ',' << exponent << ',' << iterations << ',' << step << ',' << o.deepest
              << ',' << o.mean() << ',' << o.seconds << std::endl;
        }
      }
    }
  }
}

void run(const Options& options) {
  dInitODE2(0);
  dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll));
  pour_all(options);
  snClose();
  dCloseODE();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Options options;
    CLI::App app("What contacts before overlap save in a bed of grains");
    std::vector<std::string> names;
    for (const Method& method : methods()) names.emplace_back(method.name);
    app.add_option("--methods", options.methods, "plain, ahead, Bullet (with libbullet-dev; exponent 2)")
        ->check(CLI::IsMember(names))
        ->delimiter(',');
    app.add_option("--grains", options.grains, "in the bed")->check(CLI::Range(1, 100000))->capture_default_str();
    app.add_option("--exponents", options.exponents, "of the grains, above 1")->delimiter(',');
    app.add_option("--steps", options.steps, "s")->check(CLI::Range(1e-6, 1.0))->delimiter(',');
    app.add_option("--iterations", options.iterations, "of the solver")->check(CLI::Range(1, 100000))->delimiter(',');
    app.add_option("--duration", options.duration, "s")->check(CLI::Range(0.01, 1000.0))->capture_default_str();
    app.add_option("--csv", options.csv, "file to which the results are added")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "look_ahead_beds: %s\n", error.what());
    return 1;
  }
  return 0;
}
