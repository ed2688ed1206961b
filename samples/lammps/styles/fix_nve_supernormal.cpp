#include "styles/fix_nve_supernormal.hpp"

#include <array>

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "kernel/particle_shape.hpp"
#include "update.h"

namespace granular {

using namespace LAMMPS_NS;

FixNveSupernormal::FixNveSupernormal(LAMMPS* lammps, int count, char** words) : Fix(lammps, count, words) {
  if (count != 3) error->all(FLERR, "fix nve/supernormal takes no more words");
  time_integrate = 1;
  scalar_flag = vector_flag = 1;
  size_vector = static_cast<int>(momentum_.size());
  extscalar = extvector = 1;
  global_freq = 1;
  restart_peratom = create_attribute = 1;
  maxexchange = StoredForces::kSize;
  FixNveSupernormal::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
}

FixNveSupernormal::~FixNveSupernormal() {
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
}

int FixNveSupernormal::setmask() { return FixConst::INITIAL_INTEGRATE | FixConst::FINAL_INTEGRATE; }

void FixNveSupernormal::init() { bodies_ = &PairSupernormal::require(lmp, "fix nve/supernormal").bodies(); }

void FixNveSupernormal::kick(int i) {
  const double half = 0.5 * update->dt;
  Vector3::Map(atom->v[i]) += half / atom->rmass[i] * Vector3::Map(atom->f[i]);
  Vector3::Map(atom->angmom[i]) += half * Vector3::Map(atom->torque[i]);
}

void FixNveSupernormal::initial_integrate(int /*vflag*/) {
  for (int i = 0; i < atom->nlocal; ++i) {
    if ((atom->mask[i] & groupbit) == 0) continue;
    if (forces_.is_restored) forces_.put_back(*atom, i);
    kick(i);
    Vector3::Map(atom->x[i]) += update->dt * Vector3::Map(atom->v[i]);
    double* q = bodies_->quaternion(i);
    const Eigen::Quaterniond turned = rotate_freely(Eigen::Quaterniond(q[0], q[1], q[2], q[3]), Vector3::Map(atom->angmom[i]),
                                                    atom->rmass[i] * bodies_->shape(i).unit_inertia, update->dt);
    q[0] = turned.w();
    Vector3::Map(q + 1) = turned.vec();
  }
  forces_.is_restored = false;
}

void FixNveSupernormal::final_integrate() {
  for (int i = 0; i < atom->nlocal; ++i) {
    if ((atom->mask[i] & groupbit) == 0) continue;
    kick(i);
    forces_.store(*atom, i);
  }
}

double FixNveSupernormal::compute_scalar() {
  bodies_->read_motion();
  double own = 0, all = 0;
  for (int i = 0; i < atom->nlocal; ++i) {
    if ((atom->mask[i] & groupbit) != 0) own += 0.5 * bodies_->body(i).angular_velocity.dot(Vector3::Map(atom->angmom[i]));
  }
  MPI_Allreduce(&own, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

void FixNveSupernormal::find_momentum() {
  Vector3 linear = Vector3::Zero(), angular = Vector3::Zero();
  for (int i = 0; i < atom->nlocal; ++i) {
    if ((atom->mask[i] & groupbit) == 0) continue;
    Vector3 position;
    domain->unmap(atom->x[i], atom->image[i], position.data());
    const Vector3 momentum = atom->rmass[i] * Vector3::Map(atom->v[i]);
    linear += momentum;
    angular += position.cross(momentum) + Vector3::Map(atom->angmom[i]);
  }
  std::array<double, 6> own{};
  Vector3::Map(own.data()) = linear;
  Vector3::Map(own.data() + 3) = angular;
  MPI_Allreduce(own.data(), momentum_.data(), static_cast<int>(own.size()), MPI_DOUBLE, MPI_SUM, world);
  momentum_step_ = update->ntimestep;
}

double FixNveSupernormal::compute_vector(int index) {
  if (index == 0 || momentum_step_ != update->ntimestep) find_momentum();
  return momentum_[static_cast<std::size_t>(index)];
}

}  // namespace granular
