#include "ode/contact.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "ode/convert.hpp"
#include "ode/statistics.hpp"

namespace supernormal::ode {
namespace {

// ODE's assertions abort on a normal that is not a unit vector or not a number, so nothing gets past this on trust.
bool is_contact(const Proximity& proximity) {
  if (proximity.status == Status::Apart || proximity.status == Status::InvalidInput) return false;
  const bool overlap = proximity.gap <= 0 && std::isfinite(proximity.gap);
  const bool unit_normal = std::abs(proximity.normal.squaredNorm() - 1) < 1e-6;
  return overlap && unit_normal && proximity.contact.allFinite();
}

/// Writes one behind the `count` that are there, if there is room, and returns how many are there now.
int append_contact(const Proximity& proximity, const ContactArray& out, int count, int side2) {
  if (count >= out.room() || !is_contact(proximity)) return count;
  auto* const place = reinterpret_cast<char*>(out.first) + std::ptrdiff_t{count} * out.skip;
  dContactGeom& contact = *reinterpret_cast<dContactGeom*>(place);
  from_vector(proximity.contact, contact.pos);
  from_vector(-proximity.normal.normalized(), contact.normal);
  contact.depth = to_real(-proximity.gap);
  if (contact.depth == 0) contact.depth = 0;  // not -0
  contact.g1 = out.o1;
  contact.g2 = out.o2;
  contact.side1 = -1;
  contact.side2 = side2;
  count_contact();
  return count + 1;
}

int append_corners(const ContactManifold& manifold, double share_of_depth, const ContactArray& out, int count, int side2) {
  Proximity contact = manifold.deepest;
  for (int k = 0; k < manifold.corner_count; ++k) {
    const ManifoldCorner& corner = manifold.corners[static_cast<std::size_t>(k)];
    contact.gap = -share_of_depth * corner.depth;
    contact.contact = corner.point;
    count = append_contact(contact, out, count, side2);
  }
  return count;
}

// The corners take the place of the deepest point where there is room for no more than them, or fewer.
bool has_room_for_all(const ContactManifold& manifold, int room) { return room == 1 || manifold.corner_count < room; }

/// Shares out the room for contacts: one for each manifold, and of what is left a fair share for its corners.
class Shares {
 public:
  Shares(std::span<const LocatedManifold> manifolds, int room)
      : left_(static_cast<int>(manifolds.size())), spare_(std::max(0, room - left_)) {}

  /// Of the next one.
  int next(const ContactManifold& manifold) {
    const int share = std::min(manifold.corner_count, (spare_ + left_ - 1) / left_);
    spare_ -= share;
    --left_;
    return 1 + share;
  }

 private:
  int left_;
  int spare_;
};

}  // namespace

int write_contacts(const ContactManifold& manifold, const ContactArray& out) {
  const LocatedManifold located{manifold, -1};
  return write_contacts({&located, 1}, out);
}

int write_contacts(std::span<const LocatedManifold> manifolds, const ContactArray& out) {
  int count = 0;
  // First the deepest point of each, so that the deepest of all comes first.
  Shares shares(manifolds, out.room());
  for (const auto& [manifold, side2] : manifolds) {
    const int room = shares.next(manifold);
    if (has_room_for_all(manifold, room)) {
      count = append_contact(manifold.deepest, out, count, side2);
    } else if (is_contact(manifold.deepest)) {
      count = append_corners(reduced_to(manifold, room), 1, out, count, side2);
    }
  }
  // Then the corners of those that have room for all of theirs.
  shares = Shares(manifolds, out.room());
  for (const auto& [manifold, side2] : manifolds) {
    const int room = shares.next(manifold);
    if (room == 1 || !has_room_for_all(manifold, room) || !is_contact(manifold.deepest)) continue;
    count = append_corners(manifold, manifold.flatness, out, count, side2);
  }
  return count;
}

}  // namespace supernormal::ode
