#include "compression.hpp"

#include <algorithm>
#include <cmath>

namespace falling_particles {
namespace {

constexpr double kRate = 0.2;      // largest strain of a step, relative to the target overlap
constexpr double kRestFrom = 0.8;  // share of the duration after which the target stays, and nothing has inertia

}  // namespace

MeanOverlap measure_mean_overlap(std::span<const dContactGeom> contacts) {
  double sum = 0;
  std::size_t count = 0;
  for (const dContactGeom& contact : contacts) {
    if (!(contact.depth > 0)) continue;                            // a corner of a wide contact
    const dReal* p1 = dBodyGetPosition(dGeomGetBody(contact.g1));  // of a compound, not of the part
    const dReal* p2 = dBodyGetPosition(dGeomGetBody(contact.g2));
    double between = 0;  // distance of the centres along the normal, which points into g1
    for (int i = 0; i < 3; ++i) between += (p1[i] - p2[i]) * contact.normal[i];
    // Where compounds are hooked into one another the normal may point the other way, and shrinking would not part them.
    if (!(between > 0)) between = dCalcPointsDistance3(p1, p2);
    sum += contact.depth / (between + contact.depth);
    ++count;
  }
  return {count == 0 ? 0 : sum / static_cast<double>(count), count};
}

Compressor::Compressor(const World& world, PeriodicCell& cell, const Compression& compression, double duration)
    : world_(world), cell_(cell), compression_(compression), duration_(duration), packing_{} {
  for (const Body& body : world.present()) grain_volume_ += body.volume();
}

void Compressor::after_step(double time, std::span<const dContactGeom> contacts) {
  const MeanOverlap overlap = measure_mean_overlap(contacts);
  const auto bodies = static_cast<double>(world_.bodies().size());
  const double side = cell_.side();
  const double fraction = grain_volume_ / (side * side * side);
  const double progress = std::min(1.0, time / (kRestFrom * duration_));
  const double target = compression_.overlap * std::pow(compression_.final_overlap / compression_.overlap, progress);
  packing_ = {side,    fraction, fraction * std::pow(1 - overlap.relative, 3),
              overlap, target,   2 * static_cast<double>(overlap.contacts) / bodies};

  const double kept = progress < 1 ? 1 - compression_.damping : 0;
  for (const Body& body : world_.present()) {
    const dReal* v = dBodyGetLinearVel(body.body);
    const dReal* w = dBodyGetAngularVel(body.body);
    dBodySetLinearVel(body.body, kept * v[0], kept * v[1], kept * v[2]);
    dBodySetAngularVel(body.body, kept * w[0], kept * w[1], kept * w[2]);
  }
  // A few grains that overlap among many that do not are no pressure: the mean is taken as if there were a contact for each grain
  // at least.
  const double share = std::min(1.0, static_cast<double>(overlap.contacts) / bodies);
  const double strain = kRate * target * std::clamp(1 - overlap.relative * share / target, -1.0, 1.0);
  cell_.scale(1 - strain);
}

}  // namespace falling_particles
