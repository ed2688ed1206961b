// The measurement part_force: force and torque on walls.

#include <Eigen/Geometry>
#include <algorithm>

#include "measurement.hpp"
#include "region.hpp"

namespace falling_particles {
namespace {

void measure_force(const Sample& sample, TableText& table, const std::vector<std::string>& walls, const Vector3& about) {
  Vector3 force = Vector3::Zero();
  Vector3 moment = Vector3::Zero();
  std::size_t contacts = 0;
  for (const PairContact& contact : sample.contacts) {
    const Wall* const wall = sample.world.walls().wall_of(contact.geom2);
    if (wall == nullptr || std::ranges::find(walls, wall->name) == walls.end()) continue;
    force -= contact.force;
    moment -= contact.moment;
    if (contact.bears_force()) ++contacts;
  }
  table.add(sample.time).add(contacts).add(force).add(Vector3(moment - about.cross(force))).end_line();
}

}  // namespace

MeasurementKind part_force_kind() {
  constexpr double kFarthest = 1e6;  // m
  return {
      .name = "part_force",
      .measures = "the force of the grains on a wall or on several together, and its torque about a point",
      .parameters =
          {{"surfaces",
            "names: floor, x_low, x_high, y_low, y_high (box, hopper's tray), lid, hopper, dish, ground (terrain), or of parts; "
            "without "
            "it all"},
           {"about", "m, the point; the origin without it"}},
      .columns = "time, force-bearing contacts, force, torque",
      .source = "sum of the feedback of ODE's contact joints",
      .needs_contacts = true,
      .read = [](const TomlTable& table, const Scene& scene) -> MeasurementMaker {
        const std::vector<std::string> chosen = read_surfaces(table, scene);
        Vector3 about = Vector3::Zero();
        if (table.has("about")) {
          about = Vector3(table.numbers("about", 3, Interval::closed(-kFarthest, kFarthest, "m")).data());
        }
        return lines_of("time_s,contacts,force_x_N,force_y_N,force_z_N,torque_x_Nm,torque_y_Nm,torque_z_Nm",
                        [=](const Sample& sample, TableText& lines) { measure_force(sample, lines, chosen, about); });
      },
      .plotted = {"force_x_N", "force_y_N", "force_z_N"},
      .plot_label = "force, N"};
}

}  // namespace falling_particles
