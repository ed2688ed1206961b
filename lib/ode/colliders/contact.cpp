#include "ode/colliders/contact.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "ode/geom/convert.hpp"
#include "ode/runtime/statistics.hpp"

namespace supernormal::ode {
namespace {

// ODE's assertions abort on a normal that is not a unit vector or not a number, so every contact is checked here.
bool is_contact(const Proximity& proximity, double reach) {
  if (proximity.status == Status::Apart || proximity.status == Status::InvalidInput) return false;
  const bool is_within_reach = proximity.gap <= reach && std::isfinite(proximity.gap);
  const bool unit_normal = std::abs(proximity.normal.squaredNorm() - 1) < 1e-6;
  return is_within_reach && unit_normal && proximity.contact.allFinite();
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
  count_contact(proximity.status);
  return count + 1;
}

/// Writes the corners of a reduced manifold from number `first` on; the deepest point, number 0, if there are none.
int append_from(int first, const ContactManifold& manifold, const ContactArray& out, int count, int side2) {
  Proximity contact = manifold.deepest;
  if (!is_contact(contact, manifold.reach)) return count;
  if (manifold.corner_count == 0) return first == 0 ? append_contact(contact, out, count, side2) : count;
  for (int k = first; k < manifold.corner_count; ++k) {
    const ManifoldCorner& corner = manifold.corners[static_cast<std::size_t>(k)];
    contact.gap = -corner.depth;
    contact.contact = corner.point;
    if (is_contact(contact, manifold.reach)) count = append_contact(contact, out, count, side2);
  }
  return count;
}

/// Distributes the room for contacts: one for each manifold, and a fair share of the rest for its other corners.
class Shares {
 public:
  Shares(std::size_t manifolds, int room) : left_(static_cast<int>(manifolds)), spare_(std::max(0, room - left_)) {}

  /// The room for the next manifold.
  int next(const ContactManifold& manifold) {
    const int wanted = std::max(0, reduced_to(manifold, ContactManifold::kMaxCorners).corner_count - 1);
    const int share = std::min(wanted, (spare_ + left_ - 1) / left_);
    spare_ -= share;
    --left_;
    return share == wanted ? ContactManifold::kMaxCorners : 1 + share;
  }

 private:
  int left_;
  int spare_;
};

}  // namespace

int write_contacts(const ContactManifold& manifold, const ContactArray& out, int side2) {
  return append_from(0, reduced_to(manifold, out.room()), out, 0, side2);
}

int write_contacts(std::span<LocatedManifold> manifolds, const ContactArray& out) {
  int count = 0;
  Shares shares(manifolds.size(), out.room());
  // The deepest contact of each manifold comes first, so that the deepest of all is the first contact.
  for (LocatedManifold& located : manifolds) {
    located.manifold = reduced_to(located.manifold, shares.next(located.manifold));
    ContactManifold first = located.manifold;
    first.corner_count = std::min(first.corner_count, 1);
    count = append_from(0, first, out, count, located.side2);
  }
  for (const LocatedManifold& located : manifolds) count = append_from(1, located.manifold, out, count, located.side2);
  return count;
}

}  // namespace supernormal::ode
