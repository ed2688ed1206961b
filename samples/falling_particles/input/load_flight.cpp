#include "load_flight.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <supernormal/shapes/shape.hpp>

#include "load_drive.hpp"
#include "load_motion.hpp"

namespace falling_particles {
namespace {

// ODE inverts a moment of inertia with its square. The bounds are those of a wall of 1e-12 kg and 1 mm, and of 1e6 kg and 1 km.
const Interval kMoments = Interval::closed(1e-18, 1e12, "kg m^2, about the centre of mass, along the axes of the part");

Eigen::Matrix3d read_inertia(const TomlTable& table) {
  const Vector3 moments = read_vector(table, "inertia", kMoments);
  constexpr double kRounding = 1e-9;  // of a plate, whose largest moment is the sum of the others
  if (2 * moments.maxCoeff() > (1 + kRounding) * moments.sum()) {
    table.fail("inertia", table.full_name("inertia") + " is [" + shortest(moments.x()) + ", " + shortest(moments.y()) + ", " +
                              shortest(moments.z()) +
                              "] kg m^2, which no body has; allowed: moments of which none exceeds the sum of the others");
  }
  return moments.asDiagonal();
}

void read_solid(const TomlTable& table, const Wall& wall, Flight& flight) {
  const std::optional<supernormal::MassProperties> solid = solid_of(wall.shape);
  if (solid) {
    flight.centre = solid->centroid;
    flight.inertia = flight.mass / solid->volume * solid->inertia();
  } else if (!table.has("inertia")) {
    table.fail("", table.full_name("inertia") +
                       " is missing, and the mesh has no volume: it is two-sided, or its triangles do not close, "
                       "with their fronts outside; allowed: three numbers, " +
                       kMoments.unit);
  }
  if (table.has("inertia")) flight.inertia = read_inertia(table);
  if (table.has("centre")) {
    flight.centre = read_vector(table, "centre", Interval::closed(-kLargestLength, kLargestLength, "m, in the frame of the part"));
  }
}

Vector3 read_spin(const TomlTable& table, const Time& time) {
  const double most = 2 * std::numbers::pi * kLargestTurn / time.step;
  const Vector3 spin = read_vector(table, "angular_velocity", Interval::finite("rad/s"));
  if (spin.norm() > most) {
    table.fail("angular_velocity", table.full_name("angular_velocity") + " is " + rounded(spin.norm()) + " rad/s; allowed: up to " +
                                       rounded(most) + " rad/s, a tenth of a revolution in a step");
  }
  return spin;
}

}  // namespace

std::optional<Flight> read_flight(const TomlTable& part, const Wall& wall, const Time& time) {
  const auto table = part.find_table("free", {"mass", "inertia", "centre", "velocity", "angular_velocity", "from"});
  if (!table) return std::nullopt;
  if (!wall.motions.empty() || wall.drive) {
    part.fail("free", std::string("part.free beside part.") + (wall.drive ? "drive" : "motion") +
                          "; allowed: one of both, or part.free.velocity at the start");
  }
  if (!std::isfinite(bounding_radius(wall.shape))) {
    part.fail("free", "part.free of a plane, which is infinite; allowed: with the other shapes");
  }
  Flight flight;
  flight.mass = table->number("mass", Interval::closed(kLightest, kHeaviest, "kg"));
  read_solid(*table, wall, flight);
  if (table->has("velocity")) {
    flight.velocity.linear = read_vector(*table, "velocity", Interval::closed(-kLargestSpeed, kLargestSpeed, "m/s"));
  }
  if (table->has("angular_velocity")) flight.velocity.angular = read_spin(*table, time);
  flight.from = read_times(*table).first;
  return flight;
}

}  // namespace falling_particles
