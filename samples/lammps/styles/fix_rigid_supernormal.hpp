// fix rigid/.../supernormal: rigid clusters of superellipsoids.
#pragma once

#include <concepts>
#include <vector>

#include "atom.h"
#include "error.h"
#include "fix_rigid.h"
#include "fix_rigid_nve.h"
#include "fix_rigid_nve_small.h"
#include "fix_rigid_small.h"
#include "styles/body_table.hpp"
#include "styles/pair_supernormal.hpp"
#include "styles/stored_forces.hpp"

namespace granular {

/// A fix of LAMMPS that moves rigid clusters, for clusters of superellipsoids. LAMMPS computes inertia and spin from the half-axes
/// of particles, as if they were ellipsoids. So wherever it does, particles have the half-axes of the ellipsoid with their inertia.
/// LAMMPS reads clusters from their particles after a restart, so a restarted run is the same but for rounding.
template <typename Base>
class FixRigidSupernormal : public Base, public RigidClusters {
 public:
  FixRigidSupernormal(LAMMPS_NS::LAMMPS* lammps, int count, char** words) : Base(lammps, count, words) {
    this->restart_peratom = 1;
    this->maxexchange += StoredForces::kSize;
    forces_.grow(this->atom->nmax);
    this->atom->add_callback(LAMMPS_NS::Atom::RESTART);
  }
  ~FixRigidSupernormal() override { this->atom->delete_callback(this->id, LAMMPS_NS::Atom::RESTART); }

  void init() override {
    refuse_new_tags();
    bodies_ = &PairSupernormal::require(this->lmp, this->style).bodies();
    with_ellipsoids([&] { Base::init(); });
  }
  void setup_pre_neighbor() override {
    with_ellipsoids([&] { Base::setup_pre_neighbor(); });
  }
  void setup(int vflag) override {
    with_ellipsoids([&] { Base::setup(vflag); });
  }
  void initial_integrate(int vflag) override {
    if (forces_.is_restored) {
      for (int i = 0; i < this->atom->nlocal; ++i) {
        if (is_member(i)) forces_.put_back(*this->atom, i);
      }
      this->compute_forces_and_torques();
      forces_.is_restored = false;
    }
    with_ellipsoids([&] { Base::initial_integrate(vflag); });
  }
  void final_integrate() override {
    with_ellipsoids([&] { Base::final_integrate(); });
    for (int i = 0; i < this->atom->nlocal; ++i) {
      if (is_member(i)) forces_.store(*this->atom, i);
    }
  }
  void zero_momentum() override {
    with_ellipsoids([&] { Base::zero_momentum(); });
  }
  void zero_rotation() override {
    with_ellipsoids([&] { Base::zero_rotation(); });
  }

  void grow_arrays(int count) override {
    Base::grow_arrays(count);
    forces_.grow(count);
  }
  void copy_arrays(int from, int to, int deleted) override {
    Base::copy_arrays(from, to, deleted);
    forces_.copy(from, to);
  }
  void set_arrays(int i) override {
    Base::set_arrays(i);
    forces_.forget(i);
  }
  int pack_exchange(int i, double* buffer) override {
    const int size = Base::pack_exchange(i, buffer);
    return size + forces_.pack(i, buffer + size);
  }
  int unpack_exchange(int i, double* buffer) override {
    const int size = Base::unpack_exchange(i, buffer);
    return size + forces_.unpack(i, buffer + size);
  }
  int pack_restart(int i, double* buffer) override { return forces_.pack_restart(i, buffer); }
  void unpack_restart(int i, int set) override { forces_.unpack_restart(*this->atom, i, set); }
  int size_restart(int /*i*/) override { return StoredForces::kRestartSize; }
  int maxsize_restart() override { return StoredForces::kRestartSize; }

  Cluster cluster(int i) const override {
    if constexpr (std::derived_from<Base, LAMMPS_NS::FixRigidSmall>) {
      if (this->atom2body[i] < 0) return {};
      const auto& found = this->body[this->atom2body[i]];
      return cluster_of(static_cast<double>(this->bodytag[i]), found.mass, found.inertia, i);
    } else {
      const int found = this->body[i];
      if (found < 0) return {};
      return cluster_of(found + 1, this->masstotal[found], this->inertia[found], i);
    }
  }

 private:
  // LAMMPS finds the clusters of rigid/small by the tag of one of their particles. After delete_atoms, particles may have other
  // tags.
  void refuse_new_tags() {
    if constexpr (std::derived_from<Base, LAMMPS_NS::FixRigidSmall>) {
      for (int i = 0; i < this->atom->nlocal; ++i) {
        if (this->bodyown[i] < 0 || this->bodytag[i] == this->atom->tag[i]) continue;
        this->error->one(FLERR,
                         fmt::format("fix {}: the particle with tag {} had tag {} when the fix was created; use delete_atoms with "
                                     "compress no, or create the fix anew",
                                     this->style, this->atom->tag[i], this->bodytag[i]));
      }
    }
  }

  Cluster cluster_of(double number, double mass, const double* moments, int i) const {
    const double* q = this->orient[i];  // of the particle, in the frame of the cluster
    const Matrix3 to_particle = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).conjugate().toRotationMatrix();
    return {number, 1 / mass, to_particle * Vector3::Map(this->displace[i]),
            to_particle * Vector3::Map(moments).cwiseInverse().asDiagonal() * to_particle.transpose()};
  }

  template <typename Work>
  void with_ellipsoids(Work work) {
    const int count = this->atom->nlocal;
    own_.clear();
    for (int i = 0; i < count; ++i) {
      if (!is_member(i)) continue;
      Eigen::Map<Vector3> half_axes(bodies_->half_axes(i));
      const Vector3 ellipsoid = bodies_->find_shape(i).equal_ellipsoid();
      own_.emplace_back(half_axes);
      half_axes = ellipsoid;
    }
    work();
    auto own = own_.begin();
    for (int i = 0; i < count; ++i) {
      if (is_member(i)) Vector3::Map(bodies_->half_axes(i)) = *own++;
    }
  }

  bool is_member(int i) const { return (this->atom->mask[i] & this->groupbit) != 0 && this->atom->ellipsoid[i] >= 0; }

  BodyTable* bodies_ = nullptr;
  std::vector<Vector3> own_;  // m; half-axes of the particles
  StoredForces forces_;
};

}  // namespace granular
