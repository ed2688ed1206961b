#include "styles/stored_forces.hpp"

#include <algorithm>
#include <cmath>

namespace granular {

int StoredForces::pack(int i, double* buffer) const {
  std::ranges::copy(at(i), buffer);
  return kSize;
}

int StoredForces::unpack(int i, const double* buffer) {
  std::copy_n(buffer, kSize, at(i).begin());
  return kSize;
}

// In a restart file, the first number of a fix is the count of its numbers.
int StoredForces::pack_restart(int i, double* buffer) const {
  buffer[0] = kRestartSize;
  return 1 + pack(i, buffer + 1);
}

void StoredForces::unpack_restart(const LAMMPS_NS::Atom& atom, int i, int set) {
  const double* numbers = atom.extra[i];
  for (int k = 0; k < set; ++k) numbers += static_cast<int>(*numbers);
  unpack(i, numbers + 1);
  is_restored = true;
}

void StoredForces::store(const LAMMPS_NS::Atom& atom, int i) {
  std::copy_n(atom.f[i], 3, at(i).begin());
  std::copy_n(atom.torque[i], 3, at(i).begin() + 3);
}

void StoredForces::put_back(LAMMPS_NS::Atom& atom, int i) const {
  if (std::isnan(at(i)[0])) return;
  std::copy_n(at(i).begin(), 3, atom.f[i]);
  std::copy_n(at(i).begin() + 3, 3, atom.torque[i]);
}

}  // namespace granular
