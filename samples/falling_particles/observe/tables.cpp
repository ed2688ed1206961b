// The tables that a run writes unasked: measurements that are on by default. A new table is an entry of kTables.

#include <algorithm>
#include <array>
#include <variant>

#include "measurement.hpp"
#include "simulation.hpp"

namespace falling_particles {
namespace {

struct TableOfFrames {
  const char* name;
  const char* measures;
  const char* columns;
  const char* lines;   // what each line is about
  const char* scenes;  // the scenes that have the table, in words
  bool (*is_on)(const Scene& scene);
  void (*write)(const Sample& sample, TableText& table);
  bool is_of_end = false;
};

bool is_always_on(const Scene& /*scene*/) { return true; }

void write_trajectory(const Sample& sample, TableText& table) {
  const std::string time = shortest(sample.time);
  for (const Grain& grain : sample.world.present()) {
    table.add(time).add(sample.world.index_of(grain)).add(grain.kind->name);
    table.add(grain.position()).add(grain.quaternion()).end_line();
  }
}

/// Everything from which another run can start (input/load_start.cpp).
void write_final_state(const Sample& sample, TableText& table) {
  const std::string time = shortest(sample.time);
  for (const Grain& grain : sample.world.present()) {
    table.add(time).add(sample.world.index_of(grain)).add(grain.kind->name).add(grain.scale);
    table.add(grain.position()).add(grain.quaternion()).add(grain.velocity()).add(grain.angular_velocity()).end_line();
  }
}

void write_energies(const Sample& sample, TableText& table) {
  const Energy energy = measure_energy(sample.world, sample.world.scene());
  table.add(sample.time).add(energy.kinetic).add(energy.potential).add(energy.total());
  table.add(sample.simulation->stepper.contacts()).end_line();
}

void write_state(const Sample& sample, TableText& table) {
  const Stepper& stepper = sample.simulation->stepper;
  const Watches& watches = sample.simulation->watches;
  const Scene& scene = sample.world.scene();
  double deepest = 0;
  for (const dContactGeom& contact : stepper.contact_geoms()) deepest = std::max<double>(deepest, contact.depth);
  table.add(sample.time).add(deepest).add(stepper.deepest_contact());
  scene.gravity() == nullptr ? table.blank() : table.add(kinetic_height(sample.world, scene));
  table.add(largest_kinetic_energy(sample.world)).add(watches.energy.lost()).add(watches.energy.gained());
  table.add(watches.leaks.count()).end_line();
}

void write_discharge(const Sample& sample, TableText& table) {
  const Discharge& discharge = *sample.simulation->watches.discharge;
  table.add(sample.time).add(discharge.mass()).add(discharge.count()).end_line();
}

// At the start no contact has been measured yet.
void write_compression(const Sample& sample, TableText& table) {
  if (sample.time == 0) return;
  const Packing& packing = sample.simulation->watches.compressor->packing();
  table.add(sample.time).add(packing.side).add(packing.volume_fraction).add(packing.at_contact);
  table.add(packing.overlap.relative).add(packing.target_overlap).add(packing.contacts_per_grain).end_line();
}

/// What drives a part in the last step: a force or a torque, and the stress on a servo.
void write_drive(const WallBodies& walls, std::size_t index, TableText& table) {
  const DrivenState* driven = walls.driven(index);
  const bool turns = driven != nullptr && walls.wall(index).drive->turns();
  driven != nullptr && !turns ? table.add(driven->push) : table.blank();
  turns ? table.add(driven->push) : table.blank();
  table.add(walls.servo_stress(index)).end_line();
}

/// The velocity of a part is the mean of the last step, without the motion of a conveyor's surface.
void write_parts(const Sample& sample, TableText& table) {
  const WallBodies& walls = sample.world.walls();
  for (std::size_t i = 0; i < walls.count(); ++i) {
    if (!walls.wall(i).moves()) continue;
    const auto& [pose, velocity] = walls.state(i);
    table.add(sample.time).add(walls.wall(i).name).add(pose.position).add(pose.rotation);
    table.add(velocity.linear).add(velocity.angular);
    write_drive(walls, i, table);
  }
}

/// A line for each grain that was inserted since the last sample.
void write_grains(const Sample& sample, TableText& table) {
  const std::vector<Grain>& grains = sample.world.grains();
  for (std::size_t i = sample.lines; i < grains.size(); ++i) {
    const Grain& grain = grains[i];
    table.add(i).add(grain.kind->name).add(grain.scale).add(grain.scale * grain.kind->sieve_size()).add(grain.mass.mass);
    table.end_line();
  }
}

void write_amount(const Sample& sample, const std::string& by, const GrainKind& kind, const Amount& amount, TableText& table) {
  table.add(sample.time).add(by).add(kind.name).add(std::to_string(amount.grains)).add(amount.mass).end_line();
}

/// The amounts that were fed so far.
void write_feeders(const Sample& sample, TableText& table) {
  for (const Feeding& feeding : sample.simulation->population.feeders()) {
    for (std::size_t i = 0; i < feeding.feeder().mixture.size(); ++i) {
      write_amount(sample, feeding.feeder().name, feeding.kind(i), feeding.state().fed[i], table);
    }
  }
}

/// The amounts that were removed so far.
void write_sinks(const Sample& sample, TableText& table) {
  const Scene& scene = sample.world.scene();
  for (std::size_t sink = 0; sink < scene.sinks.size(); ++sink) {
    const std::vector<Amount>& taken = sample.simulation->population.taken(sink);
    for (std::size_t kind = 0; kind < scene.kinds.size(); ++kind) {
      write_amount(sample, scene.sinks[sink].name, scene.kinds[kind].kind, taken[kind], table);
    }
  }
}

void write_bonds(const Sample& sample, TableText& table) {
  const Bonds& bonds = *sample.world.bonds();
  table.add(sample.time).add(bonds.intact()).add(bonds.breaks().size()).add(bonds.energy()).end_line();
}

/// The name of the rule of a bond, and its bodies: the numbers of two grains, or the name of a part and the number of a grain.
void add_bond(const Scene& scene, const Bond& bond, TableText& table) {
  const BondRule& rule = scene.bonds[bond.rule];
  table.add(rule.name).add(bond.first == Bond::kPart ? scene.walls[*rule.wall].name : std::to_string(bond.first));
  table.add(std::to_string(bond.second));
}

/// A line for each bond that broke since the last sample.
void write_broken_bonds(const Sample& sample, TableText& table) {
  const Bonds& bonds = *sample.world.bonds();
  for (std::size_t i = sample.lines; i < bonds.breaks().size(); ++i) {
    const BondBreak& failure = bonds.breaks()[i];
    const Bond& bond = bonds.all()[failure.bond];
    table.add(failure.time);
    add_bond(sample.world.scene(), bond, table);
    table.add(failure.place).add(cause_of(failure, sample.world.scene().bonds[bond.rule]));
    const auto& [tension, bending, shear, torsion] = failure.stress;
    table.add(tension).add(bending).add(shear).add(torsion).end_line();
  }
}

/// Everything from which another run can bond the grains of final_state.csv (input/load_bonds.cpp).
void write_final_bonds(const Sample& sample, TableText& table) {
  for (const Bond& bond : sample.world.bonds()->all()) {
    if (bond.is_broken) continue;
    table.add(sample.time);
    add_bond(sample.world.scene(), bond, table);
    table.add(bond.radius).add(bond.rest.start).add(bond.rest.centre).add(bond.rest.rotation).end_line();
  }
}

bool has_bonds(const Scene& scene) { return !scene.bonds.empty(); }

/// In the order of the list for users.
constexpr std::array kTables = {
    TableOfFrames{"trajectory", "positions and orientations of the grains; the index of a removed grain is never used again",
                  "time_s,body,grain,x_m,y_m,z_m,qw,qx,qy,qz", "a frame and grain that is there", "all scenes", is_always_on,
                  write_trajectory},
    TableOfFrames{"energies", "the energies of all grains, and the number of contacts",
                  "time_s,kinetic_J,potential_J,total_J,contacts", "a frame", "all scenes", is_always_on, write_energies},
    TableOfFrames{"state", "the end state of the summary, at any time of the run",
                  "time_s,deepest_contact_m,deepest_contact_of_all_steps_m,kinetic_height_m,largest_kinetic_energy_J,"
                  "energy_lost_J,energy_gained_J,bodies_leaked",
                  "a frame", "all scenes", is_always_on, write_state},
    TableOfFrames{"discharge", "the grains that have passed the outlet so far", "time_s,discharged_kg,discharged_grains", "a frame",
                  "hoppers", [](const Scene& scene) { return std::holds_alternative<Hopper>(scene.container); }, write_discharge},
    TableOfFrames{"compression", "the packing in the cell",
                  "time_s,cell_side_m,volume_fraction,volume_fraction_at_contact,mean_overlap,target_overlap,contacts_per_grain",
                  "a frame after the start", "compressions", [](const Scene& scene) { return scene.compression.has_value(); },
                  write_compression},
    TableOfFrames{"parts",
                  "poses of parts, their mean velocities in the last step, what drove them in it, and the stress on servos",
                  "time_s,part,x_m,y_m,z_m,qw,qx,qy,qz,vx_m_per_s,vy_m_per_s,vz_m_per_s,wx_rad_per_s,wy_rad_per_s,wz_rad_per_s,"
                  "drive_force_N,drive_torque_Nm,servo_stress_Pa",
                  "a frame and part that moves", "scenes with parts that move",
                  [](const Scene& scene) { return std::ranges::any_of(scene.walls, &Wall::moves); }, write_parts},
    TableOfFrames{"grains", "sizes and masses of the grains; the scale is the factor on the lengths of the kind",
                  "body,grain,scale,sieve_size_m,mass_kg", "a grain", "scenes with grains of many sizes",
                  [](const Scene& scene) { return scene.has_sizes(); }, write_grains},
    TableOfFrames{"final_state", "poses, velocities and sizes of the grains at the end, from which another run can start",
                  "time_s,body,grain,scale,x_m,y_m,z_m,qw,qx,qy,qz,vx_m_per_s,vy_m_per_s,vz_m_per_s,wx_rad_per_s,wy_rad_per_s,"
                  "wz_rad_per_s",
                  "a grain that is there at the end", "all scenes", is_always_on, write_final_state, true},
    TableOfFrames{"feeders", "the amounts fed so far", "time_s,feeder,grain,grains,kg", "a frame, feeder and kind that it feeds",
                  "scenes with feeders", [](const Scene& scene) { return !scene.feeders.empty(); }, write_feeders},
    TableOfFrames{"sinks", "the amounts removed so far", "time_s,sink,grain,grains,kg", "a frame, sink and kind of the scene",
                  "scenes with sinks", [](const Scene& scene) { return !scene.sinks.empty(); }, write_sinks},
    TableOfFrames{"bonds", "the number of bonds, and their elastic energy", "time_s,bonds,broken,elastic_J", "a frame",
                  "scenes with bonds", has_bonds, write_bonds},
    TableOfFrames{"broken_bonds",
                  "when, where and why bonds broke; body_1 may be a part. The stresses are those of the outermost fibre",
                  "time_s,bond,body_1,body_2,x_m,y_m,z_m,cause,tension_Pa,bending_Pa,shear_Pa,torsion_Pa", "a bond that broke",
                  "scenes with bonds", has_bonds, write_broken_bonds},
    TableOfFrames{"final_bonds",
                  "the bonds at the end, from which another run can start; start and centre are in the frame of body_1",
                  "time_s,bond,body_1,body_2,radius_m,start_x_m,start_y_m,start_z_m,x_m,y_m,z_m,qw,qx,qy,qz",
                  "a bond that is there at the end", "scenes with bonds", has_bonds, write_final_bonds, true},
};

MeasurementKind kind_of(const TableOfFrames& table) {
  const MeasurementMaker make = lines_of(table.columns, table.write);
  const auto read = [&table, make](const TomlTable& section, const Scene& scene) -> MeasurementMaker {
    if (!table.is_on(scene)) {
      section.fail("kind", std::string("measurement.kind is \"") + table.name + "\"; allowed: in " + table.scenes);
    }
    return make;
  };
  return {.name = table.name,
          .measures = table.measures,
          .columns = table.columns,
          .read = read,
          .on_by_default = OnByDefault{table.lines, table.scenes, table.is_on, make, table.is_of_end}};
}

}  // namespace

std::vector<MeasurementKind> table_kinds() {
  std::vector<MeasurementKind> kinds;
  kinds.reserve(kTables.size());
  for (const TableOfFrames& table : kTables) kinds.push_back(kind_of(table));
  return kinds;
}

}  // namespace falling_particles
