#include "simbody_contact.hpp"

#include <SimTKmath.h>

namespace accuracy_cost {
namespace {

using Tracker = SimTK::ContactTracker::ConvexImplicitPair;

SimTK::Transform to_simbody(const SimbodyPose& pose) {
  const SimTK::Rotation rotation(SimTK::Mat33(pose.rotation.data()), true);
  return {rotation, SimTK::Vec3(pose.position[0], pose.position[1], pose.position[2])};
}

std::array<double, 3> to_array(const SimTK::Vec3& v) { return {v[0], v[1], v[2]}; }

}  // namespace

struct SimbodyEllipsoid::Geometry {
  SimTK::ContactGeometry::Ellipsoid ellipsoid;
};

SimbodyEllipsoid::SimbodyEllipsoid(const std::array<double, 3>& half_axes)
    : geometry_(std::make_shared<Geometry>(
          Geometry{SimTK::ContactGeometry::Ellipsoid(SimTK::Vec3(half_axes[0], half_axes[1], half_axes[2]))})) {}

SimbodyContact SimbodyEllipsoid::meet(const SimbodyPose& pose, const SimbodyEllipsoid& other, const SimbodyPose& other_pose,
                                      double accuracy) const {
  const SimTK::ContactGeometry& body1 = geometry_->ellipsoid;
  const SimTK::ContactGeometry& body2 = other.geometry_->ellipsoid;
  const SimTK::Transform frame = to_simbody(pose);
  const SimTK::Transform other_in_frame = ~frame * to_simbody(other_pose);
  SimTK::Vec3 point1, point2;
  SimTK::UnitVec3 direction;
  int iterations = 0;
  SimbodyContact answer;
  answer.is_apart =
      !Tracker::estimateConvexImplicitPairContactUsingMPR(body1, body2, other_in_frame, point1, point2, direction, iterations);
  if (answer.is_apart) return answer;
  double achieved = 0;
  answer.has_converged = Tracker::refineImplicitPair(body1, point1, body2, point2, other_in_frame, accuracy, achieved, iterations);
  const SimTK::Vec3 normal(body1.calcSurfaceUnitNormal(point1));
  const SimTK::Vec3 there = other_in_frame * point2;
  answer.gap = SimTK::dot(there - point1, normal);
  answer.normal = to_array(frame.R() * normal);
  answer.contact = to_array(frame * (0.5 * (point1 + there)));
  return answer;
}

}  // namespace accuracy_cost
