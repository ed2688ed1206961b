// Searches for a normal with a larger gap.
#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <vector>

#include "invariants.hpp"
#include "supernormal/proximity/gap_function.hpp"

namespace supernormal::samples {
namespace {

// The neighbourhood: rings around the normal, from rounding up to an angle of about 1.
constexpr int kDirections = 8, kRings = 25;
constexpr double kFirstAngle = 1e-15, kNextRing = 4;

constexpr int kRandomDirections = 50;

/// The box with the half-extents and the octahedron inscribed in it.
struct Features {
  std::vector<Vector3> face_normals;
  std::vector<Vector3> edges;  // directions

  explicit Features(const Vector3& half) {
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 along = half[axis] * Vector3::Unit(axis);
      const Vector3 next = half[(axis + 1) % 3] * Vector3::Unit((axis + 1) % 3);
      face_normals.emplace_back(Vector3::Unit(axis));
      edges.insert(edges.end(), {Vector3::Unit(axis), along + next, along - next});
    }
    for (const double x : {-1., 1.}) {
      for (const double y : {-1., 1.})
        face_normals.emplace_back(x * half.y() * half.z(), y * half.x() * half.z(), half.x() * half.y());
    }
  }
};

/// Searches for normals that are higher than the answer allows.
class Probe {
 public:
  Probe(const HardCase& one, const Settings& settings, const Proximity& answer)
      : gap_(*one.shape1, one.pose1, *one.shape2, one.pose2),
        n_((one.pose1.rotation.transpose() * answer.normal).normalized()),
        ceiling_(ceiling_of(one, settings, answer) + 2 * gap_.rounding()) {}

  void look_at_neighbourhood(Violations& out) {
    const Vector3 tangent1 = n_.unitOrthogonal(), tangent2 = n_.cross(tangent1);
    for (int k = 0; k < kDirections; ++k) {
      const double turn = 2 * 3.14159265358979 * (k + 0.25) / kDirections;
      const Vector3 tangent = std::cos(turn) * tangent1 + std::sin(turn) * tangent2;
      double angle = kFirstAngle;
      for (int ring = 0; ring < kRings; ++ring, angle *= kNextRing) look_at_unit((n_ + angle * tangent).normalized(), out);
    }
  }

  void look_at(const Vector3& direction, Violations& out) {
    const double length = direction.norm();
    if (!(length > 0)) return;
    for (const double sign : {-1., 1.}) look_at_unit(direction * (sign / length), out);
  }

  /// Faces, edges and pairs of edges of the boxes and octahedra that the bodies may resemble.
  void look_at_features(const HardCase& one, Violations& out) {
    const Features features1(one.shape1->half_extents()), features2(one.shape2->half_extents());
    for (const Vector3& normal : features1.face_normals) look_at(normal, out);
    for (const Vector3& normal : features2.face_normals) look_at(gap_.rotation() * normal, out);
    for (const Vector3& edge1 : features1.edges) {
      for (const Vector3& edge2 : features2.edges) look_at(edge1.cross(gap_.rotation() * edge2), out);
    }
    for (int axis = 0; axis < 3; ++axis) look_at(Vector3::Unit(axis), out);
    look_at(gap_.offset().normalized(), out);
  }

 private:
  void look_at_unit(const Vector3& n, Violations& out) {
    GapJet jet;
    gap_.evaluate(n, Order::Value, jet);
    if (jet.s <= ceiling_) return;
    out.push_back("not the global maximum: " + exact_text(jet.s - ceiling_) + " m more than it may be at n " + exact_text(n));
  }

  GapFunction gap_;
  Vector3 n_;
  double ceiling_;  // m; upper bound of every value
};

}  // namespace

Violations check_maximum(const HardCase& one, const Settings& settings, const Proximity& answer, std::uint64_t seed) {
  Violations out;
  if (answer.status == Status::Apart) return out;  // stopped early: a bound, not a maximum
  Probe probe(one, settings, answer);
  probe.look_at_neighbourhood(out);
  probe.look_at_features(one, out);
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> gauss;
  for (int k = 0; k < kRandomDirections; ++k) probe.look_at(Vector3{gauss(engine), gauss(engine), gauss(engine)}, out);
  return out;
}

}  // namespace supernormal::samples
