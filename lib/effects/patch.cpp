#include "effects/patch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/tangent_plane.hpp"
#include "ode/geom/convert.hpp"

namespace supernormal::effects {
namespace {

// rad; ODE keeps the vertices of meshes in single precision, with errors of 6e-8 of their coordinates. The coordinates may be a
// thousand times as large as a triangle.
constexpr double kSameNormal = 1e-4;

}  // namespace

bool is_same_region(const dContact& a, const dContact& b) {
  const Vector3 difference = ode::to_vector(a.geom.normal) - ode::to_vector(b.geom.normal);
  return difference.squaredNorm() <= kSameNormal * kSameNormal;
}

Vector3 Patch::normal() const { return ode::to_vector(contacts.front().geom.normal); }

double Patch::greatest_depth() const {
  double depth = 0;
  for (const dContact& contact : contacts) depth = std::max(depth, double{contact.geom.depth});
  return depth;
}

// A vertex of a polygon is the outermost point for the directions of its normal cone. The angle of the cone is pi less the interior
// angle at the vertex.
double Patch::fraction_at(std::size_t k) const {
  if (contacts.size() == 1) return 1;
  const TangentPlane plane = TangentPlane::at(normal());
  const Vector3 here = ode::to_vector(contacts[k].geom.pos);
  Vector2 first = Vector2::Zero();  // the direction to another contact, from which the other angles are measured
  double least = 0;
  double greatest = 0;
  int at_this_place = 0;
  for (const dContact& contact : contacts) {
    const Vector2 to_other = plane.project(ode::to_vector(contact.geom.pos) - here);  // 0 for itself, in registers of any width
    if (to_other.isZero(0)) {
      ++at_this_place;
    } else if (first.isZero(0)) {
      first = to_other;
    } else {
      const double angle = std::atan2(first.x() * to_other.y() - first.y() * to_other.x(), first.dot(to_other));
      least = std::min(least, angle);
      greatest = std::max(greatest, angle);
    }
  }
  if (first.isZero(0)) return 1.0 / at_this_place;
  constexpr double kPi = std::numbers::pi;
  return std::max(0.0, kPi - (greatest - least)) / (2 * kPi * at_this_place);
}

Vector3 Patch::middle() const {
  Vector3 middle = Vector3::Zero();
  for (std::size_t k = 0; k < contacts.size(); ++k) middle += fraction_at(k) * ode::to_vector(contacts[k].geom.pos);
  return middle;
}

Vector3 Patch::centre_of_depth() const {
  Vector3 moment = Vector3::Zero();
  double depths = 0;
  for (const dContact& contact : contacts) {
    moment += double{contact.geom.depth} * ode::to_vector(contact.geom.pos);
    depths += contact.geom.depth;
  }
  return depths > 0 ? Vector3(moment / depths) : middle();
}

}  // namespace supernormal::effects
