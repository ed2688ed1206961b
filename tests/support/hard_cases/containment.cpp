// Deep overlap up to total containment. There are several separating translations, and the shortest may be far from the centre
// line.
#include "support/hard_cases/builders.hpp"

namespace supernormal::samples {
namespace {

struct Family {
  const char* name;
  double delta, epsilon;
};

constexpr Family kFamilies[] = {{"ellipsoids", 2, 2},           {"boxy (8)", 8, 8},       {"boxy (60)", 60, 60},
                                {"octahedral (1.1)", 1.1, 1.1}, {"cylinder-like", 2, 60}, {"spindles", 60, 1.3}};

/// Places body 2 between touching at an oblique normal (fraction 0) and concentric (fraction 1).
HardCase at_depth(const Family& family, double share, const Matrix3& rotation, const std::string& attitude) {
  const Body large = superellipsoid({1, 0.8, 0.5}, family.delta, family.epsilon);
  const Body small = superellipsoid({0.5, 0.7, 0.3}, family.delta, family.epsilon);
  HardCase out = on_normal("containment: " + std::string(family.name) + ", " + text(100 * share) + " %, " + attitude,
                           "several ways out: the solver has to find the shortest or say that it may not have", large,
                           Vector3(0.5, 0.6, 0.4), small, rotation, 0);
  out.pose2.position *= 1 - share;
  out.gap.reset();
  return out;
}

}  // namespace

std::vector<HardCase> containment_cases() {
  std::vector<HardCase> cases;
  for (const Family& family : kFamilies) {
    for (const double share : {0.3, 0.9}) {
      cases.push_back(at_depth(family, share, Matrix3::Identity(), "aligned"));
      cases.push_back(at_depth(family, share, askew(), "askew"));
    }
    const std::string name = "containment: " + std::string(family.name) + ", wholly inside";
    const std::string reason = "the small body never meets the large one's boundary: all the ways out are long";
    const Body large = superellipsoid({1, 0.8, 0.5}, family.delta, family.epsilon);
    const Body small = superellipsoid({0.05, 0.07, 0.03}, family.delta, family.epsilon);
    cases.push_back(pair(name + ", off centre", reason, large, small, at({0.2, -0.15, 0.1}, askew())));
    cases.push_back(pair(name + ", in the middle", reason, large, small, at({0, 0, 1e-3}, askew())));
  }
  cases.push_back(pair("containment: a sphere inside a sphere", "one way out, known: through the nearest point",
                       ellipsoid(Vector3::Ones()), ellipsoid(Vector3::Constant(0.125)), at({0.375, 0, 0}), -0.75));
  return cases;
}

}  // namespace supernormal::samples
