#include "kernel/slider.hpp"

namespace granular {

SliderForce slide(const Vector3& spring, const Vector3& rate, double stiffness, double damping, double limit) {
  const Vector3 force = -(stiffness * spring + damping * rate);
  const double size = force.norm();
  if (size <= limit) return {force, spring, false};
  const Vector3 cut = (limit / size) * force;
  return {cut, -(cut + damping * rate) / stiffness, true};
}

}  // namespace granular
