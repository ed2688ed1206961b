// Bodies far from the origin; normals and centre lines on and near the coordinate planes; unfavourable starts.
#include "support/hard_cases/builders.hpp"

namespace supernormal::samples {
namespace {

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
