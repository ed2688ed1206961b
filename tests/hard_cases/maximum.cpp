// A search for a normal with a larger gap.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "invariants.hpp"
#include "supernormal/proximity/gap_function.hpp"

namespace supernormal::samples {
namespace {

constexpr int kWalks = 8;
constexpr double kFirstAngle = 1e-15;
constexpr int kSteps = 25;  // up to an angle of about 1
constexpr int kRandomDirections = 50;

// A valley is searched at so many normals, and counts if it is so many times as deep as s is seen to jitter between normals that
// differ by rounding, at each end. A jitter of 0 is chance, and counts as one unit in the last place. It also counts if the
// slopes show it.
constexpr int kFineSteps = 64;
constexpr double kJitters = 4;
constexpr double kRoundingAngle = 1e-15;

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

/// Searches for normals that are higher than the answer's.
class Probe {
 public:
  Probe(const HardCase& one, const Settings& settings, const Proximity& answer)
      : gap_(*one.shape1, one.pose1, *one.shape2, one.pose2),
        n_((one.pose1.rotation.transpose() * answer.normal).normalized()),
        rounding_(2 * gap_.rounding()),
        floor_(answer.gap - rounding_),
        local_ceiling_(answer.gap + answer.error + rounding_),
        global_ceiling_(answer.gap + error_of(one, settings, answer) + rounding_) {}

  const Vector3& normal() const { return n_; }

  /// Walks along a great circle for as long as it does not lead down: what is higher beyond a valley is another maximum.
  void walk(const Vector3& tangent, Violations& out) {
    double angle = kFirstAngle;
    for (int step = 0; step < kSteps; ++step, angle *= 4) {
      const Vector3 m = (n_ + angle * tangent).normalized();
      const double s = value(m);
      if (s < floor_) return;
      if (!(s <= local_ceiling_)) {
        if (std::isfinite(s) && crosses_valley(tangent, angle)) return;
        out.push_back("not a maximum: " + exact_text(s - local_ceiling_) + " m more than it may be at an angle of " +
                      exact_text(angle) + ", n " + exact_text(m));
        return;
      }
    }
  }

  void look_at(const Vector3& direction, Violations& out) {
    const double length = direction.norm();
    if (!(length > 0)) return;
    for (const double sign : {-1., 1.}) {
      const Vector3 m = direction * (sign / length);
      const double s = value(m);
      if (!(s <= global_ceiling_)) {
        out.push_back("not the global maximum, as claimed: " + exact_text(s - global_ceiling_) + " m more than it may be at n " +
                      exact_text(m));
      }
    }
  }

  /// Tries faces, edges and pairs of edges of the boxes and octahedra that the bodies may resemble.
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
  double value(const Vector3& n) {
    GapJet jet;
    gap_.evaluate(n, Order::Value, jet);
    return jet.s;
  }

  bool crosses_valley(const Vector3& tangent, double angle) { return values_fall(tangent, angle) || slopes_fall(tangent, angle); }

  /// Whether s falls on the path by more than its rounding is, which may be less than its rounding may be at worst.
  bool values_fall(const Vector3& tangent, double angle) {
    Vector3 bottom = n_;
    double lowest = value(n_);
    const double here = lowest - kJitters * jitter(n_);
    for (int k = 1; k < kFineSteps; ++k) {
      const Vector3 m = (n_ + (angle * k / kFineSteps) * tangent).normalized();
      const double s = value(m);
      if (s >= lowest) continue;
      lowest = s;
      bottom = m;
    }
    return lowest < here - kJitters * jitter(bottom);
  }

  /// The same by the sum of the slopes, whose rounding counts by the angle only: on short paths it shows valleys that are far
  /// shallower than the rounding of s.
  bool slopes_fall(const Vector3& tangent, double angle) {
    const double step = angle / kFineSteps;
    double rise = 0;
    for (int k = 0; k < kFineSteps; ++k) {
      const double turn = (k + 0.5) * step;
      rise += step * slope((n_ + turn * tangent).normalized(), tangent - turn * n_);
      if (rise < -gap_.rounding() * angle) return true;
    }
    return false;
  }

  /// The slope of s at the unit normal n, along a direction from there.
  double slope(const Vector3& n, const Vector3& way) {
    GapJet jet;
    gap_.evaluate(n, Order::Point, jet);
    return jet.d.dot(way.normalized());
  }

  double jitter(const Vector3& n) {
    const Vector3 tangent1 = n.unitOrthogonal(), tangent2 = n.cross(tangent1);
    const double s = value(n);
    double most = std::numeric_limits<double>::epsilon() * gap_.length_unit();
    for (const Vector3& tangent : {tangent1, tangent2}) {
      for (const double sign : {-1., 1.}) most = std::max(most, std::abs(value(n + sign * kRoundingAngle * tangent) - s));
    }
    return most;
  }

  GapFunction gap_;
  Vector3 n_;
  double rounding_, floor_, local_ceiling_, global_ceiling_;
};

}  // namespace

Violations check_maximum(const HardCase& one, const Settings& settings, const Proximity& answer, std::uint64_t seed) {
  Violations out;
  if (answer.status == Status::Apart) return out;  // it stopped early: this is a bound, not a maximum
  Probe probe(one, settings, answer);
  const Vector3 tangent1 = probe.normal().unitOrthogonal(), tangent2 = probe.normal().cross(tangent1);
  for (int k = 0; k < kWalks && out.empty(); ++k) {
    const double turn = 2 * 3.14159265358979 * (k + 0.25) / kWalks;
    probe.walk(std::cos(turn) * tangent1 + std::sin(turn) * tangent2, out);
  }
  if (!answer.is_global) return out;
  probe.look_at_features(one, out);
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> gauss;
  for (int k = 0; k < kRandomDirections; ++k) probe.look_at(Vector3{gauss(engine), gauss(engine), gauss(engine)}, out);
  return out;
}

}  // namespace supernormal::samples
