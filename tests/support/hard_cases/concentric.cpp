// Concentric, identical, aligned bodies. The centre line has no direction, or every direction is equally good.
#include <cmath>

#include "support/hard_cases/builders.hpp"

namespace supernormal::samples {
namespace {

/// Twice the smallest half-axis: the minimum of the support function, which both bodies attain there.
constexpr double kGap = -1;

void add_identical(std::vector<HardCase>& cases) {
  const auto add = [&](const std::string& what, const Body& body, double gap) {
    cases.push_back(pair("concentric: identical " + what, "no centre line; all points of the sum are pairs of opposite ones", body,
                         body, {}, gap));
  };
  add("spheres", ellipsoid(Vector3::Constant(0.5)), -1);
  add("ellipsoids", ellipsoid(kLengths), kGap);
  for (const auto& [delta, epsilon] : {std::pair{4., 4.}, {8., 20.}, {50., 2.}, {200., 200.}, {1000., 1000.}}) {
    add("superellipsoids " + text(delta) + ", " + text(epsilon), superellipsoid(kLengths, delta, epsilon), kGap);
  }
  // Below exponent 2 the nearest planes are tilted towards (1, 1, 1): tests/data/README.md.
  for (const double exponent : {1.01, 1.3, 1.9}) {
    add("superballs " + text(exponent), superball(0.7, exponent), -1.4 * std::pow(3, 0.5 - 1 / exponent));
  }
}

void add_nearly_concentric(std::vector<HardCase>& cases) {
  const std::string reason = "the centre line has a direction, but it is noise: far shorter than the bodies";
  for (const double offset : {1e-300, 1e-100, 1e-16, 1e-12, 1e-8, 1e-4}) {
    const Pose pose = at({0, 0, offset});
    const double gap = kGap + offset;  // along z, on the near side of both
    cases.push_back(pair("nearly concentric: ellipsoids " + text(offset) + " m apart", reason, ellipsoid(kLengths),
                         ellipsoid(kLengths), pose, gap));
    cases.push_back(pair("nearly concentric: boxy " + text(offset) + " m apart", reason, superellipsoid(kLengths, 20, 20),
                         superellipsoid(kLengths, 20, 20), pose, gap));
  }
  for (const double offset : {1e-16, 1e-6}) {
    cases.push_back(pair("nearly concentric: octahedral " + text(offset) + " m apart, askew", reason, superball(0.7, 1.1),
                         superball(0.5, 1.1), at(offset * Vector3(1, 2, -3), askew())));
  }
}

void add_turned(std::vector<HardCase>& cases) {
  const auto add = [&](const std::string& what, const Matrix3& rotation) {
    cases.push_back(pair("concentric: boxy, " + what, "two ways out, up and down, are equally short",
                         superellipsoid(kLengths, 20, 20), superellipsoid(kLengths, 20, 20), at(Vector3::Zero(), rotation), kGap));
  };
  add("turned by a quarter about z", turned(Vector3::UnitZ(), kQuarterTurn));
  add("turned by 45 degrees about z", turned(Vector3::UnitZ(), kEighthTurn));
  cases.push_back(pair("concentric: spheres of 1 and 0.5 m", "every normal is a maximum: the curvature of the gap function is 0",
                       ellipsoid(Vector3::Ones()), ellipsoid(Vector3::Constant(0.5)), {}, -1.5));
  cases.push_back(pair("concentric: a sphere in a spheroid", "every normal on the equator is a maximum", ellipsoid({1, 1, 3}),
                       ellipsoid(Vector3::Constant(0.25)), {}, -1.25));
  cases.push_back(pair("concentric: crossed needles", "every other way out is a hundred times as long", ellipsoid({1, 0.01, 0.01}),
                       ellipsoid({0.01, 1, 0.01}), {}, -0.02));
}

/// Homothetic aligned bodies touch by a closed form: tests/data/README.md.
void add_homothetic(std::vector<HardCase>& cases) {
  for (const double exponent : {1.05, 30.}) {
    for (const Vector3& direction : {Vector3(1, 1, 0), Vector3(1, 1, 1), Vector3(3, -2, 1)}) {
      const double size = std::pow(direction.array().abs().pow(exponent).sum(), 1 / exponent);
      const Vector3 place = direction * (0.75 / size);
      cases.push_back(pair("aligned: touching superballs " + text(exponent) + " towards (" + text(direction.x()) + ", " +
                               text(direction.y()) + ", " + text(direction.z()) + ")",
                           "parallel faces, edges or corners meet, and the gap is zero", superball(0.5, exponent),
                           superball(0.25, exponent), at(place), 0));
    }
  }
}

}  // namespace

std::vector<HardCase> concentric_cases() {
  std::vector<HardCase> cases;
  add_identical(cases);
  add_nearly_concentric(cases);
  add_turned(cases);
  add_homothetic(cases);
  return cases;
}

}  // namespace supernormal::samples
