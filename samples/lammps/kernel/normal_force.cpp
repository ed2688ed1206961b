#include "kernel/normal_force.hpp"

#include <algorithm>
#include <cmath>

#include "supernormal/contact/hertz.hpp"

namespace granular {

NormalForce hooke_force(const ContactMaterial& material, double depth) {
  const double force = material.stiffness * depth;
  return {force, material.stiffness, 0.5 * force * depth};
}

NormalForce hertz_force(const ContactMaterial& material, double depth, const supernormal::ContactCurvature& curvature,
                        double width) {
  const double punch = 2 * material.stiffness * width;  // N/m
  // An ellipse longer than a thousand times its width counts as a line contact.
  const double smaller = std::max(curvature.smaller, 1e-6 * curvature.larger);
  if (!(smaller > 0)) return {punch * depth, punch, 0.5 * punch * depth * depth};
  const double correction = supernormal::hertz_correction(curvature.larger / smaller);
  const double factor = 4.0 / 3 * material.stiffness / std::sqrt(std::sqrt(smaller * curvature.larger) * correction) / correction;
  const double force = factor * depth * std::sqrt(depth);
  if (force <= punch * depth) return {force, 1.5 * force / depth, 0.4 * force * depth};
  const double crossing = (punch / factor) * (punch / factor);  // m; up to this depth the force follows Hertz
  return {punch * depth, punch, 0.4 * punch * crossing * crossing + 0.5 * punch * (depth * depth - crossing * crossing)};
}

}  // namespace granular
