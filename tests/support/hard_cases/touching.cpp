// Gaps of zero, or of one unit in the last place above or below.
#include <cmath>

#include "support/hard_cases/builders.hpp"

namespace supernormal::samples {
namespace {

constexpr double kUlp = 0x1p-53;  // m; 1.1e-16: one unit in the last place of the distance below

struct OneExponent {
  const char* name;
  double exponent;
};

constexpr OneExponent kOneExponents[] = {{"octahedral (1.02)", 1.02}, {"ellipsoids", 2}, {"rounded (4)", 4}, {"boxy (200)", 200}};

}  // namespace

std::vector<HardCase> touching_cases() {
  std::vector<HardCase> cases;
  const Vector3 half_axes(0.375, 0.3125, 0.25);
  for (const OneExponent& family : kOneExponents) {
    const Body body = superellipsoid(half_axes, family.exponent, family.exponent);
    for (const double gap : {-kUlp, 0., kUlp}) {
      const std::string name = std::string(family.name) + ", gap " + text(gap);
      cases.push_back(pair("touching: " + name, "the sign of the gap is rounding: neither path may fail", body, body,
                           at({0, 0, 0.5 + gap}), gap));
    }
    cases.push_back(on_normal("touching: " + std::string(family.name) + ", askew", "the gap is zero but for rounding", body,
                              Vector3(1, 2, -1), body, askew(), 0));
  }
  // These superballs are from the LAMMPS unit tests (tests/data/README.md).
  for (const double exponent : {2., 3.5, 8.}) {
    HardCase touching = pair("touching: LAMMPS superballs " + text(exponent), "published: touch at the origin",
                             superball(3.456, exponent), superball(3.456, exponent), at({3.456, 0, 0}), 0);
    touching.pose1.position.x() = -3.456;
    cases.push_back(touching);
  }
  return cases;
}

}  // namespace supernormal::samples
