// Doubts about walls that move so far in a step that they pass through grains, or throw them.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "common/interval.hpp"
#include "doubts.hpp"
#include "model/wall.hpp"
#include "observe/wall_mesh.hpp"

namespace falling_particles {
namespace {

/// m/s, the largest normal velocity of a point at any time. If `turns`, the wall also rotates, and the direction of a velocity
/// relative to the wall changes.
double normal_speed(const WallMotion& motion, const SurfacePoint& point, bool turns) {
  const auto along = [&](const Vector3& velocity) { return turns ? velocity.norm() : std::abs(point.normal.dot(velocity)); };
  if (const auto* translation = std::get_if<Translation>(&motion.kind)) return along(translation->velocity);
  if (const auto* vibration = std::get_if<Vibration>(&motion.kind)) {
    return along(2 * std::numbers::pi * vibration->frequency * vibration->amplitude);
  }
  if (const auto* rotation = std::get_if<Rotation>(&motion.kind)) {
    const Vector3 spin = 2 * std::numbers::pi / 60 * rotation->rpm * rotation->axis;
    return std::abs(point.normal.dot(spin.cross(point.position - rotation->point)));
  }
  return 0;  // a conveyor stands
}

/// m/s, the largest velocity of a point of the wall's surface along its normal. The largest velocities of all motions are added.
double normal_speed_of(const Wall& wall, const Scene& scene) {
  if (wall.motions.empty()) return 0;
  const bool turns =
      std::ranges::any_of(wall.motions, [](const WallMotion& motion) { return std::holds_alternative<Rotation>(motion.kind); });
  double largest = 0;
  for (const SurfacePoint& point : surface_of(wall, scene.container)) {
    double speed = 0;
    for (const WallMotion& motion : wall.motions) speed += normal_speed(motion, point, turns);
    largest = std::max(largest, speed);
  }
  return largest;
}

/// N/m, of the spring of a contact between a wall and a ball of this diameter (m) under the force (N); 0 without springs. With
/// Hertz it is dF/d(depth) = (6 E*^2 R F)^(1/3) (Johnson, Contact Mechanics, eq. 4.23).
double contact_stiffness(const supernormal::effects::Effect& effect, double diameter, double force) {
  if (const auto* const spring = std::get_if<supernormal::effects::Compliance>(&effect)) return spring->stiffness;
  const auto* const hertz = std::get_if<supernormal::effects::Hertz>(&effect);
  if (hertz == nullptr) return 0;
  const double modulus = contact_modulus(*hertz);
  return std::cbrt(6 * modulus * modulus * diameter / 2 * force);
}

/// Adds a doubt about a servo on springs. A spring is explicit: it is stable while stiffness x step^2 is below four masses. A servo
/// has the mass step x area / gain, and a contact for each smallest grain that fits on its area.
void add_gain(const Scene& scene, const Wall& wall, WallDoubts& doubts) {
  const Servo& servo = *wall.drive->servo;
  const double diameter = 2 * scene.smallest_half_axis();
  double stiffness = 0;
  for (const supernormal::effects::Effect& effect : scene.effects) {
    stiffness = std::max(stiffness, contact_stiffness(effect, diameter, servo.stress * diameter * diameter));
  }
  const double most = 4 * diameter * diameter / (stiffness * scene.time.step);
  if (servo.gain <= most) return;
  doubts.add("gain", wall, servo.gain,
             " is a servo with a gain of " + rounded(servo.gain) +
                 " m/(s Pa), with which it may be unstable on the springs of contacts: " + wall.key() + ".drive.gain up to " +
                 rounded(most) + " m/(s Pa), or a smaller time.step would do");
}

}  // namespace

void add_doubts_about_walls(const Scene& scene, std::vector<std::string>& doubts) {
  const double step = scene.time.step, size = scene.smallest_half_axis();
  WallDoubts of_walls;
  const auto add = [&](const char* kind, const Wall& wall, const char* does, double way, const std::string& remedy) {
    if (way > size) of_walls.add(kind, wall, way, moves_too_far(does, way, scene) + remedy);
  };
  const auto shorter = [&](double speed) { return "time.step up to " + rounded(size / speed) + " s would do"; };
  for (const Wall& wall : scene.parts()) {
    const double speed = normal_speed_of(wall, scene);
    add("moves", wall, " moves", step * speed, shorter(speed));
    if (wall.flight) {
      const WallVelocity& velocity = wall.flight->velocity;
      const double fastest = velocity.linear.norm() + velocity.angular.norm() * bounding_radius(wall.shape);
      add("flies", wall, " flies", step * fastest, shorter(fastest));
    }
    if (!wall.drive || !wall.drive->servo) continue;
    add_gain(scene, wall, of_walls);
    const double way = step * std::min(wall.drive->servo->largest_speed, wall.drive->servo->gain * wall.drive->servo->stress);
    add("servo", wall, " is driven", way, wall.key() + ".drive.largest_speed up to " + rounded(size / step) + " m/s would do");
  }
  of_walls.tell(doubts);
}

}  // namespace falling_particles
