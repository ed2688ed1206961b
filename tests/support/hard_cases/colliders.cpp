// Bodies with exact faces and edges: all points of a face share one normal, all normals of a vertex share one point.
#include <cmath>

#include "support/hard_cases/builders.hpp"

namespace supernormal::samples {
namespace {

const Vector3 kHalf(0.5, 0.375, 0.25);  // m

struct Smooth {
  const char* name;
  Body body;
};

std::vector<Smooth> smooth_bodies() {
  return {{"an ellipsoid", ellipsoid(kHalf)},
          {"a boxy body (60)", superellipsoid(kHalf, 60, 60)},
          {"an octahedral body (1.05)", superellipsoid(kHalf, 1.05, 1.05)}};
}

/// A flat triangle in the plane z = 0; the origin is inside.
Body triangle() { return polytope({{-0.75, -0.5, 0}, {1, -0.5, 0}, {0.25, 1, 0}}); }

void add_on_faces(std::vector<HardCase>& cases, const Smooth& smooth) {
  const auto add = [&](const std::string& what, const std::string& reason, const Body& collider, double height) {
    for (const double gap : {0.0625, 0., -0.0625}) {
      cases.push_back(pair("colliders: " + std::string(smooth.name) + " above " + what + ", gap " + text(gap), reason, collider,
                           smooth.body, at({0.125, 0, height + gap}), gap));
    }
  };
  const std::string face = "the normal is that of the face exactly, where the support function has a kink";
  add("a box", face, box({1, 1, 0.5}), 0.75);
  add("a cylinder", face, cylinder(1, 0.5), 0.75);
  add("a triangle", "a body without a thickness: half of its extents are zero", triangle(), 0.25);
}

void add_on_edges(std::vector<HardCase>& cases, const Smooth& smooth) {
  const std::string reason = "a fan of normals shares an edge or a corner";
  const auto add = [&](const std::string& what, const Body& collider, const Vector3& n) {
    for (const double gap : {0.0625, -0.015625}) {
      cases.push_back(on_normal("colliders: " + std::string(smooth.name) + " at " + what + ", gap " + text(gap), reason, collider,
                                n, smooth.body, askew(), gap));
    }
  };
  add("a box's edge", box({1, 1, 0.5}), {0, 1, 2});
  add("a box's corner", box({1, 1, 0.5}), {1, 1, 2});
  add("a capsule's side", capsule(0.25, 1), {1, 2, 0});
  add("a cylinder's rim", cylinder(1, 0.5), {1, 2, 2});
  add("a triangle's edge", triangle(), {0, -1, 0.25});
}

void add_of_two(std::vector<HardCase>& cases) {
  const std::string reason = "both bodies have faces: the ascent knows those of one";
  const Body cube = box(Vector3::Constant(0.5));
  cases.push_back(pair("colliders: box on box, flush", reason, cube, cube, at({0, 0, 1.0625}), 0.0625));
  cases.push_back(pair("colliders: box in box, concentric", reason, cube, cube, {}, -1));
  for (const double tilt : {1e-16, 1e-8, 1e-2}) {
    const double height = 0.5 * (std::cos(tilt) + std::sin(tilt));  // distance of the lowest corners below the upper one's centre
    cases.push_back(pair("colliders: box on box, tilted by " + text(tilt), reason, box({1, 1, 0.5}), cube,
                         at({0.0625, 0, 1.125}, turned(Vector3::UnitX(), tilt)), 0.625 - height));
  }
}

}  // namespace

std::vector<HardCase> collider_cases() {
  std::vector<HardCase> cases;
  for (const Smooth& smooth : smooth_bodies()) {
    add_on_faces(cases, smooth);
    add_on_edges(cases, smooth);
  }
  add_of_two(cases);
  return cases;
}

}  // namespace supernormal::samples
