// Exponents at the ends of their range, and near 2, where the formulas change.
#include <cmath>

#include "support/hard_cases/builders.hpp"

namespace supernormal::samples {
namespace {

const char* reason_of(double exponent) {
  if (exponent < 1.5) return "vertices and edges attract all normals: the dual exponent is 50 to 100";
  if (exponent < 3) return "another path than that of 2 exactly: both must agree";
  return "the boundary point is the 0.02nd to 0.001st power of the normal: faces jump, edges are sharp";
}

void add_both_gaps(std::vector<HardCase>& cases, const std::string& name, const std::string& reason, const Body& body1,
                   const Body& body2) {
  for (const double gap : {0.125, -0.0625}) {
    cases.push_back(
        on_normal(name + (gap > 0 ? ", apart" : ", overlapping"), reason, body1, Vector3(1, 0.7, 1.6), body2, askew(), gap));
  }
}

}  // namespace

std::vector<HardCase> exponent_cases() {
  std::vector<HardCase> cases;
  for (const double exponent : {1.01, 1.02, 2 - 1e-6, 2 - 1e-15, 2 + 1e-15, 2 + 1e-6, 50., 200., 1000.}) {
    const double beside = exponent - 2;
    const std::string name = std::abs(beside) > 0.5 ? text(exponent) : (beside > 0 ? "2 + " : "2 - ") + text(std::abs(beside));
    const Body body = superellipsoid(kLengths, exponent, exponent);
    add_both_gaps(cases, "exponents: " + name, reason_of(exponent), body, body);
  }
  const std::string reason = "delta and epsilon at opposite ends: flat one way, sharp the other";
  const Body spindle = superellipsoid(kLengths, 1000, 1.01), plate = superellipsoid(kLengths, 1.01, 1000);
  add_both_gaps(cases, "exponents: 1000, 1.01", reason, spindle, spindle);
  add_both_gaps(cases, "exponents: 1.01, 1000", reason, plate, plate);
  add_both_gaps(cases, "exponents: 1000, 1.01 against 1.01, 1000", reason, spindle, plate);
  add_both_gaps(cases, "exponents: 2, 1000 against 1000, 2", reason, superellipsoid(kLengths, 2, 1000),
                superellipsoid(kLengths, 1000, 2));
  add_both_gaps(cases, "exponents: 1.01 against 1000", "nearly an octahedron and nearly a box",
                superellipsoid(kLengths, 1.01, 1.01), superellipsoid(kLengths, 1000, 1000));
  return cases;
}

}  // namespace supernormal::samples
