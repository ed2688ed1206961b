#include "output_files.hpp"

#include <string>

#include "output/write_file.hpp"
#include "scene/interval.hpp"

namespace falling_particles {
Trajectory::Trajectory(const std::filesystem::path& path) : path_(path), stream_(path) {
  stream_ << "time_s,body,grain,x_m,y_m,z_m,qw,qx,qy,qz\n";
}

void Trajectory::write(double time, const World& world) {
  const std::string start = shortest(time) + ',';
  std::size_t index = 0;
  std::string frame;
  for (const Body& body : world.bodies()) {
    const dReal* position = dBodyGetPosition(body.body);
    const dReal* quaternion = dBodyGetQuaternion(body.body);
    frame += start + std::to_string(index++) + ',' + body.grain->name;
    for (int i = 0; i < 3; ++i) frame += ',' + shortest(position[i]);
    for (int i = 0; i < 4; ++i) frame += ',' + shortest(quaternion[i]);
    frame += '\n';
  }
  stream_ << frame << std::flush;
}

void Trajectory::close() { close_or_throw(stream_, path_); }

Energies::Energies(const std::filesystem::path& path) : path_(path), stream_(path) {
  stream_ << "time_s,kinetic_J,potential_J,total_J,contacts\n";
}

void Energies::write(double time, const Energy& energy, std::size_t contacts) {
  stream_ << shortest(time) << ',' << shortest(energy.kinetic) << ',' << shortest(energy.potential) << ','
          << shortest(energy.total()) << ',' << contacts << std::endl;
}

void Energies::close() { close_or_throw(stream_, path_); }

DischargeFile::DischargeFile(const std::filesystem::path& path) : path_(path), stream_(path) {
  stream_ << "time_s,discharged_kg,discharged_grains\n";
}

void DischargeFile::write(double time, double mass, std::size_t count) {
  stream_ << shortest(time) << ',' << shortest(mass) << ',' << count << std::endl;
}

void DischargeFile::close() { close_or_throw(stream_, path_); }

}  // namespace falling_particles
