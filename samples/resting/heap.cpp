#include "heap.hpp"

#include <supernormal/supernormal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

namespace resting {
namespace {

constexpr double kDensity = 1000;  // kg/m^3
constexpr double kGravity = 9.81;  // m/s^2
constexpr double kLongest = 10;    // s
constexpr int kMostRoom = 8;       // contacts
constexpr int kNeedles = 60;
constexpr double kSlenderness = 40;  // half-length to half-thickness
constexpr double kHeavy = 62;        // the mass of the body that three light ones carry, of one of them

struct Place {
  double x, y, z;     // m
  double yaw, pitch;  // rad
};

/// Everything of one heap, in the order in which it has to be destroyed.
class Scene {
 public:
  Scene(const HeapRow& row, int number) : row_(row), random_(static_cast<unsigned>(number + 1)) {
    dWorldSetGravity(world_, 0, 0, static_cast<dReal>(-kGravity));
    dWorldSetAutoDisableFlag(world_, 1);
    dWorldSetQuickStepNumIterations(world_, row.iterations);
    dCreatePlane(space_, 0, 0, 1, 0);
    if (row.heap == Heap::OnThree) {
      add_cubes();
    } else {
      add_needles();
    }
  }
  ~Scene() {
    dJointGroupDestroy(joints_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }
  Scene(const Scene&) = delete;
  Scene(Scene&&) = delete;
  Scene& operator=(const Scene&) = delete;
  Scene& operator=(Scene&&) = delete;

  void step(int number) {
    overlap_ = 0;
    dSpaceCollide(space_, this, near_callback);
    dRandSetSeed(static_cast<unsigned long>(number));
    dWorldQuickStep(world_, static_cast<dReal>(row_.step));
    dJointGroupEmpty(joints_);
  }

  int awake() const {
    return static_cast<int>(std::count_if(bodies_.begin(), bodies_.end(), [](dBodyID body) { return dBodyIsEnabled(body) != 0; }));
  }

  double mean_square_speed() const {
    double sum = 0;
    for (const dBodyID body : bodies_) sum += std::pow(double{dCalcVectorLength3(dBodyGetLinearVel(body))}, 2);
    return sum / static_cast<double>(bodies_.size());
  }

  double overlap() const { return overlap_; }

 private:
  void add_needles() {
    const double pitch = 2.2 * row_.size;
    for (int k = 0; k < kNeedles; ++k) {
      const int layer = k / row_.in_layer;
      const double lean = uniform(0.01);
      if (row_.heap == Heap::Bundle) {
        const double y = pitch * (k % row_.in_layer - 0.5 * (row_.in_layer - 1)) + uniform(0.1 * row_.size);
        add({uniform(row_.size), y, row_.size + pitch * (layer + 1), uniform(0.002), 0.2 * lean}, kSlenderness, row_.size);
      } else {
        const double reach = 0.5 * kSlenderness * row_.size;
        add({uniform(reach), uniform(reach), pitch * (k + 2), uniform(M_PI), lean}, kSlenderness, row_.size);
      }
    }
  }

  void add_cubes() {
    const double c = row_.size;
    const double large = c * std::cbrt(kHeavy);
    for (int k = 0; k < 3; ++k) {
      const double angle = 2 * M_PI * k / 3;
      add({0.6 * large * std::cos(angle), 0.6 * large * std::sin(angle), 1.05 * c, uniform(M_PI), uniform(0.01)}, 1, c);
    }
    add({0, 0, 2.2 * c + large, uniform(M_PI), uniform(0.01)}, 1, large);
  }

  void add(const Place& place, double slenderness, double size) {
    const auto a = static_cast<dReal>(slenderness * size);
    const auto c = static_cast<dReal>(size);
    dMass mass;
    dGeomID geom = nullptr;
    if (row_.exponent > 0) {
      geom = snCreateSuperellipsoid(space_, a, c, c, static_cast<dReal>(row_.exponent), static_cast<dReal>(row_.exponent));
      if (geom == nullptr || snMassSet(&mass, static_cast<dReal>(kDensity), geom) == 0) throw std::runtime_error(snLastError());
    } else {
      geom = dCreateBox(space_, 2 * a, 2 * c, 2 * c);
      dMassSetBox(&mass, static_cast<dReal>(kDensity), 2 * a, 2 * c, 2 * c);
    }
    const dBodyID body = dBodyCreate(world_);
    dBodySetMass(body, &mass);
    dGeomSetBody(geom, body);
    dMatrix3 attitude;
    dRFromEulerAngles(attitude, 0, static_cast<dReal>(place.pitch), static_cast<dReal>(place.yaw));
    dBodySetRotation(body, attitude);
    dBodySetPosition(body, static_cast<dReal>(place.x), static_cast<dReal>(place.y), static_cast<dReal>(place.z));
    bodies_.push_back(body);
  }

  /// From -largest to largest.
  double uniform(double largest) { return std::uniform_real_distribution<double>(-largest, largest)(random_); }

  static void near_callback(void* self, dGeomID o1, dGeomID o2) {
    Scene& scene = *static_cast<Scene*>(self);
    std::array<dContact, kMostRoom> found;
    const int count = dCollide(o1, o2, scene.row_.room, &found[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      dContact& contact = found[static_cast<std::size_t>(i)];
      contact.surface.mode = dContactApprox1;
      contact.surface.mu = static_cast<dReal>(0.5);
      scene.overlap_ = std::max(scene.overlap_, double{contact.geom.depth});
      dJointAttach(dJointCreateContact(scene.world_, scene.joints_, &contact), dGeomGetBody(o1), dGeomGetBody(o2));
    }
  }

  HeapRow row_;
  std::mt19937 random_;
  dWorldID world_ = dWorldCreate();
  dSpaceID space_ = dHashSpaceCreate(nullptr);
  dJointGroupID joints_ = dJointGroupCreate(0);
  std::vector<dBodyID> bodies_;
  double overlap_ = 0;  // m; of the last step
};

}  // namespace

HeapRest settle(const HeapRow& row, int number) {
  Scene scene(row, number);
  const auto steps_in_second = static_cast<std::size_t>(std::lround(1 / row.step));
  std::vector<double> squares(steps_in_second, 0);
  std::vector<double> overlaps(steps_in_second, 0);
  int step = 0;
  while (step * row.step < kLongest && scene.awake() > 0) {
    const std::size_t place = static_cast<std::size_t>(step) % steps_in_second;
    scene.step(++step);
    squares[place] = scene.mean_square_speed();
    overlaps[place] = scene.overlap();
  }
  double sum = 0;
  for (const double square : squares) sum += square;
  const double mean = sum / static_cast<double>(std::min<std::size_t>(steps_in_second, static_cast<std::size_t>(step)));
  return {scene.awake(), step * row.step, std::sqrt(mean), *std::max_element(overlaps.begin(), overlaps.end()) / row.size};
}

}  // namespace resting
