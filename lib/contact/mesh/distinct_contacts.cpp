// Selection of the distinct contacts of a body and a surface.
#include <algorithm>

#include "contact/mesh/mesh_contact_search.hpp"

namespace supernormal {
namespace {

// Two contacts are the same if their normals and places are this close. The tolerances are loose because contacts act continuously.
// Vertices of a mesh are floats, so a plane through them is known to about 1e-7. The normal of a small gap is known to the square
// root of its tolerance.
constexpr double kSameNormal = 1e-4;
constexpr double kSamePlace = 1e-4;  // of the length unit

// cos 18°. Where surfaces intersect, a contact with a normal this similar makes another one redundant.
constexpr double kSimilarNormal = 0.95;

// A point within kOnPlane of a tangent plane is on it; beyond kBehindPlane it is behind it. In length units.
constexpr double kOnPlane = 1e-9;
constexpr double kBehindPlane = 1e-8;

// cos 2.6°. Closer normals belong to a body that lies flat on two tips.
constexpr double kNearlyParallel = 0.999;

}  // namespace

void DistinctContacts::clear(double length_unit, const Vector3& middle) {
  contacts_.clear();
  length_unit_ = length_unit;
  middle_ = middle;
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

bool DistinctContacts::are_of_one_part(const SurfaceContact& deeper, const SurfaceContact& other) const {
  if (deeper.part != other.part && deeper.normal.dot(middle_ - deeper.surface_point) >= 0) return false;
  const Vector3 to_other = other.feature_point - deeper.feature_point;
  const double other_before = deeper.normal.dot(to_other);
  const double deeper_before = -other.normal.dot(to_other);
  if (std::max(other_before, deeper_before) > kOnPlane * length_unit_) return false;
  // Two normals of one edge separate the same part, because both planes contain the edge. This does not hold for two faces of a
  // corner, which may have the same point.
  const bool is_at_crease = deeper.crease >= 0 || other.crease >= 0;
  return (is_at_crease && deeper.normal.dot(other.normal) < kNearlyParallel) ||
         std::min(other_before, deeper_before) < -kBehindPlane * length_unit_;
}

void DistinctContacts::keep_shortest_separations() {
  sort();
  // Drop a contact if any shallower one separates the body from the same part, even if that one is dropped, too.
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
