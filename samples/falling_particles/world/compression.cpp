#include "compression.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace falling_particles {
namespace {

constexpr double kRate = 0.2;        // largest strain in a step, relative to the target overlap
constexpr double kRestFrom = 0.8;    // fraction of the duration after which the target is constant and all velocities are removed
constexpr double kSamePlace = 1e-3;  // of the grain's radius; another meeting of the same grains is a cell away

using Grains = std::pair<const Grain*, const Grain*>;

/// A place in the cell where two grains meet, with one contact point or several: of a face, of components of compounds, or on both
/// sides of the boundary of the cell.
struct Meeting {
  std::array<double, 3> between;  ///< m, from the centre of the second grain to the centre of the first
  double overlap;                 ///< relative, largest over its points
};

/// Adds a contact point to the meeting of the same place, or to a new one. All meetings are of the same two grains.
void add(const dContactGeom& contact, std::vector<Meeting>& meetings) {
  const double sign = grain_of(contact.g1) < grain_of(contact.g2) ? 1 : -1;
  const dReal* p1 = dBodyGetPosition(dGeomGetBody(contact.g1));  // the centre of a compound, not of its component
  const dReal* p2 = dBodyGetPosition(dGeomGetBody(contact.g2));
  std::array<double, 3> between{};
  double along = 0;  // distance of the centres along the normal, which points into g1
  for (std::size_t i = 0; i < 3; ++i) {
    between.at(i) = sign * (p1[i] - p2[i]);
    along += (p1[i] - p2[i]) * contact.normal[i];
  }
  // If compounds interlock, the normal may point the other way. Then shrinking would not separate them.
  if (!(along > 0)) along = dCalcPointsDistance3(p1, p2);
  const double overlap = contact.depth / (along + contact.depth);
  const double near = kSamePlace * grain_of(contact.g1)->bounding_radius();
  const auto is_here = [&](const Meeting& meeting) {
    return std::hypot(meeting.between[0] - between[0], meeting.between[1] - between[1], meeting.between[2] - between[2]) < near;
  };
  const auto here = std::ranges::find_if(meetings, is_here);
  if (here == meetings.end()) {
    meetings.push_back({between, overlap});
  } else {
    here->overlap = std::max(here->overlap, overlap);
  }
}

}  // namespace

MeanOverlap measure_mean_overlap(std::span<const dContactGeom> contacts) {
  MeanOverlap mean;
  std::vector<Meeting> meetings;
  const auto count = [&] {
    for (const Meeting& meeting : meetings) mean.relative += meeting.overlap;
    mean.contacts += meetings.size();
    meetings.clear();
  };
  Grains last{};
  for (const dContactGeom& contact : contacts) {
    if (!(contact.depth > 0)) continue;
    const Grains grains = std::minmax(grain_of(contact.g1), grain_of(contact.g2));
    if (grains != last) count();
    last = grains;
    add(contact, meetings);
  }
  count();
  if (mean.contacts > 0) mean.relative /= static_cast<double>(mean.contacts);
  return mean;
}

Compressor::Compressor(const World& world, PeriodicCell& cell, const Compression& compression, double duration)
    : world_(world), cell_(cell), compression_(compression), duration_(duration), packing_{} {
  for (const Grain& grain : world.present()) grain_volume_ += grain.volume();
}

void Compressor::after_step(double time, std::span<const dContactGeom> contacts) {
  const MeanOverlap overlap = measure_mean_overlap(contacts);
  const auto grains = static_cast<double>(world_.grains().size());
  const double side = cell_.side();
  const double fraction = grain_volume_ / (side * side * side);
  const double progress = std::min(1.0, time / (kRestFrom * duration_));
  const double target = compression_.overlap * std::pow(compression_.final_overlap / compression_.overlap, progress);
  packing_ = {side,    fraction, fraction * std::pow(1 - overlap.relative, 3),
              overlap, target,   2 * static_cast<double>(overlap.contacts) / grains};

  const double kept = progress < 1 ? 1 - compression_.damping : 0;
  for (const Grain& grain : world_.present()) {
    const dReal* v = dBodyGetLinearVel(grain.body);
    const dReal* w = dBodyGetAngularVel(grain.body);
    dBodySetLinearVel(grain.body, kept * v[0], kept * v[1], kept * v[2]);
    dBodySetAngularVel(grain.body, kept * w[0], kept * w[1], kept * w[2]);
  }
  // A few overlapping grains among many are no pressure. So the mean is taken over at least one contact per grain.
  const double share = std::min(1.0, static_cast<double>(overlap.contacts) / grains);
  const double strain = kRate * target * std::clamp(1 - overlap.relative * share / target, -1.0, 1.0);
  cell_.scale(1 - strain);
}

}  // namespace falling_particles
