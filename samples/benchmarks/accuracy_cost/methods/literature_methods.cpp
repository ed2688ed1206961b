#include <Eigen/Geometry>

#include "literature/method.hpp"
#include "method.hpp"

namespace accuracy_cost {
namespace {

using literature::CommonNormal;
using literature::Outcome;
using supernormal::Vector3;

class OfLiterature final : public Method {
 public:
  OfLiterature(const std::string& name, literature::Solve solve, Start start, double tolerance)
      : Method(name, power_of_ten(tolerance)), solve_(solve), start_(start), tolerance_(tolerance) {}

  Answer query(const Pair& pair) const override {
    const literature::Bodies bodies(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2);
    const literature::Options options{.tolerance = tolerance_, .first_normal = start_ == Start::Warm ? &pair.warm_normal : nullptr};
    const CommonNormal found = solve_(bodies, options);
    const double evaluations = found.evaluations;
    if (found.outcome == Outcome::Failed) return {Answer::Kind::None, 0, Vector3::UnitX(), evaluations};
    if (found.outcome == Outcome::Apart) return {Answer::Kind::Apart, 0, Vector3::UnitX(), evaluations};
    const Vector3 contact = pair.pose1.rotation * (0.5 * (found.point1 + found.point2)) + pair.pose1.position;
    return {Answer::Kind::Gap, found.gap, pair.pose1.rotation * found.normal, evaluations, contact};
  }

 private:
  literature::Solve solve_;
  Start start_;
  double tolerance_;
};

}  // namespace

Methods literature_methods(Start start, double tolerance) {
  Methods methods;
  for (const auto& [name, solve] : literature::methods()) {
    methods.push_back(
        std::make_unique<OfLiterature>(start == Start::Warm ? std::string(name) + " (warm)" : name, solve, start, tolerance));
  }
  return methods;
}

}  // namespace accuracy_cost
