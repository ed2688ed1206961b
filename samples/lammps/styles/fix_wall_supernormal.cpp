#include "styles/fix_wall_supernormal.hpp"

#include <cstring>
#include <exception>
#include <string>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "update.h"

namespace granular {

using namespace LAMMPS_NS;

FixWallSupernormal::FixWallSupernormal(LAMMPS* lammps, int count, char** words)
    : Fix(lammps, count, words), first_counter_(lammps->update->ntimestep) {
  try {
    command_ = read_wall_command(Words({words + 3, words + count}, lammps));
  } catch (const std::exception& refusal) {
    error->all(FLERR, std::string("fix wall/supernormal: ") + refusal.what());
  }
  scalar_flag = vector_flag = 1;
  size_vector = kSums - 1;
  extscalar = extvector = 1;
  global_freq = 1;
  energy_global_flag = 1;
  create_attribute = 1;
  restart_peratom = restart_global = 1;
  maxexchange = 1 + WallHistory::kMost * ContactHistory::kSize;
  FixWallSupernormal::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
}

FixWallSupernormal::~FixWallSupernormal() {
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
}

int FixWallSupernormal::setmask() { return FixConst::POST_FORCE; }

void FixWallSupernormal::init() {
  pair_ = &PairSupernormal::require(lmp, "fix wall/supernormal");
  if (command_.type && (*command_.type < 1 || *command_.type > atom->ntypes)) {
    error->all(FLERR, fmt::format("fix wall/supernormal: type = {} is outside [1, {}]", *command_.type, atom->ntypes));
  }
}

const ContactMaterial& FixWallSupernormal::material(int type) const {
  return command_.type ? pair_->material(type, *command_.type) : command_.material;
}

// A run continues with the wall where it is. The snapshots of a `rerun` have no previous step: there the step counter gives the
// time.
void FixWallSupernormal::setup(int vflag) {
  const bool is_run = update->ntimestep == update->firststep && update->laststep - update->firststep == update->nsteps;
  if (!is_run) clock_ = Clock({0, static_cast<double>(update->ntimestep - first_counter_), update->dt});
  post_force(vflag);
}

Body FixWallSupernormal::wall_body(double step) const {
  using namespace falling_particles;
  const WallPose start{command_.anchor, Eigen::Quaterniond::Identity()};
  const double time = clock_.now(), before = time - step, after = time + step;
  const WallPose now = pose_at(start, command_.motions, time);
  // Springs grow by the velocity at this moment, as for the particles. The mean velocity of the steps before and after it adds up
  // to the displacement of the wall. In a rotation it has no radial component, unlike the mean of a single step.
  const WallVelocity moved =
      mean_velocity(pose_at(start, command_.motions, before), pose_at(start, command_.motions, after), after - before);
  const WallVelocity belt = conveyor_velocity(start, now, command_.motions, before, after);
  Body body;
  body.pose = {now.position, now.rotation.toRotationMatrix()};
  body.velocity = moved.linear + belt.linear;
  body.angular_velocity = moved.angular + belt.angular;
  return body;
}

void FixWallSupernormal::post_force(int /*vflag*/) {
  sums_.fill(0);
  const double step = update->setupflag != 0 ? 0 : update->dt;
  if (step > 0) clock_.advance(step);
  const Body wall = wall_body(update->dt);
  const BodyTable& bodies = pair_->bodies();
  for (int i = 0; i < atom->nlocal; ++i) {
    if ((atom->mask[i] & groupbit) == 0) continue;
    const WallForce found =
        find_wall_force(*command_.wall, wall, bodies.shape(i), bodies.body(i), material(atom->type[i]), step, history(i), scratch_);
    if (found.contacts == 0) continue;
    Vector3::Map(atom->f[i]) += found.force;
    Vector3::Map(atom->torque[i]) += found.torque;
    sums_[0] += found.energy;
    Vector3::Map(&sums_[1]) -= found.force;
    Vector3::Map(&sums_[4]) += found.wall_torque;
    sums_[7] += found.contacts;
  }
  totals_step_ = -1;
}

double FixWallSupernormal::total(int index) {
  if (totals_step_ != update->ntimestep) {
    MPI_Allreduce(sums_.data(), totals_.data(), kSums, MPI_DOUBLE, MPI_SUM, world);
    totals_step_ = update->ntimestep;
  }
  return totals_[static_cast<std::size_t>(index)];
}

void FixWallSupernormal::copy_arrays(int from, int to, int /*deleted*/) { history(to) = history(from); }

int FixWallSupernormal::pack_exchange(int i, double* buffer) {
  const WallHistory& packed = history(i);
  int size = 0;
  buffer[size++] = packed.count;
  for (int k = 0; k < packed.count; ++k, size += ContactHistory::kSize) {
    packed.contacts.at(static_cast<std::size_t>(k)).store(buffer + size);
  }
  return size;
}

int FixWallSupernormal::unpack_exchange(int i, double* buffer) {
  WallHistory& unpacked = history(i);
  int size = 0;
  unpacked.count = static_cast<int>(buffer[size++]);
  for (int k = 0; k < unpacked.count; ++k, size += ContactHistory::kSize) {
    unpacked.contacts.at(static_cast<std::size_t>(k)) = ContactHistory::load(buffer + size);
  }
  return size;
}

// In a restart file, the first number of a fix is the count of its numbers.
int FixWallSupernormal::pack_restart(int i, double* buffer) {
  const int size = pack_exchange(i, buffer + 1) + 1;
  buffer[0] = size;
  return size;
}

void FixWallSupernormal::unpack_restart(int i, int set) {
  double* numbers = atom->extra[i];
  for (int k = 0; k < set; ++k) numbers += static_cast<int>(*numbers);
  unpack_exchange(i, numbers + 1);
}

int FixWallSupernormal::size_restart(int i) { return 2 + history(i).count * ContactHistory::kSize; }
int FixWallSupernormal::maxsize_restart() { return 2 + WallHistory::kMost * ContactHistory::kSize; }

void FixWallSupernormal::write_restart(FILE* file) {
  if (comm->me != 0) return;
  const Clock::State state = clock_.state();
  const int bytes = sizeof(state);
  fwrite(&bytes, sizeof(bytes), 1, file);
  fwrite(&state, sizeof(state), 1, file);
}

void FixWallSupernormal::restart(char* buffer) {
  Clock::State state;
  std::memcpy(&state, buffer, sizeof(state));
  clock_ = Clock(state);
}

}  // namespace granular
