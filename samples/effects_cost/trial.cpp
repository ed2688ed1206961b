#include "trial.hpp"

#include <array>
#include <ctime>
#include <span>

#include "random.hpp"
#include "stepper.hpp"
#include "world.hpp"

namespace effects_cost {

using falling_particles::Placement;
using falling_particles::Scene;

std::vector<Placement> settle(const Scene& scene) {
  falling_particles::Random random(scene.seed);
  std::vector<Placement> placements = place(scene, random);
  const falling_particles::World world(scene, placements);
  falling_particles::Stepper stepper(world, scene);
  for (int i = 0; i < scene.time.steps(); ++i) stepper.step();
  for (std::size_t i = 0; i < placements.size(); ++i) {
    const dReal* const q = dBodyGetQuaternion(world.bodies()[i].body);
    placements[i].position = world.bodies()[i].position();
    placements[i].quaternion = {q[0], q[1], q[2], q[3]};
  }
  return placements;
}

namespace {

constexpr int kContactsPerPair = 5;

/// s, of this thread: what else the machine does is not in it.
double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A step as falling_particles makes it, in three parts, each timed as a whole.
class Bench {
 public:
  explicit Bench(const falling_particles::World& world, double step) : world_(world), step_(step), joints_(dJointGroupCreate(0)) {}
  ~Bench() { dJointGroupDestroy(joints_); }
  Bench(const Bench&) = delete;
  Bench(Bench&&) = delete;
  Bench& operator=(const Bench&) = delete;
  Bench& operator=(Bench&&) = delete;

  void step(Outcome& sum) {
    found_.clear();
    const double start = processor_time();
    dSpaceCollide(world_.space(), this, near_callback);
    const double collided = processor_time();
    dJointGroupEmpty(joints_);
    for (Pair& pair : found_) attach(pair);
    world_.effects().apply_forces();
    const double ready = processor_time();
    dWorldQuickStep(world_.id(), static_cast<dReal>(step_));
    const double end = processor_time();
    sum.seconds += end - start;
    sum.set_up += ready - collided;
    sum.solver += end - ready;
    for (const Pair& pair : found_) sum.contacts += pair.count;
  }

 private:
  struct Pair {
    std::array<dContact, kContactsPerPair> contacts;
    int count;
  };

  static void near_callback(void* self, dGeomID g1, dGeomID g2) {
    Bench& bench = *static_cast<Bench*>(self);
    Pair& pair = bench.found_.emplace_back();
    pair.count = dCollide(g1, g2, kContactsPerPair, &pair.contacts[0].geom, sizeof(dContact));
    if (pair.count == 0) bench.found_.pop_back();
  }

  void attach(Pair& pair) {
    const dContactGeom geom = pair.contacts[0].geom;
    const auto contacts = std::span(pair.contacts).first(static_cast<std::size_t>(pair.count));
    const int count = world_.effects().set_up_contacts(contacts, falling_particles::material_of(geom.g1),
                                                       falling_particles::material_of(geom.g2));
    for (int i = 0; i < count; ++i) {
      const dContact& contact = contacts[static_cast<std::size_t>(i)];
      const dJointID joint = dJointCreateContact(world_.id(), joints_, &contact);
      dJointAttach(joint, dGeomGetBody(contact.geom.g1), dGeomGetBody(contact.geom.g2));
    }
  }

  const falling_particles::World& world_;
  double step_;
  dJointGroupID joints_;
  std::vector<Pair> found_;
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
  bench.step(unused);  // makes what is made once
  const double rows_before = rows(world);
  Outcome sum;
  for (int i = 0; i < steps; ++i) bench.step(sum);
  sum.rows = rows(world) - rows_before;
  for (double* part : {&sum.seconds, &sum.set_up, &sum.solver, &sum.contacts, &sum.rows}) *part /= steps;
  return sum;
}

}  // namespace effects_cost
