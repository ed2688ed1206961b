// Edges and vertices: a tiny radius of curvature, so that a cone of normals shares nearly one point.
#include "support/hard_cases/builders.hpp"

namespace supernormal::samples {
namespace {

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

}  // namespace

std::vector<HardCase> edge_and_vertex_cases() {
  std::vector<HardCase> cases;
  for (const Meeting& meeting : boxy_meetings()) add(cases, "boxy (60): ", meeting, superellipsoid(kLengths, 60, 60));
  for (const Meeting& meeting : octahedral_meetings()) {
    add(cases, "octahedral (1.05): ", meeting, superellipsoid(kLengths, 1.05, 1.05));
  }
  return cases;
}

}  // namespace supernormal::samples
