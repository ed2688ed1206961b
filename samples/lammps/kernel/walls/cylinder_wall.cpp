#include "kernel/walls/cylinder_wall.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "kernel/maximum_on_arc.hpp"
#include "kernel/refuse.hpp"

namespace granular {
namespace {

constexpr int kIntervals = 32;  // subdivision of the arc of normals along which the body can protrude

/// The support function of a body for directions perpendicular to an axis through the origin.
class Outline {
 public:
  Outline(const ParticleShape& shape, const supernormal::Pose& pose, const Vector3& across1, const Vector3& across2)
      : shape_(shape), pose_(pose), across1_(across1), across2_(across2) {}

  Vector3 direction(double angle) const { return std::cos(angle) * across1_ + std::sin(angle) * across2_; }
  Vector3 along(double angle) const { return -std::sin(angle) * across1_ + std::cos(angle) * across2_; }
  double value(double angle) const {
    const Vector3 u = direction(angle);
    return u.dot(pose_.position) + shape_.body.support(pose_.rotation.transpose() * u);
  }
  Vector3 point(const Vector3& u) const {
    return pose_.position + pose_.rotation * shape_.body.point(pose_.rotation.transpose() * u);
  }

  /// The derivatives of value().
  ArcSlope slope(double angle) const {
    const Vector3 u = direction(angle), t = along(angle), t_body = pose_.rotation.transpose() * t;
    const supernormal::Jet jet = shape_.body.jet(pose_.rotation.transpose() * u);
    const Vector3 p = pose_.position + pose_.rotation * jet.r;
    return {t.dot(p), t_body.dot(jet.H * t_body) - u.dot(p)};
  }

 private:
  const ParticleShape& shape_;
  const supernormal::Pose& pose_;
  Vector3 across1_, across2_;
};

}  // namespace

CylinderWall::CylinderWall(const Vector3& point, const Vector3& axis, double radius) : point_(point), radius_(radius) {
  if (!(axis.norm() > 0)) throw std::invalid_argument("cylinder: the axis has no direction");
  if (!(radius > 0)) refuse("cylinder: radius", radius, "(0, inf)");
  across1_ = axis.unitOrthogonal();
  across2_ = axis.normalized().cross(across1_);
}

void CylinderWall::add_contacts(const ParticleShape& shape, const supernormal::Pose& pose, std::vector<WallContact>& contacts) {
  const supernormal::Pose from_axis{pose.position - point_, pose.rotation};
  const Vector3 offset = across1_.dot(from_axis.position) * across1_ + across2_.dot(from_axis.position) * across2_;
  if (offset.norm() + shape.bounding_radius <= radius_) return;

  const Pipe pipe{point_, across1_.cross(across2_), radius_};
  const Outline outline(shape, from_axis, across1_, across2_);
  // Where the body protrudes, its bounding sphere does, too: on an arc around the sphere's direction.
  const double middle = std::atan2(across2_.dot(offset), across1_.dot(offset));
  const double reach = radius_ - shape.bounding_radius, distance = offset.norm();
  const double half = reach > -distance ? std::acos(reach / distance) : std::numbers::pi;
  const double spacing = 2 * half / kIntervals;
  double low = middle - half, low_value = outline.value(low);
  for (int k = 1; k <= kIntervals; ++k) {
    const double high = middle - half + k * spacing, high_value = outline.value(high);
    // The two tangents intersect no farther out than this between the two normals.
    const bool may_stick_out = std::max(low_value, high_value) > (radius_ - shape.bulge) * std::cos(0.5 * spacing);
    if (may_stick_out && outline.slope(low).first > 0 && outline.slope(high).first <= 0) {
      const double angle = find_maximum_on_arc([&](double here) { return outline.slope(here); }, low, high);
      const Vector3 u = outline.direction(angle), along = outline.along(angle);
      const double depth = outline.value(angle) - radius_;
      if (depth > -shape.bulge) {
        contacts.push_back({u, outline.point(u) + point_, depth, -along * along.transpose() / radius_, std::nullopt, pipe});
      }
    }
    low = high;
    low_value = high_value;
  }
}

}  // namespace granular
