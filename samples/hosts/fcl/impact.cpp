// Times of impact by FCL's conservative advancement, beside ours (../impact/comparison.hpp).
#include <fcl/fcl.h>

#include <stdexcept>

#include "../impact/comparison.hpp"

namespace {

using namespace supernormal;
using namespace supernormal::impact_hosts;

std::shared_ptr<fcl::CollisionGeometryd> geometry_of(const Shape& shape) {
  if (const auto* ball = dynamic_cast<const Sphere*>(&shape)) return std::make_shared<fcl::Sphered>(ball->radius());
  if (const auto* box = dynamic_cast<const Box*>(&shape)) return std::make_shared<fcl::Boxd>(2 * box->half_lengths());
  if (const auto* capsule = dynamic_cast<const Capsule*>(&shape)) {
    return std::make_shared<fcl::Capsuled>(capsule->radius(), 2 * capsule->half_length());
  }
  if (const auto* can = dynamic_cast<const Cylinder*>(&shape)) {
    return std::make_shared<fcl::Cylinderd>(can->radius(), 2 * can->half_length());
  }
  throw std::logic_error("FCL has no such shape");
}

struct FclBody {
  explicit FclBody(const MovingBody& body)
      : geometry(geometry_of(*body.shape)), first(transform_of(body.at(0))), last(transform_of(body.at(kHorizon))) {}

  static fcl::Transform3d transform_of(const Pose& pose) {
    fcl::Transform3d transform = fcl::Transform3d::Identity();
    transform.linear() = pose.rotation;
    transform.translation() = pose.position;
    return transform;
  }

  std::shared_ptr<fcl::CollisionGeometryd> geometry;
  fcl::Transform3d first, last;
};

double time_by_fcl(const FclBody& one, const FclBody& other) {
  const fcl::ContinuousCollisionRequestd request(1000, 1e-9, fcl::CCDM_LINEAR, fcl::GST_LIBCCD, fcl::CCDC_CONSERVATIVE_ADVANCEMENT);
  fcl::ContinuousCollisionResultd result;
  fcl::continuousCollide<double>(one.geometry.get(), one.first, one.last, other.geometry.get(), other.first, other.last, request,
                                 result);
  return result.is_collide ? result.time_of_contact * kHorizon : kNoImpact;
}

}  // namespace

int main() {
  const Contestant fcl{"FCL", [](const MovingPair& pair) {
                         return [one = FclBody(pair.one), other = FclBody(pair.other)] { return time_by_fcl(one, other); };
                       }};
  constexpr Bodies kKinds[] = {Bodies::Colliders};  // FCL has no conservative advancement for ellipsoids
  return compare(kKinds, {fcl}) ? 0 : 1;
}
