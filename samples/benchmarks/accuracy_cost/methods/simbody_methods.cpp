#include <cmath>
#include <unordered_map>

#include "method.hpp"
#include "simbody_contact.hpp"

namespace accuracy_cost {
namespace {

using supernormal::Vector3;

SimbodyPose to_simbody(const supernormal::Pose& pose) {
  SimbodyPose result;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(result.rotation.data()) = pose.rotation;
  Eigen::Map<Vector3>(result.position.data()) = pose.position;
  return result;
}

Vector3 to_eigen(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

class Simbody final : public Method {
 public:
  explicit Simbody(double accuracy) : Method("Simbody MPR+Newton", power_of_ten(accuracy)), accuracy_(accuracy) {}

  Answer query(const Pair& pair) const override {
    const SimbodyContact found =
        body(pair.shape1).meet(to_simbody(pair.pose1), body(pair.shape2), to_simbody(pair.pose2), accuracy_);
    if (found.is_apart) return {Answer::Kind::Apart, 0, Vector3::UnitX(), 0};
    if (!found.has_converged) return {};
    return {Answer::Kind::Gap, found.gap, to_eigen(found.normal), 0, to_eigen(found.contact)};
  }

 private:
  /// Creates the body once, outside the measured time, because the first query of a pair is not timed.
  const SimbodyEllipsoid& body(const std::shared_ptr<const supernormal::Shape>& shape) const {
    const auto known = bodies_.find(shape.get());
    if (known != bodies_.end()) return known->second.body;
    const Vector3 half = shape->half_extents();
    return bodies_.emplace(shape.get(), Kept{shape, SimbodyEllipsoid({half.x(), half.y(), half.z()})}).first->second.body;
  }

  struct Kept {
    std::shared_ptr<const supernormal::Shape> shape;  // kept alive, so that no other shape gets its address
    SimbodyEllipsoid body;
  };
  double accuracy_;
  mutable std::unordered_map<const supernormal::Shape*, Kept> bodies_;
};

}  // namespace

Methods simbody_methods() {
  Methods methods;
  for (const int digits : {1, 3, 6, 9, 12}) methods.push_back(std::make_unique<Simbody>(std::pow(10.0, -digits)));
  return methods;
}

}  // namespace accuracy_cost
