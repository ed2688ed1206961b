#include "ode/contact.hpp"

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

}  // namespace

int write_contacts(const ContactPatch& patch, const ContactArray& out) {
  const int count = append_contact(patch.deepest, out, 0);
  return count == 0 ? 0 : append_corners(patch, out, count);
}

int append_corners(const ContactPatch& patch, const ContactArray& out, int count, int side2) {
  Proximity corner = patch.deepest;
  corner.gap = 0;
  for (int k = 0; k < patch.corner_count; ++k) {
    corner.contact = patch.corners[static_cast<std::size_t>(k)];
    count = append_contact(corner, out, count, side2);
  }
  return count;
}

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

}  // namespace supernormal::ode
