#include "heap.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "world.hpp"

namespace resting {
namespace {

constexpr double kLongest = 10;  // s
constexpr int kNeedles = 60;
constexpr double kSlenderness = 40;  // half-length to half-thickness
constexpr double kHeavy = 62;        // mass of the body on the three light ones, in units of one of them

struct Place {
  double x, y, z;     // m
  double yaw, pitch;  // rad
};

/// A falling heap.
class Scene {
 public:
  Scene(const HeapRow& row, int number)
      : row_(row),
        random_(static_cast<unsigned>(number + 1)),
        world_(dHashSpaceCreate(nullptr), row.step, row.room, row.looks_ahead) {
    dWorldSetQuickStepNumIterations(world_.id(), row.iterations);
    dCreatePlane(world_.space(), 0, 0, 1, 0);
    if (row.heap == Heap::OnThree) {
      add_cubes();
    } else {
      add_needles();
    }
  }

  void step(int number) { world_.step(number); }

  int awake() const {
    return static_cast<int>(std::count_if(bodies_.begin(), bodies_.end(), [](dBodyID body) { return dBodyIsEnabled(body) != 0; }));
  }

  double mean_square_speed() const {
    double sum = 0;
    for (const dBodyID body : bodies_) sum += std::pow(double{dCalcVectorLength3(dBodyGetLinearVel(body))}, 2);
    return sum / static_cast<double>(bodies_.size());
  }

  double overlap() const { return world_.overlap(); }

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
        add({uniform(reach), uniform(reach), pitch * (k + 2), uniform(std::numbers::pi), lean}, kSlenderness, row_.size);
      }
    }
  }

  void add_cubes() {
    const double c = row_.size;
    const double large = c * std::cbrt(kHeavy);
    for (int k = 0; k < 3; ++k) {
      const double angle = 2 * std::numbers::pi * k / 3;
      add({0.6 * large * std::cos(angle), 0.6 * large * std::sin(angle), 1.05 * c, uniform(std::numbers::pi), uniform(0.01)}, 1, c);
    }
    add({0, 0, 2.2 * c + large, uniform(std::numbers::pi), uniform(0.01)}, 1, large);
  }

  void add(const Place& place, double slenderness, double size) {
    const dBodyID body = world_.add(row_.exponent, {slenderness * size, size, size});
    dMatrix3 orientation;
    dRFromEulerAngles(orientation, 0, static_cast<dReal>(place.pitch), static_cast<dReal>(place.yaw));
    dBodySetRotation(body, orientation);
    dBodySetPosition(body, static_cast<dReal>(place.x), static_cast<dReal>(place.y), static_cast<dReal>(place.z));
    bodies_.push_back(body);
  }

  /// A random number from -largest to largest.
  double uniform(double largest) { return std::uniform_real_distribution<double>(-largest, largest)(random_); }

  HeapRow row_;
  std::mt19937 random_;
  World world_;
  std::vector<dBodyID> bodies_;
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
