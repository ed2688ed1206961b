#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/narrowphase/distance.h>

#include <cmath>
#include <csetjmp>
#include <csignal>
#include <exception>
#include <limits>
#include <optional>
#include <unordered_set>

#include "method.hpp"

namespace accuracy_cost {
namespace {

using supernormal::Vector3;

fcl::Transform3d to_fcl(const supernormal::Pose& pose) {
  fcl::Transform3d transform = fcl::Transform3d::Identity();
  transform.linear() = pose.rotation;
  transform.translation() = pose.position;
  return transform;
}

sigjmp_buf return_point;

/// Survives abort() during a call: FCL in Debian is built with assertions, and some fail.
class AbortCatcher {
 public:
  AbortCatcher() {
    struct sigaction action {};
    action.sa_handler = [](int /*signal*/) { siglongjmp(return_point, 1); };
    action.sa_flags = SA_NODEFER;
    sigaction(SIGABRT, &action, &before_);
  }
  ~AbortCatcher() { sigaction(SIGABRT, &before_, nullptr); }
  AbortCatcher(const AbortCatcher&) = delete;
  AbortCatcher& operator=(const AbortCatcher&) = delete;

 private:
  struct sigaction before_ {};
};

class FclDistance final : public Method {
 public:
  FclDistance(double tolerance, Motion motion)
      : Method("FCL signed distance", power_of_ten(tolerance)), motion_(motion), request_(true, true) {
    request_.distance_tolerance = tolerance;
    request_.gjk_solver_type = fcl::GJKSolverType::GST_LIBCCD;
  }

  Answer query(const Pair& pair) const override {
    if (motion_ == Motion::Moves) return ask_unless_it_aborts(pair).value_or(Answer());
    if (aborted_.contains(&pair)) return {};
    if (!seen_.insert(&pair).second) return ask(pair);
    // The first query of a pair is not timed.
    const std::optional<Answer> answer = ask_unless_it_aborts(pair);
    if (!answer) aborted_.insert(&pair);
    return answer.value_or(Answer());
  }

 private:
  std::optional<Answer> ask_unless_it_aborts(const Pair& pair) const {
    const AbortCatcher catcher;
    if (sigsetjmp(return_point, 0) != 0) return std::nullopt;  // leaks the memory that FCL had allocated
    return ask(pair);
  }

  Answer ask(const Pair& pair) const {
    const fcl::Ellipsoidd body1(pair.shape1->half_extents());
    const fcl::Ellipsoidd body2(pair.shape2->half_extents());
    fcl::DistanceResultd result;
    double gap = std::numeric_limits<double>::quiet_NaN();
    try {
      gap = fcl::distance(&body1, to_fcl(pair.pose1), &body2, to_fcl(pair.pose2), request_, result);
    } catch (const std::exception&) {  // its two stages disagree on touching bodies
    }
    if (!std::isfinite(gap)) return {};
    const auto& [point1, point2] = result.nearest_points;
    const Vector3 normal = (gap < 0 ? -1 : 1) * (point2 - point1).normalized();
    return {Answer::Kind::Gap, gap, normal, 0, 0.5 * (point1 + point2)};
  }

  Motion motion_;
  fcl::DistanceRequestd request_;
  mutable std::unordered_set<const Pair*> seen_, aborted_;
};

}  // namespace

Methods fcl_methods(Motion motion) {
  Methods methods;
  constexpr int kMostDigits = 8;
  methods.reserve(kMostDigits);
  for (int digits = 1; digits <= kMostDigits; ++digits)
    methods.push_back(std::make_unique<FclDistance>(std::pow(10.0, -digits), motion));
  return methods;
}

}  // namespace accuracy_cost
