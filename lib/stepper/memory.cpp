#include "stepper/memory.hpp"

#include <algorithm>
#include <functional>
#include <limits>

namespace supernormal::stepper {

// Contacts that a program makes without geoms are those of the two bodies.
Memory::Key Memory::key_of(dGeomID geom1, const Body& body1, dGeomID geom2, const Body& body2) {
  const void* const one = geom1 != nullptr ? static_cast<const void*>(geom1) : body1.id;
  const void* const two = geom2 != nullptr ? static_cast<const void*>(geom2) : body2.id;
  const bool is_swapped = std::less<>()(two, one);
  return {is_swapped ? two : one, is_swapped ? one : two, is_swapped};
}

bool Memory::is_before(const Key& a, const Key& b) {
  const std::less<> is_less;
  return is_less(a.low, b.low) || (a.low == b.low && is_less(a.high, b.high));
}

std::span<Memory::Force> Memory::forces_of(const Key& key) {
  return {std::ranges::lower_bound(forces_, key, is_before, &Force::key),
          std::ranges::upper_bound(forces_, key, is_before, &Force::key)};
}

void Memory::leave(dGeomID geom1, const Body& body1, dGeomID geom2, const Body& body2) {
  for (Force& force : forces_of(key_of(geom1, body1, geom2, body2))) force.is_left = true;
}

void Memory::forget(dBodyID body) {
  std::erase_if(forces_, [body](const Force& force) { return force.body1 == body || force.body2 == body; });
}

void Memory::recall(System& system, double time) {
  for (const Pair& pair : system.pairs) recall_pair(system, pair, time);
}

void Memory::recall_pair(System& system, const Pair& pair, double time) {
  const Contact& of = system.contact(pair.first);
  const Key key = key_of(of.geom1, system.body1(of), of.geom2, system.body2(of));
  const std::span<Force> known = forces_of(key);
  for (int k = 0; k < pair.count; ++k) {
    Contact& contact = system.contact(pair.first + k);
    const bool by_first = system.body1(contact).is_dynamic();
    Force* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (Force& force : known) {
      if (force.is_taken) continue;
      const Vector3& place = by_first == key.is_swapped ? force.place_high : force.place_low;
      const double distance = (place - (by_first ? contact.place1 : contact.place2)).squaredNorm();
      if (distance >= least) continue;
      least = distance;
      nearest = &force;
    }
    if (nearest == nullptr) return;
    nearest->is_taken = true;
    const double sign = key.is_swapped ? -1 : 1;
    contact.rows[0].impulse = time * nearest->normal;
    for (std::size_t i = 1; i < 3; ++i) contact.rows[i].impulse = sign * time * nearest->tangential.dot(contact.rows[i].direction);
    if (Rolling* const torques = system.rolling_of(contact)) {
      for (Row& row : *torques) row.impulse = sign * time * nearest->torque.dot(row.lever1);
    }
    if (!contact.moves || known.size() > 1) continue;
    for (Row& row : contact.rows) row.centring = sign * nearest->centring.dot(row.direction);
  }
}

void Memory::keep(System& system, double time) {
  std::erase_if(forces_, [](const Force& force) { return !force.is_left || force.is_taken; });
  for (Force& force : forces_) force.is_left = false;
  for (const Contact& contact : system.contacts) {
    Force& force = forces_.emplace_back();
    force.key = key_of(contact.geom1, system.body1(contact), contact.geom2, system.body2(contact));
    force.body1 = system.body1(contact).id;
    force.body2 = system.body2(contact).id;
    force.order = static_cast<int>(forces_.size());
    const bool swapped = force.key.is_swapped;
    force.place_low = swapped ? contact.place2 : contact.place1;
    force.place_high = swapped ? contact.place1 : contact.place2;
    const double sign = swapped ? -1 : 1;
    const auto& rows = contact.rows;
    force.normal = rows[0].impulse / time;
    force.tangential = sign / time * (rows[1].impulse * rows[1].direction + rows[2].impulse * rows[2].direction);
    force.torque.setZero();
    if (const Rolling* const torques = system.rolling_of(contact)) {
      for (const Row& row : *torques) force.torque += sign / time * row.impulse * row.lever1;
    }
    force.centring =
        sign * (rows[0].centring * rows[0].direction + rows[1].centring * rows[1].direction + rows[2].centring * rows[2].direction);
  }
  // By the order among themselves, or the addresses would decide between two contacts at one place.
  std::ranges::sort(forces_, [](const Force& a, const Force& b) {
    return is_before(a.key, b.key) || (!is_before(b.key, a.key) && a.order < b.order);
  });
}

}  // namespace supernormal::stepper
