#include <ccd/ccd.h>

#include <type_traits>

#include "method.hpp"

namespace accuracy_cost {
namespace {

using supernormal::Vector3;

static_assert(std::is_same_v<ccd_real_t, double>, "the comparison is with libccd in double precision, as Debian builds it");

constexpr double kEpaTolerance = 1e-6;
constexpr double kMprTolerance = 1e-4;

/// A body for the callbacks of libccd.
struct CcdBody {
  const supernormal::Shape& shape;
  const supernormal::Pose& pose;
  mutable int evaluations = 0;
};

void copy(const Vector3& from, ccd_vec3_t* to) { ccdVec3Set(to, from.x(), from.y(), from.z()); }

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  const auto& body = *static_cast<const CcdBody*>(object);
  ++body.evaluations;
  // The directions of libccd have any length. The point does not depend on it, so the square root is omitted.
  const Vector3 n = body.pose.rotation.transpose() * Vector3(direction->v[0], direction->v[1], direction->v[2]);
  supernormal::Jet jet;
  body.shape.evaluate(n, supernormal::Order::Point, jet);
  copy(body.pose.rotation * jet.r + body.pose.position, point);
}

void centre(const void* object, ccd_vec3_t* point) { copy(static_cast<const CcdBody*>(object)->pose.position, point); }

/// ccdGJKPenetration or ccdMPRPenetration.
using Penetration = int (*)(const void*, const void*, const ccd_t*, ccd_real_t*, ccd_vec3_t*, ccd_vec3_t*);

class Libccd final : public Method {
 public:
  Libccd(std::string name, Penetration penetration, double tolerance)
      : Method(std::move(name), power_of_ten(tolerance)), penetration_(penetration) {
    constexpr unsigned long kMaxIterations = 100;  // for GJK and MPR; EPA of libccd has no limit
    CCD_INIT(&settings_);
    settings_.support1 = settings_.support2 = support;
    settings_.center1 = settings_.center2 = centre;
    settings_.max_iterations = kMaxIterations;
    settings_.epa_tolerance = settings_.mpr_tolerance = tolerance;
  }

  Answer query(const Pair& pair) const override {
    const CcdBody body1{*pair.shape1, pair.pose1};
    const CcdBody body2{*pair.shape2, pair.pose2};
    double depth = 0;
    ccd_vec3_t direction, position;
    const int result = penetration_(&body1, &body2, &settings_, &depth, &direction, &position);
    const double evaluations = 0.5 * (body1.evaluations + body2.evaluations);
    if (result == -1) return {Answer::Kind::Apart, 0, Vector3::UnitX(), evaluations};
    if (result != 0) return {.evaluations = evaluations};
    return {Answer::Kind::Gap, -depth, Vector3(direction.v[0], direction.v[1], direction.v[2]), evaluations,
            Vector3(position.v[0], position.v[1], position.v[2])};
  }

 private:
  Penetration penetration_;
  ccd_t settings_;
};

}  // namespace

std::unique_ptr<Method> ccd_epa(std::string name, double tolerance) {
  return std::make_unique<Libccd>(std::move(name), ccdGJKPenetration, tolerance);
}

std::unique_ptr<Method> ccd_mpr(std::string name, double tolerance) {
  return std::make_unique<Libccd>(std::move(name), ccdMPRPenetration, tolerance);
}

Methods libccd_methods() {
  Methods methods;
  methods.push_back(ccd_epa(kCcdEpa, kEpaTolerance));
  methods.push_back(ccd_mpr(kCcdMpr, kMprTolerance));
  return methods;
}

}  // namespace accuracy_cost
