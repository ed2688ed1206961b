// Superovoids at the limit of convexity, rounded bodies, bodies with only two functions.
#include "support/hard_cases/builders.hpp"

namespace supernormal::samples {
namespace {

void add_three(std::vector<HardCase>& cases, const std::string& name, const std::string& reason, const Body& body) {
  cases.push_back(on_normal(name + ", apart", reason, body, Vector3(1, -0.5, 0.5), body, askew(), 0.125));
  cases.push_back(on_normal(name + ", touching", reason, body, Vector3(1, -0.5, 0.5), body, askew(), 0));
  cases.push_back(on_normal(name + ", overlapping", reason, body, Vector3(1, -0.5, 0.5), body, askew(), -0.0625));
}

}  // namespace

std::vector<HardCase> other_shape_cases() {
  std::vector<HardCase> cases;
  add_three(cases, "superovoids: egg", "no centre of symmetry", superovoid(kDyadicLengths, 2, 2, 0.3, 0.3));
  add_three(cases, "superovoids: at the limit of convexity", "a radius of curvature is infinite there",
            superovoid(kDyadicLengths, 2, 2, 0.7071, 0.7071));
  add_three(cases, "superovoids: truncated pyramid", "flat faces that are not parallel",
            superovoid(kDyadicLengths, 40, 40, 0.5, 0.5));
  add_three(cases, "superovoids: wedge", "tapered the opposite way along y", superovoid(kDyadicLengths, 4, 2, 0.4, -0.4));
  add_three(cases, "rounded: boxy (60)", "two scales of curvature in one body",
            superellipsoid(kDyadicLengths, 60, 60).rounded(0.01));
  add_three(cases, "rounded: octahedral (1.02)", "a vertex that is a tiny sphere",
            superellipsoid(kDyadicLengths, 1.02, 1.02).rounded(1e-6));
  add_three(cases, "callbacks: ellipsoid", "no Hessian: curvature comes from secants", ellipsoid(kDyadicLengths).by_callbacks());
  add_three(cases, "callbacks: boxy (20)", "no Hessian, and no way to move along a flat face",
            superellipsoid(kDyadicLengths, 20, 20).by_callbacks());
  add_three(cases, "callbacks: octahedral (1.1)", "no Hessian: secants jump between the vertices",
            superellipsoid(kDyadicLengths, 1.1, 1.1).by_callbacks());
  return cases;
}

}  // namespace supernormal::samples
