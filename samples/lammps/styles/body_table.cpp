#include "styles/body_table.hpp"

#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <string>

#include "atom.h"
#include "atom_vec_ellipsoid.h"
#include "error.h"

namespace granular {

using namespace LAMMPS_NS;

BodyTable::BodyTable(LAMMPS* lammps, int types)
    : lammps_(lammps),
      ellipsoids_(dynamic_cast<AtomVecEllipsoid*>(lammps->atom->style_match("ellipsoid"))),
      exponents_(static_cast<std::size_t>(types) + 1),
      largest_radii_(static_cast<std::size_t>(types) + 1) {
  if (ellipsoids_ == nullptr) lammps->error->all(FLERR, "supernormal takes atom_style ellipsoid");
}

double* BodyTable::quaternion(int i) const { return ellipsoids_->bonus[lammps_->atom->ellipsoid[i]].quat; }

double* BodyTable::half_axes(int i) const { return ellipsoids_->bonus[lammps_->atom->ellipsoid[i]].shape; }

void BodyTable::use_particle_exponents() {
  const auto find = [&](const char* name) {
    int is_double = 0, columns = 0;
    const int index = lammps_->atom->find_custom(name, is_double, columns);
    if (index < 0 || is_double == 0 || columns != 0) {
      lammps_->error->all(FLERR,
                          std::string("pair_style supernormal: exponents atom takes d_delta and d_epsilon of fix property/atom; "
                                      "there is no d_") +
                              name);
    }
    return index;
  };
  delta_ = find("delta");
  epsilon_ = find("epsilon");
}

double& BodyTable::delta(int i) const { return lammps_->atom->dvector[delta_][i]; }
double& BodyTable::epsilon(int i) const { return lammps_->atom->dvector[epsilon_][i]; }

const ParticleShape& BodyTable::find_shape(int i) {
  const Atom& atom = *lammps_->atom;
  const std::string name = "supernormal: atom " + std::to_string(atom.tag[i]);
  if (atom.ellipsoid[i] < 0) lammps_->error->one(FLERR, name + " is a point: set its shape");
  const Exponents exponents = delta_ < 0 ? exponents_[static_cast<std::size_t>(atom.type[i])] : Exponents{delta(i), epsilon(i)};
  try {
    const double* const axes = half_axes(i);
    const std::array key{axes[0], axes[1], axes[2], exponents.delta, exponents.epsilon};
    return cache_.try_emplace(key, Vector3::Map(axes), exponents.delta, exponents.epsilon).first->second;
  } catch (const std::invalid_argument& refusal) {
    lammps_->error->one(FLERR, name + ": " + refusal.what());
    throw;  // not reached: LAMMPS ends the program or throws
  }
}

const std::vector<double>& BodyTable::find_largest_radii() {
  const Atom& atom = *lammps_->atom;
  cache_.clear();
  shapes_.clear();
  std::vector<double> own(largest_radii_.size());
  for (int i = 0; i < atom.nlocal; ++i) {
    double& largest = own[static_cast<std::size_t>(atom.type[i])];
    largest = std::max(largest, find_shape(i).bounding_radius);
  }
  MPI_Allreduce(own.data(), largest_radii_.data(), static_cast<int>(own.size()), MPI_DOUBLE, MPI_MAX, lammps_->world);
  return largest_radii_;
}

void BodyTable::assign_shapes() {
  const Atom& atom = *lammps_->atom;
  const auto count = static_cast<std::size_t>(atom.nlocal) + static_cast<std::size_t>(atom.nghost);
  // Otherwise shapes of deleted particles would accumulate.
  if (cache_.size() > 2 * count + 100) cache_.clear();
  shapes_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    shapes_[i] = &find_shape(static_cast<int>(i));
    if (shapes_[i]->bounding_radius > largest_radii_[static_cast<std::size_t>(atom.type[i])]) {
      lammps_->error->one(FLERR, "supernormal: atom " + std::to_string(atom.tag[i]) +
                                     " is larger than those of its type were when the run started; start a new run");
    }
  }
  bodies_.resize(count);
  turns_.assign(count, {});
}

void BodyTable::read_motion() {
  const Atom& atom = *lammps_->atom;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const ParticleShape& shape = *shapes_[i];
    const double* q = ellipsoids_->bonus[atom.ellipsoid[i]].quat;
    // The chord between unit quaternions is 2 sin(angle/4), and the angle is at most pi.
    Turn& turn = turns_[i];
    const Eigen::Vector4d now(q[0], q[1], q[2], q[3]);
    turn.way += std::numbers::pi / std::numbers::sqrt2 * shape.bounding_radius * (now - turn.quaternion).norm();
    turn.quaternion = now;
    Body& body = bodies_[i];
    body.shape = &shape.body;
    body.width = shape.width;
    body.faces = shape.faces;
    body.sides = shape.sides;
    body.bulge = shape.bulge;
    body.pose.position = Vector3::Map(atom.x[i]);
    body.pose.rotation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
    body.velocity = Vector3::Map(atom.v[i]);
    body.inverse_mass = 1 / atom.rmass[i];
    const Vector3 inverse = (atom.rmass[i] * shape.unit_inertia).cwiseInverse();
    body.inverse_inertia = body.pose.rotation * inverse.asDiagonal() * body.pose.rotation.transpose();
    body.angular_velocity = body.inverse_inertia * Vector3::Map(atom.angmom[i]);
    body.from_centre.setZero();
    if (!clusters_.empty() && !clusters_[i].is_none()) clusters_[i].apply(body);
  }
}

}  // namespace granular
