#include "trial.hpp"

#include <array>
#include <ctime>

#include "common/random.hpp"
#include "world/contact_joints.hpp"
#include "world/stepper.hpp"
#include "world/world.hpp"

namespace effects_cost {

using falling_particles::kContactsPerPair;
using falling_particles::Placement;
using falling_particles::Scene;

std::vector<Placement> settle(const Scene& scene) {
  common::Random random(scene.seed);
  std::vector<Placement> placements = place(scene, random);
  const falling_particles::World world(scene, placements);
  falling_particles::Stepper stepper(world, scene);
  for (int i = 0; i < scene.time.steps(); ++i) stepper.step();
  for (std::size_t i = 0; i < placements.size(); ++i) {
    placements[i].position = world.grains()[i].position();
    placements[i].quaternion = world.grains()[i].quaternion();
  }
  return placements;
}

namespace {

/// The processor time of this thread, s. It excludes other work of the machine.
double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Makes a step like falling_particles, in three separately timed parts.
class Bench {
 public:
  explicit Bench(const falling_particles::World& world, double step) : world_(world), step_(step), joints_(world) {}

  void step(Outcome& sum) {
    contacts_.clear();
    const double start = processor_time();
    world_.name_pairs(this, near_callback);
    const double collided = processor_time();
    joints_.replace(contacts_);
    world_.effects().apply_forces();
    const double ready = processor_time();
    dWorldQuickStep(world_.id(), static_cast<dReal>(step_));
    const double end = processor_time();
    sum.seconds += end - start;
    sum.set_up += ready - collided;
    sum.solver += end - ready;
    sum.contacts += static_cast<double>(contacts_.size());
  }

 private:
  static void near_callback(void* self, dGeomID g1, dGeomID g2) {
    auto& contacts = static_cast<Bench*>(self)->contacts_;
    std::array<dContactGeom, kContactsPerPair> found;
    const int count = dCollide(g1, g2, kContactsPerPair, found.data(), sizeof(dContactGeom));
    contacts.insert(contacts.end(), found.begin(), found.begin() + count);
  }

  const falling_particles::World& world_;
  double step_;
  falling_particles::ContactJoints joints_;
  std::vector<dContactGeom> contacts_;
};

double rows(const falling_particles::World& world) {
  unsigned long long sum = 0;
  for (const auto& cost : world.effects().costs()) sum += cost.rows;
  return static_cast<double>(sum);
}

}  // namespace

Outcome run(Scene scene, const std::vector<Placement>& start, const std::vector<supernormal::effects::Effect>& effects, int steps) {
  scene.effects = effects;
  const falling_particles::World world(scene, start);
  Bench bench(world, scene.time.step);
  Outcome unused;
  bench.step(unused);  // does the one-time work
  const double rows_before = rows(world);
  Outcome sum;
  for (int i = 0; i < steps; ++i) bench.step(sum);
  sum.rows = rows(world) - rows_before;
  for (double* part : {&sum.seconds, &sum.set_up, &sum.solver, &sum.contacts, &sum.rows}) *part /= steps;
  return sum;
}

}  // namespace effects_cost
