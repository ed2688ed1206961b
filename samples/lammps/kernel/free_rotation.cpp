#include "kernel/free_rotation.hpp"

namespace granular {

Eigen::Quaterniond rotate_freely(const Eigen::Quaterniond& orientation, const Eigen::Vector3d& angular_momentum,
                                 const Eigen::Vector3d& inertia, double step) {
  Eigen::Quaterniond q = orientation;
  Eigen::Vector3d momentum = q.conjugate() * angular_momentum;  // in the body's frame
  const auto turn = [&](int axis, double duration) {
    const Eigen::Quaterniond part(Eigen::AngleAxisd(duration * momentum[axis] / inertia[axis], Eigen::Vector3d::Unit(axis)));
    q = q * part;
    momentum = part.conjugate() * momentum;
  };
  turn(0, 0.5 * step);
  turn(1, 0.5 * step);
  turn(2, step);
  turn(1, 0.5 * step);
  turn(0, 0.5 * step);
  return q.normalized();
}

}  // namespace granular
