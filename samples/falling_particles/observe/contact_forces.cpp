// The measurement contact_forces: a line for each contact.

#include "measurement.hpp"
#include "region.hpp"

namespace falling_particles {
namespace {

void list_contacts(const Sample& sample, TableText& table, const SamplingRegion& region) {
  const Bounds bounds = region.bounds(sample.world);
  const Grain* grains = sample.world.grains().data();
  for (const PairContact& contact : sample.contacts) {
    if (!bounds.contains(contact.position)) continue;
    table.add(sample.time).add(static_cast<std::size_t>(contact.grain1 - grains)).add(contact.grain1->kind->name);
    if (contact.grain2 != nullptr) {
      table.add(static_cast<std::size_t>(contact.grain2 - grains)).add(contact.grain2->kind->name);
    } else {
      const Wall* const wall = sample.world.walls().wall_of(contact.geom2);
      table.blank().add(wall == nullptr ? "wall" : wall->name);
    }
    const double normal_force = contact.normal_force();
    const Vector3 tangential = contact.force - normal_force * contact.normal;
    table.add(contact.position).add(contact.normal).add(contact.overlap).add(normal_force).add(tangential);
    table.add(static_cast<std::size_t>(contact.points)).end_line();
  }
}

}  // namespace

MeasurementKind contact_forces_kind() {
  return {.name = "contact_forces",
          .measures = "every contact with its forces, a line each",
          .parameters = {{"lower, upper", "m, corners of a box that holds the contacts; without them everywhere"}},
          .columns =
              "time, the two grains and their kinds (of a wall its name), position, normal towards grain 1, overlap, normal force, "
              "tangential force on grain 1, points",
          .source = "feedback of ODE's contact joints",
          .needs_contacts = true,
          .read = [](const TomlTable& table, const Scene& scene) -> MeasurementMaker {
            const SamplingRegion region(table, scene, SamplingRegion::Without::Everywhere);
            return lines_of(
                "time_s,grain1,kind1,grain2,kind2,x_m,y_m,z_m,normal_x,normal_y,normal_z,overlap_m,normal_force_N,"
                "tangential_x_N,tangential_y_N,tangential_z_N,points",
                [=](const Sample& sample, TableText& lines) { list_contacts(sample, lines, region); });
          }};
}

}  // namespace falling_particles
