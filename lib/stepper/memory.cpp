#include "stepper/memory.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <unordered_map>
#include <utility>

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
  next_.clear();
  for (const Pair& pair : system.pairs) recall_pair(system, pair, time);
}

void Memory::recall_pair(System& system, const Pair& pair, double time) {
  const Contact& of = system.contacts_of(pair).front();
  const Body& one = system.body1(of);
  const Body& two = system.body2(of);
  const Key key = key_of(of.given->contact.geom.g1, one, of.given->contact.geom.g2, two);
  const double sign = key.is_swapped ? -1 : 1;
  const bool by_low = one.is_dynamic() != key.is_swapped;
  const std::span<Force> known = forces_of(key);
  for (Contact& contact : system.contacts_of(pair)) {
    Force& force = next_.emplace_back();
    force.key = key;
    force.body1 = one.id;
    force.body2 = two.id;
    force.order = static_cast<int>(next_.size());
    force.place_low = one.rotation.transpose() * contact.arm1;
    force.place_high = two.rotation.transpose() * contact.arm2;
    if (key.is_swapped) force.place_low.swap(force.place_high);
    Force* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (Force& last : known) {
      const double distance =
          by_low ? (last.place_low - force.place_low).squaredNorm() : (last.place_high - force.place_high).squaredNorm();
      if (last.is_taken || distance >= least) continue;
      least = distance;
      nearest = &last;
    }
    if (nearest == nullptr) continue;
    nearest->is_taken = true;
    force.normal = nearest->normal;
    force.tangential = nearest->tangential;
    force.torque = nearest->torque;
    contact.rows[0].impulse = time * force.normal;
    for (std::size_t i = 1; i < 3; ++i) contact.rows[i].impulse = sign * time * force.tangential.dot(contact.rows[i].direction);
    if (Rolling* const torques = system.rolling_of(contact)) {
      for (Row& row : *torques) row.impulse = sign * time * force.torque.dot(row.direction);
    }
    if (contact.moving >= 0 && known.size() == 1) system.centring[std::size_t(contact.moving)] = sign * nearest->centring;
  }
}

void Memory::keep(System& system, double time, double part) {
  for (std::size_t i = 0; i < next_.size(); ++i) {
    const Contact& contact = system.contacts[i];
    Force& force = next_[i];
    const double sign = force.key.is_swapped ? -1 : 1;
    const auto& [normal, first, second] = contact.rows;
    Vector3 torque = Vector3::Zero();
    if (const Rolling* const torques = system.rolling_of(contact)) {
      for (const Row& row : *torques) torque += row.impulse * row.direction;
    }
    force.normal += part * (normal.impulse / time - force.normal);
    force.tangential +=
        part * (sign / time * (first.impulse * first.direction + second.impulse * second.direction) - force.tangential);
    force.torque += part * (sign / time * torque - force.torque);
    if (contact.moving >= 0) force.centring = sign * system.centring[std::size_t(contact.moving)];
  }
  for (Force& force : forces_) {
    if (!force.is_left || force.is_taken) continue;
    force.is_left = false;
    next_.push_back(force);
  }
  forces_.swap(next_);
  sort();
}

void Memory::sort() {
  // By the order among themselves, or the addresses would decide between two contacts at one place.
  std::ranges::sort(forces_, [](const Force& a, const Force& b) {
    return is_before(a.key, b.key) || (!is_before(b.key, a.key) && a.order < b.order);
  });
}

namespace {

constexpr std::size_t kGeoms = 2;
constexpr std::size_t kVectors = 5;
constexpr std::size_t kNumbers = kGeoms + 1 + 3 * kVectors;  // of a force

}  // namespace

void Memory::save(std::span<const dGeomID> geoms, std::vector<double>& numbers) const {
  std::unordered_map<const void*, int> places;
  for (std::size_t i = 0; i < geoms.size(); ++i) places[geoms[i]] = static_cast<int>(i);
  std::vector<std::pair<std::array<int, 3>, Force>> forces;  // by what no address decides
  for (const Force& force : forces_) {
    const auto low = places.find(force.key.low);
    const auto high = places.find(force.key.high);
    if (low == places.end() || high == places.end()) continue;
    auto& [rank, saved] = forces.emplace_back(std::array{force.order, low->second, high->second}, force);
    if (rank[1] <= rank[2]) continue;
    std::swap(rank[1], rank[2]);
    saved.swap_sides();
  }
  std::ranges::sort(forces, {}, &std::pair<std::array<int, 3>, Force>::first);
  for (const auto& [rank, force] : forces) {
    numbers.insert(numbers.end(), {double(rank[1]), double(rank[2]), force.normal});
    for (const Vector3& vector : {force.place_low, force.place_high, force.tangential, force.torque, force.centring}) {
      for (const double x : vector) numbers.push_back(x + 0.0);  // the sign of a zero would tell which address is lower
    }
  }
}

bool Memory::load(std::span<const dGeomID> geoms, std::span<const double> numbers) {
  if (numbers.size() % kNumbers != 0) return false;
  std::vector<Force> loaded;
  for (; !numbers.empty(); numbers = numbers.subspan(kNumbers)) {
    const auto count = static_cast<double>(geoms.size());
    if (!(numbers[0] >= 0 && numbers[0] < count && numbers[1] >= 0 && numbers[1] < count)) return false;
    const dGeomID one = geoms[static_cast<std::size_t>(numbers[0])];
    const dGeomID two = geoms[static_cast<std::size_t>(numbers[1])];
    const auto vector = [&](std::size_t k) { return Vector3(numbers.data() + kGeoms + 1 + 3 * k); };
    Force& force = loaded.emplace_back();
    force.key = key_of(one, {}, two, {});
    force.body1 = dGeomGetBody(one);
    force.body2 = dGeomGetBody(two);
    force.order = static_cast<int>(loaded.size());
    force.normal = numbers[2];
    force.place_low = vector(0);
    force.place_high = vector(1);
    force.tangential = vector(2);
    force.torque = vector(3);
    force.centring = vector(4);
    if (force.key.is_swapped) force.swap_sides();
  }
  forces_.swap(loaded);
  sort();
  return true;
}

}  // namespace supernormal::stepper
