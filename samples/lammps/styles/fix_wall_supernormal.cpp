#include "styles/fix_wall_supernormal.hpp"

#include <cmath>
#include <cstring>
#include <exception>
#include <string>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "modify.h"
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
  if (command_.drive) driven_.emplace(command_.drive->drive, common::WallPose{command_.anchor});
  scalar_flag = vector_flag = 1;
  is_extensive_.assign(kSums - 1, 1);
  if (driven_) is_extensive_.resize(is_extensive_.size() + kDriveValues, 0);
  size_vector = static_cast<int>(is_extensive_.size());
  extscalar = 1;
  extvector = -1;
  extlist = is_extensive_.data();
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

int FixWallSupernormal::setmask() {
  return FixConst::POST_FORCE | (driven_ ? FixConst::INITIAL_INTEGRATE | FixConst::FINAL_INTEGRATE : 0);
}

void FixWallSupernormal::init() {
  constexpr int kMinimization = 2;
  if (update->whichflag == kMinimization) error->all(FLERR, "fix wall/supernormal: walls do not act in a minimization; use run");
  pair_ = &PairSupernormal::require(lmp, "fix wall/supernormal");
  if (command_.type && (*command_.type < 1 || *command_.type > atom->ntypes)) {
    error->all(FLERR, fmt::format("fix wall/supernormal: type = {} is outside [1, {}]", *command_.type, atom->ntypes));
  }
  if (command_.drive && !command_.drive->between.empty()) find_facing_walls();
  if (command_.drive && !command_.drive->gravity.empty()) {
    const std::string& name = command_.drive->gravity;
    const int found = modify->find_fix(name);
    int dimension = 0;
    gravity_ = found < 0 ? nullptr : static_cast<const double*>(modify->fix[found]->extract("gvec", dimension));
    if (gravity_ == nullptr) error->all(FLERR, "fix wall/supernormal: drive: gravity: there is no fix gravity " + name);
  }
}

void FixWallSupernormal::find_facing_walls() {
  constexpr double kRightAngle = 1e-6;  // cosine; above the rounding of an input's digits
  for (std::size_t k = 0; k < facing_.size(); ++k) {
    const std::string& name = command_.drive->between[k];
    const int found = modify->find_fix(name);
    facing_[k] = found < 0 ? nullptr : dynamic_cast<const FixWallSupernormal*>(modify->fix[found]);
    if (facing_[k] == nullptr || !facing_[k]->command_.normal) {
      error->all(FLERR, "fix wall/supernormal: drive: between: there is no fix wall/supernormal with a plane " + name);
    }
  }
  const Vector3 n = facing_[0]->normal(), m = facing_[2]->normal();
  const Vector3& axis = command_.drive->drive.axis;
  if ((n + facing_[1]->normal()).norm() > kRightAngle || (m + facing_[3]->normal()).norm() > kRightAngle ||
      std::abs(n.dot(m)) > kRightAngle || std::abs(n.dot(axis)) > kRightAngle || std::abs(m.dot(axis)) > kRightAngle) {
    error->all(FLERR,
               "fix wall/supernormal: drive: between takes planes that face each other, the first two and the last two, at "
               "right angles to the axis and to each other");
  }
  driven_->set_area(area_between());
}

double FixWallSupernormal::area_between() const {
  const auto distance = [](const FixWallSupernormal& one, const FixWallSupernormal& other) {
    return std::abs(one.normal().dot(other.pose().position - one.pose().position));
  };
  return distance(*facing_[0], *facing_[1]) * distance(*facing_[2], *facing_[3]);
}

const ContactMaterial& FixWallSupernormal::material(int type) const {
  return command_.type ? pair_->material(type, *command_.type) : command_.material;
}

// A run continues with the wall where it is. The snapshots of a `rerun` have no previous step: there the step counter gives the
// time.
void FixWallSupernormal::setup(int vflag) {
  const bool is_run = update->ntimestep == update->firststep && update->laststep - update->firststep == update->nsteps;
  if (!is_run && driven_) error->all(FLERR, "fix wall/supernormal: the place of a driven wall is unknown in a rerun");
  if (!is_run) clock_ = Clock({0, static_cast<double>(update->ntimestep - first_counter_), update->dt});
  const DrivenWall::State before = driven_ ? driven_->state() : DrivenWall::State();
  post_force(vflag);
  // The load of the last step goes on, as the forces of the particles do.
  if (is_drive_restored_) driven_->restore(before);
  is_drive_restored_ = false;
}

common::WallPose FixWallSupernormal::carrier_at(double time) const {
  return pose_at({command_.anchor, Eigen::Quaterniond::Identity()}, command_.motions, time);
}

common::WallPose FixWallSupernormal::pose() const {
  const common::WallPose carrier = carrier_at(clock_.now());
  return driven_ ? driven_->pose_on(carrier) : carrier;
}

void FixWallSupernormal::kick(double now) {
  const Vector3 gravity = gravity_ == nullptr ? Vector3(Vector3::Zero()) : Vector3(Vector3::Map(gravity_));
  driven_->kick(carrier_at(clock_.now()), gravity, now, update->dt);
}

void FixWallSupernormal::initial_integrate(int /*vflag*/) {
  kick(clock_.now() + 0.25 * update->dt);
  driven_->drift(update->dt);
}

void FixWallSupernormal::final_integrate() { kick(clock_.now() - 0.25 * update->dt); }

Body FixWallSupernormal::wall_body(double step) const {
  using namespace common;
  const WallPose start{command_.anchor, Eigen::Quaterniond::Identity()};
  const double time = clock_.now(), before = time - step, after = time + step;
  const WallPose carrier = carrier_at(time);
  // Springs grow by the velocity at this moment, as for the particles. The mean velocity of the steps before and after it adds up
  // to the displacement of the wall. In a rotation it has no radial component, unlike the mean of a single step.
  const WallVelocity carried = mean_velocity(carrier_at(before), carrier_at(after), after - before);
  const WallPose now = driven_ ? driven_->pose_on(carrier) : carrier;
  const WallVelocity moved = driven_ ? driven_->velocity_on(carrier, carried) : carried;
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
    pair_->warn_of_depth(found.depth, i, "a wall", bodies.shape(i).least_half_axis);
    Vector3::Map(atom->f[i]) += found.force;
    Vector3::Map(atom->torque[i]) += found.torque;
    sums_[0] += found.energy;
    Vector3::Map(&sums_[1]) -= found.force;
    Vector3::Map(&sums_[4]) += found.wall_torque;
    sums_[7] += found.contacts;
  }
  totals_step_ = -1;
  if (driven_) {
    total(0);
    if (facing_[0] != nullptr) driven_->set_area(area_between());
    driven_->load(carrier_at(clock_.now()), Vector3::Map(&totals_[1]), Vector3::Map(&totals_[4]));
  }
}

double FixWallSupernormal::compute_vector(int index) {
  if (index + 1 < kSums) return total(index + 1);
  const DrivenWall::State& state = driven_->state();
  return std::array{state.position, state.speed, state.push, driven_->stress()}.at(static_cast<std::size_t>(index + 1 - kSums));
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
  const Stored stored{kind(), clock_.state(), driven_ ? driven_->state() : DrivenWall::State()};
  // Otherwise equal runs would write different bytes.
  static_assert(sizeof(Stored) == sizeof(DriveKind) + sizeof(Clock::State) + sizeof(DrivenWall::State));
  const int bytes = sizeof(stored);
  fwrite(&bytes, sizeof(bytes), 1, file);
  fwrite(&stored, sizeof(stored), 1, file);
}

FixWallSupernormal::DriveKind FixWallSupernormal::kind() const {
  if (!driven_) return DriveKind::None;
  return command_.drive->drive.turns() ? DriveKind::Turns : DriveKind::Slides;
}

void FixWallSupernormal::restart(char* buffer) {
  Stored stored;
  std::memcpy(&stored, buffer, sizeof(stored));
  clock_ = Clock(stored.clock);
  // A wall that had no drive begins at its start.
  if (stored.kind == DriveKind::None) return;
  if (stored.kind != kind()) {
    const auto name = [](DriveKind one) {
      return one == DriveKind::None ? "no drive" : one == DriveKind::Slides ? "a drive that slides" : "a drive that turns";
    };
    error->all(FLERR, fmt::format("fix wall/supernormal: {} has {}, and in the restart file {}; another wall takes another ID", id,
                                  name(kind()), name(stored.kind)));
  }
  driven_->restore(stored.driven);
  is_drive_restored_ = true;
}

}  // namespace granular
