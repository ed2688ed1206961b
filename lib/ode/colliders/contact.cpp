#include "ode/colliders/contact.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "ode/geom/convert.hpp"
#include "ode/runtime/statistics.hpp"

namespace supernormal::ode {
namespace {

// ODE asserts that the normal is finite and a unit vector. Check every contact here.
bool has_contacts(const Proximity& proximity) {
  if (proximity.status == Status::Apart || proximity.status == Status::InvalidInput) return false;
  return std::abs(proximity.normal.squaredNorm() - 1) < 1e-6;
}

bool is_contact(double gap, const Vector3& point, double reach) { return gap <= reach && std::isfinite(gap) && point.allFinite(); }

/// Writes the points of a reduced manifold from number `first` on, while the array has room after the first `count`. Returns the
/// new count. A manifold without points has its deepest point as number 0.
int append_from(int first, const ContactManifold& manifold, const ContactArray& out, int count, int side2) {
  const Proximity& deepest = manifold.deepest;
  if (!has_contacts(deepest) || !is_contact(deepest.gap, deepest.contact, manifold.reach)) return count;
  const Vector3 normal = -deepest.normal.normalized();
  const int before = count;
  const auto append = [&](const Vector3& point, double depth) {
    if (count >= out.max_contacts() || !is_contact(-depth, point, manifold.reach)) return;
    auto* const place = reinterpret_cast<char*>(out.first) + std::ptrdiff_t{count} * out.skip;
    dContactGeom& contact = *reinterpret_cast<dContactGeom*>(place);
    from_vector(point, contact.pos);
    from_vector(normal, contact.normal);
    contact.depth = to_real(depth);
    if (contact.depth == 0) contact.depth = 0;  // not -0
    contact.g1 = out.o1;
    contact.g2 = out.o2;
    contact.side1 = -1;
    contact.side2 = side2;
    ++count;
  };
  if (manifold.corner_count == 0 && first == 0) append(deepest.contact, -deepest.gap);
  for (int k = first; k < manifold.corner_count; ++k) {
    const ManifoldCorner& corner = manifold.corners[static_cast<std::size_t>(k)];
    append(corner.point, corner.depth);
  }
  count_contacts(count - before, deepest.status);
  return count;
}

/// Distributes max_contacts: one contact for each manifold, and an equal share of the rest for its other points.
class ContactBudget {
 public:
  ContactBudget(std::size_t manifolds, int max_contacts)
      : left_(static_cast<int>(manifolds)), spare_(std::max(0, max_contacts - left_)) {}

  /// The number of contacts for the next manifold.
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
  return append_from(0, reduced_to(manifold, out.max_contacts()), out, 0, side2);
}

int write_contacts(std::span<LocatedManifold> manifolds, const ContactArray& out) {
  int count = 0;
  ContactBudget budget(manifolds.size(), out.max_contacts());
  // Write the deepest contact of each manifold first. Then the deepest contact of all is contact 0.
  for (LocatedManifold& located : manifolds) {
    located.manifold = reduced_to(located.manifold, budget.next(located.manifold));
    ContactManifold first = located.manifold;
    first.corner_count = std::min(first.corner_count, 1);
    count = append_from(0, first, out, count, located.side2);
  }
  for (const LocatedManifold& located : manifolds) count = append_from(1, located.manifold, out, count, located.side2);
  return count;
}

}  // namespace supernormal::ode
