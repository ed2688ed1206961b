// Cases that are hard by the place of the bodies.
#include <cmath>

#include "support/hard_cases/builders.hpp"

namespace supernormal::samples {
namespace {

// Concentric, identical, aligned bodies. The centre line has no direction, or every direction is equally good.

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

// Deep overlap up to total containment. There are several separating translations, and the shortest may be far from the centre
// line.

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

// Gaps of zero, or of one unit in the last place above or below.

constexpr double kUlp = 0x1p-53;  // m; 1.1e-16: one unit in the last place of the distance below

struct OneExponent {
  const char* name;
  double exponent;
};

constexpr OneExponent kOneExponents[] = {{"octahedral (1.02)", 1.02}, {"ellipsoids", 2}, {"rounded (4)", 4}, {"boxy (200)", 200}};

// Bodies far from the origin; normals and centre lines on and near the coordinate planes; unfavourable starts.

struct FarFamily {
  const char* name;
  double delta, epsilon;
};

constexpr FarFamily kFarFamilies[] = {{"ellipsoids", 2, 2}, {"boxy (20)", 20, 20}, {"octahedral (1.1)", 1.1, 1.1}};

Body body_of(const FarFamily& family) { return superellipsoid(kDyadicLengths, family.delta, family.epsilon); }

void add_far_away(std::vector<HardCase>& cases, const FarFamily& family) {
  const Vector3 place(1e6, -1e6, 1e6);
  const auto add = [&](const std::string& what, HardCase one) {
    one.name = "1e6 m from the origin: " + std::string(family.name) + ", " + what;
    one.reason = "coordinates have ten digits left: the gap has to come from their difference";
    for (Pose* pose : {&one.pose1, &one.pose2}) pose->position += place;
    cases.push_back(std::move(one));
  };
  // The coordinates of the centres and their sums are exact.
  const Body body = body_of(family);
  add("apart", pair("", "", body, body, at({0, 0, 1.0625}), 0.0625));
  add("touching", pair("", "", body, body, at({0, 0, 1}), 0));
  // Octahedra are separated sideways, which is shorter.
  const std::optional<double> known = family.delta < 2 ? std::nullopt : std::optional(-0.0625);
  add("overlapping", pair("", "", body, body, at({0, 0, 0.9375}), known));
  add("overlapping, askew", pair("", "", body, body, at({0.75, 0.5, 0.25}, askew())));
}

void add_beside_planes(std::vector<HardCase>& cases, const FarFamily& family) {
  const Body body = body_of(family);
  const auto add = [&](const std::string& what, const Vector3& place, std::optional<double> gap) {
    cases.push_back(pair("coordinate planes: " + std::string(family.name) + ", centre line " + what,
                         "a component of the normal is zero or so small that its powers and squares vanish", body, body, at(place),
                         gap));
  };
  for (const double tiny : {0., 1e-300, 5e-324}) {
    const std::string distance = tiny == 0 ? "on" : text(tiny) + " m beside";
    add(distance + " the z-axis", {tiny, -tiny, 1.25}, 0.25);
    add(distance + " the x-axis, overlapping", {1.875, tiny, tiny}, {});
    add(distance + " the xz-plane", {1.5, -tiny, 0.75}, {});
  }
}

/// For separate bodies, every start leads to the one maximum.
void add_bad_starts(std::vector<HardCase>& cases, const FarFamily& family) {
  const Body body = body_of(family);
  const auto add = [&](const std::string& what, const Vector3& first_normal) {
    HardCase one = on_normal("first normal: " + std::string(family.name) + ", " + what, "the start is as bad as it can be", body,
                             Vector3(0.3, 0.2, 1), body, askew(), 0.125);
    one.first_normal = first_normal.normalized();
    cases.push_back(std::move(one));
  };
  add("opposite", -Vector3(0.3, 0.2, 1));
  add("on an axis", Vector3::UnitX());
  add("1e-300 beside an axis", {-1, 1e-300, 0});
  add("1e-300 beside a plane", {-1, 1, 1e-300});
  add("in a plane", {0, -1, -1});
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

std::vector<HardCase> place_cases() {
  std::vector<HardCase> cases;
  for (const FarFamily& family : kFarFamilies) {
    add_far_away(cases, family);
    add_beside_planes(cases, family);
    add_bad_starts(cases, family);
  }
  return cases;
}

}  // namespace supernormal::samples
