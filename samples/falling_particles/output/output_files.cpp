#include "output_files.hpp"

#include <algorithm>
#include <initializer_list>
#include <string>
#include <variant>

#include "base/interval.hpp"

namespace falling_particles {
namespace {

std::string line_of(std::initializer_list<std::string> fields) {
  std::string line;
  for (const std::string& field : fields) line += (line.empty() ? "" : ",") + field;
  return line + '\n';
}

std::string_view columns_of(std::string_view name) { return std::ranges::find(table_formats(), name, &TableFormat::name)->columns; }

}  // namespace

const std::vector<TableFormat>& table_formats() {
  static const std::vector<TableFormat> formats = {
      {kTrajectoryFile, "time_s,body,grain,x_m,y_m,z_m,qw,qx,qy,qz", "a frame and grain that is there", "all scenes",
       [](const Scene& /*scene*/) { return true; }},
      {kEnergiesFile, "time_s,kinetic_J,potential_J,total_J,contacts", "a frame", "all scenes",
       [](const Scene& /*scene*/) { return true; }},
      {kStateFile,
       "time_s,deepest_contact_m,deepest_contact_of_all_steps_m,kinetic_height_m,largest_kinetic_energy_J,energy_lost_J,energy_"
       "gained_J,bodies_leaked",
       "a frame", "all scenes", [](const Scene& /*scene*/) { return true; }},
      {kDischargeFile, "time_s,discharged_kg,discharged_grains", "a frame", "hoppers",
       [](const Scene& scene) { return std::holds_alternative<Hopper>(scene.container); }},
      {kCompressionFile,
       "time_s,cell_side_m,volume_fraction,volume_fraction_at_contact,mean_overlap,target_overlap,contacts_per_grain",
       "a frame after the start", "compressions", [](const Scene& scene) { return scene.compression.has_value(); }},
      {kPartsFile, "time_s,part,x_m,y_m,z_m,qw,qx,qy,qz,vx_m_per_s,vy_m_per_s,vz_m_per_s,wx_rad_per_s,wy_rad_per_s,wz_rad_per_s",
       "a frame and part that moves", "scenes with parts that move",
       [](const Scene& scene) { return std::ranges::any_of(scene.walls, &Wall::moves); }},
      {kGrainsFile, "body,grain,scale,sieve_size_m,mass_kg", "a grain", "scenes with grains of many sizes",
       [](const Scene& scene) { return scene.has_sizes(); }},
      {kFeedersFile, "time_s,feeder,grain,grains,kg", "a frame, feeder and kind that it feeds", "scenes with feeders",
       [](const Scene& scene) { return !scene.feeders.empty(); }},
      {kSinksFile, "time_s,sink,grain,grains,kg", "a frame, sink and kind of the scene", "scenes with sinks",
       [](const Scene& scene) { return !scene.sinks.empty(); }},
  };
  return formats;
}

Table::Table(const std::filesystem::path& path, std::string_view name, const FileState& kept) : file_(path, kept) {
  if (kept.bytes == 0) file_.write(std::string(columns_of(name)) + '\n');
}

Trajectory::Trajectory(const std::filesystem::path& path, const FileState& kept) : Table(path, kTrajectoryFile, kept) {}

void Trajectory::write(double time, const World& world) {
  const std::string start = shortest(time) + ',';
  std::string frame;
  for (const Grain& grain : world.present()) {
    const dReal* position = dBodyGetPosition(grain.body);
    const dReal* quaternion = dBodyGetQuaternion(grain.body);
    frame += start + std::to_string(world.index_of(grain)) + ',' + grain.kind->name;
    for (int i = 0; i < 3; ++i) frame += ',' + shortest(position[i]);
    for (int i = 0; i < 4; ++i) frame += ',' + shortest(quaternion[i]);
    frame += '\n';
  }
  append(frame);
}

Energies::Energies(const std::filesystem::path& path, const FileState& kept) : Table(path, kEnergiesFile, kept) {}

void Energies::write(double time, const Energy& energy, std::size_t contacts) {
  append(line_of(
      {shortest(time), shortest(energy.kinetic), shortest(energy.potential), shortest(energy.total()), std::to_string(contacts)}));
}

StateFile::StateFile(const std::filesystem::path& path, const FileState& kept) : Table(path, kStateFile, kept) {}

void StateFile::write(double time, const State& state) {
  append(line_of({shortest(time), shortest(state.deepest_contact), shortest(state.deepest_contact_of_all_steps),
                  state.kinetic_height ? shortest(*state.kinetic_height) : "", shortest(state.largest_kinetic_energy),
                  shortest(state.energy_lost), shortest(state.energy_gained), std::to_string(state.leaked)}));
}

DischargeFile::DischargeFile(const std::filesystem::path& path, const FileState& kept) : Table(path, kDischargeFile, kept) {}

void DischargeFile::write(double time, double mass, std::size_t count) {
  append(line_of({shortest(time), shortest(mass), std::to_string(count)}));
}

CompressionFile::CompressionFile(const std::filesystem::path& path, const FileState& kept) : Table(path, kCompressionFile, kept) {}

void CompressionFile::write(double time, const Packing& packing) {
  append(line_of({shortest(time), shortest(packing.side), shortest(packing.volume_fraction), shortest(packing.at_contact),
                  shortest(packing.overlap.relative), shortest(packing.target_overlap), shortest(packing.contacts_per_grain)}));
}

FeedersFile::FeedersFile(const std::filesystem::path& path, const FileState& kept) : Table(path, kFeedersFile, kept) {}

void FeedersFile::write(double time, const Population& population) {
  std::string frame;
  for (const Feeding& feeding : population.feeders()) {
    const Feeder& feeder = feeding.feeder();
    for (std::size_t i = 0; i < feeder.mixture.size(); ++i) {
      const Amount& fed = feeding.state().fed[i];
      frame += line_of({shortest(time), feeder.name, feeding.kind(i).name, std::to_string(fed.grains), shortest(fed.mass)});
    }
  }
  append(frame);
}

SinksFile::SinksFile(const std::filesystem::path& path, const FileState& kept) : Table(path, kSinksFile, kept) {}

void SinksFile::write(double time, const Population& population, const Scene& scene) {
  std::string frame;
  for (std::size_t sink = 0; sink < scene.sinks.size(); ++sink) {
    for (std::size_t kind = 0; kind < scene.kinds.size(); ++kind) {
      const Amount& taken = population.taken(sink)[kind];
      frame += line_of({shortest(time), scene.sinks[sink].name, scene.kinds[kind].kind.name, std::to_string(taken.grains),
                        shortest(taken.mass)});
    }
  }
  append(frame);
}

WallsFile::WallsFile(const std::filesystem::path& path, const FileState& kept) : Table(path, kPartsFile, kept) {}

void WallsFile::write(double time, const WallBodies& walls) {
  std::string frame;
  for (std::size_t i = 0; i < walls.count(); ++i) {
    if (!walls.wall(i).moves()) continue;
    const auto& [pose, velocity] = walls.state(i);
    const Eigen::Quaterniond& q = pose.rotation;
    frame += shortest(time) + ',' + walls.wall(i).name;
    for (const double number : pose.position) frame += ',' + shortest(number);
    for (const double number : {q.w(), q.x(), q.y(), q.z()}) frame += ',' + shortest(number);
    for (const double number : velocity.linear) frame += ',' + shortest(number);
    for (const double number : velocity.angular) frame += ',' + shortest(number);
    frame += '\n';
  }
  append(frame);
}

GrainsFile::GrainsFile(const std::filesystem::path& path, const FileState& kept, std::size_t written)
    : Table(path, kGrainsFile, kept), written_(written) {}

void GrainsFile::write(const World& world) {
  std::string lines;
  for (; written_ < world.grains().size(); ++written_) {
    const Grain& grain = world.grains()[written_];
    lines += line_of({std::to_string(written_), grain.kind->name, shortest(grain.scale),
                      shortest(grain.scale * grain.kind->sieve_size()), shortest(grain.mass.mass)});
  }
  append(lines);
}

}  // namespace falling_particles
