#include "ode/colliders/contact.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "ode/geom/convert.hpp"
#include "ode/runtime/statistics.hpp"

namespace supernormal::ode {
namespace {

// ODE's assertions abort on a normal that is not a unit vector or not a number, so every contact is checked here.
bool is_contact(const Proximity& proximity) {
  if (proximity.status == Status::Apart || proximity.status == Status::InvalidInput) return false;
  const bool overlap = proximity.gap <= 0 && std::isfinite(proximity.gap);
  const bool unit_normal = std::abs(proximity.normal.squaredNorm() - 1) < 1e-6;
  return overlap && unit_normal && proximity.contact.allFinite();
}

/// Writes one contact, which must satisfy is_contact(), after the `count` that are there, if there is room, and returns how many
/// are there now.
int append_contact(const Proximity& proximity, const ContactArray& out, int count, int side2) {
  if (count >= out.room()) return count;
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
    if (is_contact(contact)) count = append_contact(contact, out, count, side2);
  }
  return count;
}

/// Distributes the room for contacts: one for each manifold, and a fair share of the rest for its corners.
class Shares {
 public:
  Shares(std::size_t manifolds, int room) : left_(static_cast<int>(manifolds)), spare_(std::max(0, room - left_)) {}

  /// The room for the next manifold; if its wish is granted, all the room that a manifold may want.
  int next(const ContactManifold& manifold) {
    const int wanted = reduced_to(manifold, kAllTheRoom).corner_count;
    const int share = std::min(wanted, (spare_ + left_ - 1) / left_);
    spare_ -= share;
    --left_;
    return share == wanted ? kAllTheRoom : 1 + share;
  }

 private:
  static constexpr int kAllTheRoom = 1 + ContactManifold::kMaxCorners;

  int left_;
  int spare_;
};

bool lists_deepest(const ContactManifold& reduced, int room) { return reduced.corner_count == 0 || has_room_for_deepest(room); }

}  // namespace

int write_contacts(const ContactManifold& manifold, const ContactArray& out, int side2) {
  if (!is_contact(manifold.deepest)) return 0;
  if (manifold.corner_count == 0) return append_contact(manifold.deepest, out, 0, side2);
  const ContactManifold reduced = reduced_to(manifold, out.room());
  if (!lists_deepest(reduced, out.room())) return append_corners(reduced, 1, out, 0, side2);
  const int count = append_contact(manifold.deepest, out, 0, side2);
  return append_corners(reduced, manifold.flatness, out, count, side2);
}

int write_contacts(std::span<LocatedManifold> manifolds, const ContactArray& out) {
  if (manifolds.size() == 1) return write_contacts(manifolds.front().manifold, out, manifolds.front().side2);
  int count = 0;
  Shares shares(manifolds.size(), out.room());
  // The deepest point of each manifold comes first, so that the deepest of all is the first contact.
  for (LocatedManifold& located : manifolds) {
    ContactManifold& manifold = located.manifold;
    located.room = shares.next(manifold);
    manifold = reduced_to(manifold, located.room);
    if (!is_contact(manifold.deepest)) continue;
    if (lists_deepest(manifold, located.room)) {
      count = append_contact(manifold.deepest, out, count, located.side2);
    } else {
      count = append_corners(manifold, 1, out, count, located.side2);
    }
  }
  // The corners follow.
  for (const LocatedManifold& located : manifolds) {
    if (!lists_deepest(located.manifold, located.room) || !is_contact(located.manifold.deepest)) continue;
    count = append_corners(located.manifold, located.manifold.flatness, out, count, located.side2);
  }
  return count;
}

}  // namespace supernormal::ode
