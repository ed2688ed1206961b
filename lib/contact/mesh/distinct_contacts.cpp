#include "contact/mesh/distinct_contacts.hpp"

#include <algorithm>

namespace supernormal {
namespace {

// Two contacts are one if their normals and places are this close. The effect of a contact depends on both continuously, the
// vertices of a mesh are floats, so that a plane through them is known to about 1e-7 only, and the normal of a small gap is known
// to the root of its tolerance.
constexpr double kSameNormal = 1e-4;
constexpr double kSamePlace = 1e-4;  // of the length unit

// Cosine of 18 degrees: where surfaces run into each other, a contact with such a similar normal makes another one redundant.
constexpr double kSimilarNormal = 0.95;

// A point is on a tangent plane, or clearly behind it, at these distances in length units.
constexpr double kOnPlane = 1e-9;
constexpr double kBehindPlane = 1e-8;

// Cosine of 2.6 degrees: closer normals are those of a body that lies flat on two tips.
constexpr double kNearlyParallel = 0.999;

// Cosine beyond which two normals are those of the two sides of a plate: they belong together although the rim that joins them is
// far away.
constexpr double kOpposite = -0.5;

}  // namespace

void DistinctContacts::clear(double length_unit) {
  contacts_.clear();
  length_unit_ = length_unit;
}

void DistinctContacts::add(const SurfaceContact& contact) {
  const double near = kSamePlace * length_unit_;
  for (SurfaceContact& other : contacts_) {
    if (contact.crease >= 0 && contact.crease == other.crease) {
      if (contact.gap > other.gap) other = contact;
      return;
    }
    if ((other.normal - contact.normal).squaredNorm() > kSameNormal * kSameNormal) continue;
    if ((other.body_point - contact.body_point).squaredNorm() > near * near) continue;
    if (contact.gap < other.gap) other = contact;
    return;
  }
  contacts_.push_back(contact);
}

bool DistinctContacts::has_similar(const Vector3& normal, const Vector3& point) const {
  return std::any_of(contacts_.begin(), contacts_.end(), [&](const SurfaceContact& contact) {
    return contact.normal.dot(normal) > kSimilarNormal &&
           contact.normal.dot(point - contact.surface_point) <= kOnPlane * length_unit_;
  });
}

std::optional<double> DistinctContacts::shortest_separation(int part) const {
  std::optional<double> largest;
  for (const SurfaceContact& contact : contacts_) {
    if (contact.part == part && (!largest || contact.separation > *largest)) largest = contact.separation;
  }
  return largest;
}

bool DistinctContacts::are_of_one_part(const SurfaceContact& a, const SurfaceContact& b) const {
  if (a.part != b.part && a.normal.dot(b.normal) > kOpposite) return false;
  const Vector3 from_a_to_b = b.feature_point - a.feature_point;
  const double b_before_a = a.normal.dot(from_a_to_b);
  const double a_before_b = -b.normal.dot(from_a_to_b);
  if (std::max(b_before_a, a_before_b) > kOnPlane * length_unit_) return false;
  // Two normals of one edge separate the same part, as both planes go through it; but not the faces of a corner, which may have
  // been given the same point.
  const bool is_at_crease = a.crease >= 0 || b.crease >= 0;
  return (is_at_crease && a.normal.dot(b.normal) < kNearlyParallel) ||
         std::min(b_before_a, a_before_b) < -kBehindPlane * length_unit_;
}

void DistinctContacts::keep_shortest_separations() {
  sort();
  // A contact is dropped if any shallower one, whether that one remains or not, separates the body from the same part.
  const auto is_superseded = [&](const SurfaceContact& contact) {
    const auto* const shallower = &contact + 1;
    const auto* const end = contacts_.data() + contacts_.size();
    return std::any_of(shallower, end, [&](const SurfaceContact& other) { return are_of_one_part(contact, other); });
  };
  std::size_t kept = 0;
  for (const SurfaceContact& contact : contacts_) {
    if (!is_superseded(contact)) contacts_[kept++] = contact;
  }
  contacts_.resize(kept);
}

void DistinctContacts::sort() {
  std::sort(contacts_.begin(), contacts_.end(),
            [](const SurfaceContact& a, const SurfaceContact& b) { return a.gap != b.gap ? a.gap < b.gap : a.face < b.face; });
}

}  // namespace supernormal
