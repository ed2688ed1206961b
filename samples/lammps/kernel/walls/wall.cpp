#include "kernel/walls/wall.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "kernel/contact_material.hpp"
#include "kernel/maximum_on_arc.hpp"
#include "supernormal/proximity/plane.hpp"

namespace granular {

namespace {

// Subdivision of the arc of normals along which the body can protrude, and of an interval with a maximum in it. Two maxima within
// the last are one. Where a rod of exponent 3 gets its second contact, its energy jumps by 0.2 of itself with a second number of 1,
// by 2e-2 with 3, and by 2e-3 with 7. Odd: the middle of the arc, where a symmetrical body has a minimum, is no border.
constexpr int kIntervals = 33;
constexpr int kFine = 7;

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

  /// The derivative of value(), alone and with the second one.
  double rise(double angle) const { return along(angle).dot(point(direction(angle))); }
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

PlaneWall::PlaneWall(const Vector3& point, const Vector3& normal) : normal_(normal.normalized()), offset_(normal_.dot(point)) {
  if (!(normal.norm() > 0)) throw std::invalid_argument("plane: the normal has no direction");
}

void PlaneWall::add_contacts(const ParticleShape& shape, const supernormal::Pose& pose, std::vector<WallContact>& contacts) {
  if (normal_.dot(pose.position) - offset_ >= shape.bounding_radius) return;
  const supernormal::Proximity found = supernormal::find_plane_proximity(shape.body, pose, normal_, offset_);
  if (found.gap < shape.bulge)
    contacts.push_back({found.normal, found.contact, -found.gap, Matrix3::Zero(), Ground::plane(found.point2, normal_)});
}

BoxWall::BoxWall(const Vector3& low, const Vector3& high) {
  if (!(low.array() < high.array()).all()) throw std::invalid_argument("box: the low corner is not below the high one");
  for (int axis = 0; axis < 3; ++axis) {
    sides_.push_back(std::make_unique<PlaneWall>(low, Vector3::Unit(axis)));
    sides_.push_back(std::make_unique<PlaneWall>(high, -Vector3::Unit(axis)));
  }
}

void BoxWall::add_contacts(const ParticleShape& shape, const supernormal::Pose& pose, std::vector<WallContact>& contacts) {
  for (const auto& side : sides_) side->add_contacts(shape, pose, contacts);
}

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
  // Appends the maximum or the minimum between two angles with these slopes.
  const auto add_extremum = [&](double low, double slope_low, double high, double slope_high) {
    const double sign = slope_low > 0 ? 1 : -1;
    if (slope_low == 0 || sign * slope_high > 0) return;
    if (sign < 0 && std::min(outline.value(low), outline.value(high)) <= radius_) return;
    const auto uphill = [&](double here) -> ArcSlope {
      const ArcSlope slope = outline.slope(here);
      return {sign * slope.first, sign * slope.second};
    };
    const double angle = find_maximum_on_arc(uphill, low, high);
    const Vector3 u = outline.direction(angle), along = outline.along(angle);
    const double depth = outline.value(angle) - radius_;
    if (depth <= (sign > 0 ? -shape.bulge : 0)) return;
    contacts.push_back({u, outline.point(u) + point_, depth, -along * along.transpose() / radius_, std::nullopt, pipe, sign < 0});
  };
  double low_value = outline.value(middle - half);
  for (int k = 0; k < kIntervals; ++k) {
    const double low = middle - half + k * spacing, high_value = outline.value(low + spacing);
    // The two tangents intersect no farther out than this between the two normals.
    const bool may_stick_out = std::max(low_value, high_value) > (radius_ - shape.bulge) * std::cos(0.5 * spacing);
    low_value = high_value;
    if (!may_stick_out) continue;
    const double at_low = outline.rise(low), at_high = outline.rise(low + spacing);
    const int parts = at_low > 0 && at_high <= 0 ? kFine : 1;
    double slope = at_low;
    for (int part = 1; part <= parts; ++part) {
      const double next = part < parts ? outline.rise(low + part * spacing / parts) : at_high;
      add_extremum(low + (part - 1) * spacing / parts, slope, low + part * spacing / parts, next);
      slope = next;
    }
  }
}

}  // namespace granular
