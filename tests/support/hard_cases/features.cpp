// Cases that are hard by faces, edges and vertices that meet.
#include <cmath>

#include "support/hard_cases/builders.hpp"

namespace supernormal::samples {
namespace {

// Face to face. The boundary point changes steeply with the normal, and the witness points jump by the size of the face.

const Vector3 kLower(1, 0.8, 0.5), kUpper(0.7, 0.6, 0.25);  // m; half-axes
constexpr double kFacesMeet = 0.75;                         // m; height of the upper body's centre

void add_tilted(std::vector<HardCase>& cases, const std::string& what, double exponent, double gap) {
  for (const double tilt : {0., 1e-300, 1e-16, 1e-12, 1e-8, 1e-6, 1e-4, 1e-2}) {
    const Matrix3 rotation = turned(Vector3(2, 1, 0), tilt);
    const std::optional<double> known = tilt == 0 ? std::optional(gap) : std::nullopt;
    cases.push_back(pair("face to face: " + what + ", tilted by " + text(tilt),
                         tilt == 0
                             ? "every point of two faces has the common normal"
                             : "the faces meet at a corner, but only just: a tiny turn moves the witness points across the face",
                         superellipsoid(kLower, exponent, exponent), superellipsoid(kUpper, exponent, exponent),
                         at({0.1, -0.05, kFacesMeet + gap}, rotation), known));
  }
}

// Edges and vertices: a tiny radius of curvature, so that a cone of normals shares nearly one point.

struct Meeting {
  const char* what;
  Vector3 n;
  Matrix3 rotation2;  // turns the edge or vertex towards the other body
};

/// Pairs of bodies like boxes: edges and vertices lie diagonally.
std::vector<Meeting> boxy_meetings() {
  const Vector3 edge(0, 1, 1), corner(1, 1, 1);
  return {
      {"edge to parallel edge", edge, Matrix3::Identity()},
      {"edge across edge", edge, turned(edge, kQuarterTurn)},
      {"edge across edge at 1e-6", edge, turned(edge, 1e-6)},
      {"corner to corner", corner, Matrix3::Identity()},
      {"corner to corner, askew", corner, turned(corner, 0.7)},
      {"corner to face", Vector3::UnitZ(), turned(Vector3(1, -1, 0), 0.9)},
      {"edge to face", Vector3::UnitZ(), turned(Vector3(1, 0, 0), kEighthTurn)},
  };
}

/// Pairs of bodies like octahedra: vertices lie on the axes, edges between two of them.
std::vector<Meeting> octahedral_meetings() {
  const Vector3 edge(0.8, 1, 0);
  return {
      {"vertex to vertex", Vector3::UnitZ(), Matrix3::Identity()},
      {"vertex to vertex, askew", Vector3(0.1, 0.05, 1), askew()},
      {"vertex to face", Vector3(1, 1.25, 2), turned(Vector3(1.25, -1, 0), 0.97)},
      {"edge to parallel edge", edge, Matrix3::Identity()},
      {"edge across edge", edge, turned(edge, kQuarterTurn)},
  };
}

void add(std::vector<HardCase>& cases, const std::string& theme, const Meeting& meeting, const Body& body) {
  const std::string reason = "a cone of normals shares nearly one point: curvature says nothing beyond it";
  for (const double gap : {0.125, 0., -0.03125}) {
    const std::string name = theme + meeting.what + (gap > 0 ? ", apart" : gap == 0 ? ", touching" : ", overlapping");
    cases.push_back(on_normal(name, reason, body, meeting.n, body, meeting.rotation2, gap));
  }
}

// Bodies with exact faces and edges: all points of a face share one normal, all normals of a vertex share one point.

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

std::vector<HardCase> face_cases() {
  std::vector<HardCase> cases;
  add_tilted(cases, "boxy (20) apart", 20, 0.0625);
  add_tilted(cases, "boxy (20) overlapping", 20, -0.015625);
  add_tilted(cases, "nearly boxes (1000) apart", 1000, 0.0625);
  add_tilted(cases, "nearly boxes (1000) overlapping", 1000, -0.015625);
  const std::string reason = "the faces overlap by little: the centre line points past both";
  for (const double exponent : {8., 100., 1000.}) {
    cases.push_back(pair("face to face: boxy " + text(exponent) + ", the upper one shifted to the lower one's rim", reason,
                         superellipsoid(kLower, exponent, exponent), superellipsoid(kUpper, exponent, exponent),
                         at({1.65, 0, kFacesMeet - 0.015625})));
  }
  cases.push_back(pair("face to face: cylinder-like on cylinder-like", "flat caps on round bodies: delta 2, epsilon 200",
                       superellipsoid(Vector3(1, 1, 0.5), 2, 200), superellipsoid(Vector3(0.5, 0.5, 0.25), 2, 200),
                       at({0.25, 0.25, 0.6875}), -0.0625));
  cases.push_back(pair("face to face: turned by 45 degrees, corner over edge",
                       "a corner of the face hangs over the lower one's edge", superellipsoid(kLower, 50, 50),
                       superellipsoid(kLower, 50, 50), at({0.9, 0.7, 0.98}, turned(Vector3::UnitZ(), kEighthTurn))));
  return cases;
}

std::vector<HardCase> edge_and_vertex_cases() {
  std::vector<HardCase> cases;
  for (const Meeting& meeting : boxy_meetings()) add(cases, "boxy (60): ", meeting, superellipsoid(kLengths, 60, 60));
  for (const Meeting& meeting : octahedral_meetings()) {
    add(cases, "octahedral (1.05): ", meeting, superellipsoid(kLengths, 1.05, 1.05));
  }
  return cases;
}

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
