#include "periodic_cell.hpp"

#include <supernormal/supernormal.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "world.hpp"

namespace falling_particles {
namespace {

bool is_part_of(unsigned mask, unsigned whole) { return (mask & ~whole) == 0; }

/// Makes the velocities of the centres equal by three rows: a ball joint whose anchors are the two centres, wherever they are. With
/// ERP 0 it does not pull them together. (ODE's linear motor would give the bodies lever arms to their midpoint.)
dJointID tie_velocities(dWorldID world, dBodyID body, dBodyID image) {
  dJointID ball = dJointCreateBall(world, nullptr);
  dJointAttach(ball, body, image);
  const dReal* centre = dBodyGetPosition(body);
  dJointSetBallAnchor(ball, centre[0], centre[1], centre[2]);
  dJointSetBallAnchor2(ball, 0, 0, 0);  // in the image's own frame
  dJointSetBallParam(ball, dParamERP, 0);
  dJointSetBallParam(ball, dParamCFM, 0);
  return ball;
}

/// Makes the angular velocities equal by three rows.
dJointID tie_spins(dWorldID world, dBodyID body, dBodyID image) {
  constexpr int kGlobal = 0;
  dJointID motor = dJointCreateAMotor(world, nullptr);
  dJointAttach(motor, body, image);
  dJointSetAMotorMode(motor, dAMotorUser);
  dJointSetAMotorNumAxes(motor, 3);
  dJointSetAMotorAxis(motor, 0, kGlobal, 1, 0, 0);
  dJointSetAMotorAxis(motor, 1, kGlobal, 0, 1, 0);
  dJointSetAMotorAxis(motor, 2, kGlobal, 0, 0, 1);
  for (const int force : {dParamFMax1, dParamFMax2, dParamFMax3}) dJointSetAMotorParam(motor, force, dInfinity);
  return motor;
}

void set_motion(dBodyID to, dBodyID from) {
  const dReal* v = dBodyGetLinearVel(from);
  const dReal* w = dBodyGetAngularVel(from);
  dBodySetLinearVel(to, v[0], v[1], v[2]);
  dBodySetAngularVel(to, w[0], w[1], w[2]);
}

void for_each_geom(dBodyID body, void (*visit)(dGeomID)) {
  for (dGeomID geom = dBodyGetFirstGeom(body), next = nullptr; geom != nullptr; geom = next) {
    next = dBodyGetNextGeom(geom);
    visit(geom);
  }
}

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

PeriodicCell::PeriodicCell(const World& world, const PeriodicAxes& axes)
    : world_(world), axes_(axes), families_(world.grains().size()) {}

PeriodicCell::~PeriodicCell() {
  for (Family& family : families_) destroy(family);
}

void PeriodicCell::destroy(Family& family) {
  for (const std::optional<Image>& image : family.images) {
    if (!image) continue;
    dJointDestroy(image->same_velocity);
    dJointDestroy(image->same_spin);
    for_each_geom(image->body, dGeomDestroy);
    dBodyDestroy(image->body);
  }
  family = {};
}

void PeriodicCell::remove(std::size_t index) { destroy(families_[index]); }

bool PeriodicCell::contains(const dVector3 point) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (axes_[axis] && !(point[axis] >= axes_[axis]->lower && point[axis] < axes_[axis]->upper())) return false;
  }
  return true;
}

double PeriodicCell::shift_along(unsigned mask, std::size_t axis) const {
  return ((mask >> axis) & 1U) != 0 ? axes_[axis]->length : 0;
}

PeriodicCell::Image PeriodicCell::make_image(const Grain& grain) const {
  Image image{dBodyCreate(world_.id()), nullptr, nullptr};
  attach_geoms(world_.sweep().id(), *grain.kind, grain.scale, image.body, dGeomGetData(grain.geom));
  if (world_.scene().looks_ahead()) {
    for (dGeomID geom = dBodyGetFirstGeom(image.body); geom != nullptr; geom = dBodyGetNextGeom(geom)) {
      snGeomSetLookAhead(geom, world_.scene().time.step);
    }
  }
  image.same_velocity = tie_velocities(world_.id(), grain.body, image.body);
  image.same_spin = tie_spins(world_.id(), grain.body, image.body);
  return image;
}

void PeriodicCell::show(const Grain& grain, Family& family, unsigned mask) {
  std::optional<Image>& image = family.images[mask];
  if (!image) image = make_image(grain);
  if (dBodyIsEnabled(image->body) == 0) {
    dBodyEnable(image->body);
    for_each_geom(image->body, dGeomEnable);
    dJointEnable(image->same_velocity);
    dJointEnable(image->same_spin);
  }
  const dReal* p = dBodyGetPosition(grain.body);
  dBodySetPosition(image->body, p[0] - shift_along(mask, 0), p[1] - shift_along(mask, 1), p[2] - shift_along(mask, 2));
  dBodySetQuaternion(image->body, dBodyGetQuaternion(grain.body));
  set_motion(image->body, grain.body);
}

void PeriodicCell::hide(const Image& image) {
  dBodyDisable(image.body);
  for_each_geom(image.body, dGeomDisable);
  dJointDisable(image.same_velocity);
  dJointDisable(image.same_spin);
}

void PeriodicCell::share_mass(const Grain& grain, Family& family, unsigned size) {
  dMass share = grain.mass;
  dMassAdjust(&share, grain.mass.mass / size);
  dBodySetMass(grain.body, &share);
  for (const std::optional<Image>& image : family.images) {
    if (image) dBodySetMass(image->body, &share);
  }
  family.size = size;
}

void PeriodicCell::place_images() {
  for (const Grain& grain : world_.present()) {
    const Aabb aabb = grain.aabb();
    const dReal* p = dBodyGetPosition(grain.body);
    unsigned sticks_out = 0;
    dReal inside[3] = {p[0], p[1], p[2]};  // position with the lower corner of the bounding box in the cell
    for (unsigned axis = 0; axis < 3; ++axis) {
      if (!axes_[axis]) continue;
      const Period& period = *axes_[axis];
      const double shift = period.length * std::floor((aabb[2 * axis] - period.lower) / period.length);
      inside[axis] = p[axis] - shift;
      const double width = aabb[2 * axis + 1] - aabb[2 * axis];
      if (2 * width > period.length) {
        throw std::runtime_error("the periodic cell is " + std::to_string(period.length) +
                                 " m long; needed: twice the width of grain \"" + grain.kind->name + "\"" +
                                 (world_.scene().looks_ahead() ? " with its way in a step, " + std::to_string(width) + " m" : ""));
      }
      if (aabb[2 * axis + 1] - shift > period.upper()) sticks_out |= 1U << axis;
    }
    dBodySetPosition(grain.body, inside[0], inside[1], inside[2]);
    Family& family = families_[world_.index_of(grain)];
    family.placed = {inside[0], inside[1], inside[2]};
    const bool changed = sticks_out != family.shown;
    family.shown = sticks_out;
    for (unsigned mask = 1; mask < kMasks; ++mask) {
      if (is_part_of(mask, sticks_out)) {
        show(grain, family, mask);
      } else if (changed && family.images[mask]) {
        hide(*family.images[mask]);
      }
    }
    if (changed) share_mass(grain, family, 1U << static_cast<unsigned>(std::popcount(sticks_out)));
  }
}

void PeriodicCell::share_ways() {
  for (const Grain& each : world_.present()) {
    const Family& family = families_[world_.index_of(each)];
    if (family.size == 1) continue;
    const auto place = [&](unsigned mask, std::size_t axis) { return family.placed[axis] - shift_along(mask, axis); };
    const auto body_of_mask = [&](unsigned mask) { return mask == 0 ? each.body : family.images[mask]->body; };
    Point way{};
    for (unsigned mask = 0; mask < kMasks; ++mask) {
      if (!is_part_of(mask, family.shown)) continue;
      const dReal* p = dBodyGetPosition(body_of_mask(mask));
      for (std::size_t axis = 0; axis < 3; ++axis) way[axis] += p[axis] - place(mask, axis);
    }
    if (way == Point{}) continue;
    for (unsigned mask = 0; mask < kMasks; ++mask) {
      if (!is_part_of(mask, family.shown)) continue;
      dBodySetPosition(body_of_mask(mask), place(mask, 0) + way[0], place(mask, 1) + way[1], place(mask, 2) + way[2]);
    }
  }
}

void PeriodicCell::gather() {
  for (const Grain& each : world_.present()) {
    const Family& family = families_[world_.index_of(each)];
    if (family.size == 1) continue;
    dBodyID grain = each.body;
    std::array<double, 3> position{};
    std::array<double, 3> velocity{};
    std::array<double, 3> spin{};
    dQuaternion orientation{};
    for (unsigned mask = 0; mask < kMasks; ++mask) {
      if (!is_part_of(mask, family.shown)) continue;
      dBodyID body = mask == 0 ? grain : family.images[mask]->body;
      for (unsigned axis = 0; axis < 3; ++axis) {
        position[axis] += (dBodyGetPosition(body)[axis] + shift_along(mask, axis)) / family.size;
        velocity[axis] += dBodyGetLinearVel(body)[axis] / family.size;
        spin[axis] += dBodyGetAngularVel(body)[axis] / family.size;
      }
      for (unsigned k = 0; k < 4; ++k) orientation[k] += dBodyGetQuaternion(body)[k];
    }
    dBodySetPosition(grain, position[0], position[1], position[2]);
    dBodySetLinearVel(grain, velocity[0], velocity[1], velocity[2]);
    dBodySetAngularVel(grain, spin[0], spin[1], spin[2]);
    dBodySetQuaternion(grain, orientation);  // ODE normalizes the quaternion
  }
}

Point PeriodicCell::lengths() const {
  Point lengths{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (axes_[axis]) lengths[axis] = axes_[axis]->length;
  }
  return lengths;
}

void PeriodicCell::set_lengths(const Point& lengths) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (axes_[axis]) axes_[axis]->length = lengths[axis];
  }
}

void PeriodicCell::scale(double factor) {
  for (std::optional<Period>& period : axes_) period->length *= factor;
  for (const Grain& grain : world_.present()) {
    const dReal* p = dBodyGetPosition(grain.body);
    dBodySetPosition(grain.body, factor * p[0], factor * p[1], factor * p[2]);
  }
}

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
