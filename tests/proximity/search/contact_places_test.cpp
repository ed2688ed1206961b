// Where contacts act: within the overlap of both bodies, whatever these are.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "proximity/search/contact_point.hpp"
#include "supernormal/contact/contact_manifold.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/callback_shape.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/shapes/superovoid.hpp"
#include "support/draw.hpp"
#include "support/hard_cases/body.hpp"
#include "support/reference_pairs.hpp"
#include "support/rotation_between.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;
using samples::Body;
using samples::superellipsoid;

namespace {

/// A kind of body, of any size.
struct Kind {
  const char* name;
  std::function<std::shared_ptr<const Shape>(double size)> make;
};

std::shared_ptr<const Shape> user_with_hessian(const std::shared_ptr<const Shape>& shape) {
  return std::make_shared<CallbackShape>([=](const Vector3& n) { return shape->support(n); },
                                         [=](const Vector3& n) { return shape->point(n); },
                                         [=](const Vector3& n) { return shape->jet(n).H; });
}

/// A double cone.
std::shared_ptr<const Shape> user_cones(double radius, double height) {
  const auto point = [=](const Vector3& n) {
    const double across = std::hypot(n.x(), n.y());
    if (height * std::abs(n.z()) >= radius * across) return Vector3(0, 0, std::copysign(height, n.z()));
    return Vector3(n.x() / across * radius, n.y() / across * radius, 0);
  };
  return std::make_shared<CallbackShape>([=](const Vector3& n) { return n.dot(point(n)); }, point);
}

/// An octahedron with its vertices cut off.
Body hull() {
  std::vector<Vector3> corners;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double end : {-1, 1}) {
      for (const double x : {-0.3, 0.3}) {
        for (const double y : {-0.3, 0.3}) {
          Vector3 corner;
          corner[axis] = end;
          corner[(axis + 1) % 3] = x;
          corner[(axis + 2) % 3] = y;
          corners.emplace_back(corner.cwiseProduct(Vector3(1, 0.8, 0.6)));
        }
      }
    }
  }
  return samples::polytope(std::move(corners));
}

/// A body of size 1 in any size.
auto of(const Body& body) {
  return [body](double size) { return samples::make_shape(body.scaled(size)); };
}

const std::vector<Kind>& kinds() {
  static const Body pebble = samples::ellipsoid({0.2, 0.4, 1}), brick = superellipsoid({1, 0.7, 0.3}, 60, 60);
  static const std::vector<Kind> all = {
      {"ellipsoid", of(pebble)},
      {"superellipsoid 4/3", of(superellipsoid({1, 0.7, 0.4}, 4, 3))},
      {"superellipsoid 8/8", of(superellipsoid({1, 0.7, 0.3}, 8, 8))},
      {"brick 60/60", of(superellipsoid({1, 1, 0.1}, 60, 60))},
      {"brick 1000/1000", of(superellipsoid({1, 0.6, 0.4}, 1000, 1000))},
      {"can 2/60", of(superellipsoid({0.3, 0.3, 1}, 2, 60))},
      {"plate 5/100", of(superellipsoid({1, 0.5, 0.2}, 5, 100))},
      {"star 1.2/1.3", of(superellipsoid({1, 0.5, 0.7}, 1.2, 1.3))},
      {"ovoid", of(samples::superovoid({0.5, 0.5, 1}, 2, 2.5, 0.3, 0.3))},
      {"ovoid 20/20", of(samples::superovoid({0.5, 0.7, 1}, 20, 20, 0.1, 0.1))},
      {"rounded brick", of(superellipsoid({0.9, 0.5, 0.3}, 60, 60).rounded(0.1))},
      {"rounded box", of(samples::box({0.9, 0.5, 0.3}).rounded(0.1))},
      {"capsule", of(samples::capsule(0.3, 0.7))},
      {"box", of(samples::box({1, 0.6, 0.2}))},
      {"cylinder", of(samples::cylinder(0.4, 1))},
      {"sphere", [](double size) { return std::make_shared<Sphere>(size); }},
      {"hull", of(hull())},
      {"user brick with Hessian", [](double size) { return user_with_hessian(samples::make_shape(brick.scaled(size))); }},
      {"user pebble", of(pebble.by_callbacks())},
      {"user brick", of(brick.by_callbacks())},
      {"user slab", of(samples::box({1, 1, 0.1}).by_callbacks())},
      {"user cylinder", of(samples::cylinder(0.5, 1).by_callbacks())},
      {"user capsule", of(samples::capsule(0.3, 0.7).by_callbacks())},
      {"user cones", [](double size) { return user_cones(0.5 * size, size); }},
  };
  return all;
}

/// Sizes of the larger body, in sizes of the smaller one.
constexpr std::array<double, 5> kRatios = {1, 3, 30, 300, 5000};

/// Gaps that the bodies are placed at, in units of the smallest half-extent.
constexpr std::array<double, 9> kGaps = {1e-3, 0, -1e-6, -1e-3, -2e-2, -0.2, -0.5, -1, -1.8};

/// How the smaller body lies on the larger one.
enum class Way {
  FaceOnFace,         ///< exactly
  LeaningFaceOnFace,  ///< by 1e-12 to 1e-2
  OnFace,             ///< in any orientation
  Anywhere,           ///< with a boundary point of each at the same place
};
constexpr std::array kWays = {Way::FaceOnFace, Way::LeaningFaceOnFace, Way::OnFace, Way::Anywhere};

constexpr std::array kMaxContacts = {1, 2, 3, 4, 8};

struct PlacedPair {
  std::shared_ptr<const Shape> large, small;
  Pose pose;    // of the small one; the large one is at rest in the origin
  double unit;  // m; the smallest half-extent

  Proximity query() const { return find_proximity(*large, {}, *small, pose); }
};

class Placing : private test::Draw {
 public:
  using Draw::Draw;

  PlacedPair draw(std::shared_ptr<const Shape> large, std::shared_ptr<const Shape> small, double relative_gap, Way way) {
    PlacedPair pair{std::move(large), std::move(small), {}, 0};
    pair.unit = std::min(pair.large->half_extents().minCoeff(), pair.small->half_extents().minCoeff());
    const Vector3 up = way == Way::Anywhere ? direction() : face_normal();
    const bool is_face = way == Way::FaceOnFace || way == Way::LeaningFaceOnFace;
    const Vector3 down = is_face ? face_normal() : direction();
    const double lean = way == Way::LeaningFaceOnFace ? std::pow(10.0, uniform(-12, -2)) : 0;
    const Vector3 against = (-up + lean * direction()).normalized();
    const Eigen::AngleAxisd about(uniform(0, 6.3), up);
    pair.pose.rotation = (about * test::rotation_between(down, against)).normalized().toRotationMatrix();
    // A place on the face, off its middle: the smaller body may hang over its edge.
    const Vector3 off = uniform(0.1, 0.95) * pair.large->half_extents().cwiseProduct(direction());
    const Vector3 on_face = pair.large->support(up) * up + off - off.dot(up) * up;
    const Vector3 low = pair.pose.rotation * pair.small->point(-(pair.pose.rotation.transpose() * up));
    const double gap = relative_gap * pair.unit;
    pair.pose.position =
        way == Way::Anywhere ? Vector3(pair.large->point(up) - low + gap * up) : Vector3(on_face - low.dot(up) * up + gap * up);
    return pair;
  }

  /// Bodies of every class with half-extents from 0.1 to 1, placed so that they overlap, from a touch to concentric.
  PlacedPair draw_slender() {
    PlacedPair pair{slender(), slender(), {}, 0};
    pair.unit = std::min(pair.large->half_extents().minCoeff(), pair.small->half_extents().minCoeff());
    const Vector3 up = direction();
    pair.pose.rotation = test::rotation_between(direction(), up).toRotationMatrix();
    const Vector3 touching = pair.large->point(up) - pair.pose.rotation * pair.small->point(-(pair.pose.rotation.transpose() * up));
    pair.pose.position = (1 - std::pow(10, uniform(-4, 0))) * touching;
    return pair;
  }

 private:
  std::shared_ptr<const Shape> slender() { return samples::make_shape(slender_body()); }
  Body slender_body() {
    const Vector3 half = log_within(0.1, 1);
    const double delta = 1.02 + std::pow(10, uniform(-2, 2)), epsilon = 1.02 + std::pow(10, uniform(-2, 2));
    const Body any = superellipsoid(half, delta, epsilon);
    const std::vector<Body> bodies = {samples::ellipsoid(half),
                                      samples::box(half),
                                      samples::capsule(half.x(), half.y()),
                                      samples::cylinder(half.x(), half.y()),
                                      samples::superovoid(half, delta, 3, 0.5, 0.5),
                                      any.rounded(0.3 * half.x()),
                                      any.by_callbacks(),
                                      any};
    return bodies[static_cast<std::size_t>(uniform(0, 8))];
  }

  Vector3 face_normal() {
    const auto axis = static_cast<Eigen::Index>(uniform(0, 3));
    return Vector3::Unit(axis) * (uniform(0, 1) < 0.5 ? -1 : 1);
  }
};

/// m; how far the point is outside of the body: no less than this, since every value of the gap function is a lower bound.
double outside(const Shape& shape, const Pose& pose, const Vector3& point) {
  return find_proximity(shape, pose, Sphere(0), {point, Matrix3::Identity()}).gap;
}

/// How far a point is outside of either body, or beyond halfway in the gap, in units of the smallest half-extent.
double excess(const PlacedPair& pair, const Proximity& proximity, const Vector3& point) {
  const double most_outside = std::max(outside(*pair.large, {}, point), outside(*pair.small, pair.pose, point));
  return (most_outside - std::max(0.0, 0.5 * proximity.gap)) / pair.unit;
}

/// The largest excess of the contacts that a program gets.
double largest_excess(const PlacedPair& pair, const Proximity& proximity, int max_contacts) {
  const ContactManifold found = find_contact_manifold(*pair.large, {}, *pair.small, pair.pose, proximity);
  const ContactManifold manifold = reduced_to(found, max_contacts);
  double largest = -std::numeric_limits<double>::infinity();
  if (manifold.corner_count == 0) largest = excess(pair, proximity, manifold.deepest.contact);
  for (int k = 0; k < manifold.corner_count; ++k) {
    largest = std::max(largest, excess(pair, proximity, manifold.corners[static_cast<std::size_t>(k)].point));
  }
  return largest;
}

/// Of the pairs of kinds, sizes, gaps and ways one is asked about in so many; 1 at length. A prime number: all of each take part.
const int kStride = at_length() ? 1 : 41;

/// Asks about every pair of kinds, in every way; `check` is called with a pair, its answer and a name.
void for_all_pairs(unsigned seed, const auto& check) {
  Placing placing(seed);
  int count = 0;
  for (const Kind& one : kinds()) {
    for (const Kind& other : kinds()) {
      for (const double ratio : kRatios) {
        const std::shared_ptr<const Shape> large = one.make(ratio), small = other.make(1);
        for (const double gap : kGaps) {
          for (const Way way : kWays) {
            if (count++ % kStride != 0) continue;
            const PlacedPair pair = placing.draw(large, small, gap, way);
            check(pair, pair.query(), [&] {
              return std::string(one.name) + " and " + other.name + ", ratio " + std::to_string(ratio) + ", gap " +
                     std::to_string(gap) + ", way " + std::to_string(static_cast<int>(way));
            });
          }
        }
      }
    }
  }
}

// Of the smallest half-extent: below, hardly an answer does not converge.
constexpr double kShallow = 0.2;

// Of the smallest half-extent: the overlaps whose manifold points are asked for.
constexpr double kManifold = 0.03;

// Of the smallest half-extent.
constexpr double kTolerance = 1e-6;

/// How far outside of a body a contact may be, in units of the smallest half-extent. With max_contacts above 1 there are manifold
/// points. Both faces may be round there, and each leaves the plane by up to the reach: 0.07 units, or the depth if that is larger.
double largest_allowed(int max_contacts, double gap, double unit) {
  return max_contacts == 1 ? kTolerance : 2 * std::max(0.07, -gap / unit);
}

Pose at(const Vector3& position) { return {position, Matrix3::Identity()}; }

}  // namespace

TEST_CASE("all kinds of bodies and sizes: a contact acts within the overlap of both bodies") {
  int queries = 0, shallow = 0, unconverged = 0;
  for_all_pairs(3, [&](const PlacedPair& pair, const Proximity& out, const auto& name) {
    ++queries;
    const bool is_shallow = out.gap >= -kShallow * pair.unit;
    if (is_shallow) ++shallow;
    if (out.status != Status::Converged) {
      if (is_shallow) ++unconverged;
      return;
    }
    const double beside = excess(pair, out, out.contact);
    if (!(beside <= kTolerance)) FAIL_CHECK(name(), ": ", beside, " outside");
    for (const int max_contacts : kMaxContacts) {
      if (max_contacts > 1 && out.gap < -kManifold * pair.unit) continue;
      const double of_manifold = largest_excess(pair, out, max_contacts);
      if (!(of_manifold <= largest_allowed(max_contacts, out.gap, pair.unit)))
        FAIL_CHECK(name(), ", max_contacts ", max_contacts, ": ", of_manifold, " outside");
    }
  });
  CHECK(queries >= 24 * 24 * 5 * 9 * 4 / kStride);
  CHECK(shallow >= queries / 2);
  CHECK(unconverged <= shallow / 150);
}

TEST_CASE("slender bodies in any orientation, at any depth: a contact acts within the overlap of both bodies") {
  Placing placing(36);
  int deep = 0;
  for (int k = 0; k < draws(6000); ++k) {
    const PlacedPair pair = placing.draw_slender();
    const Proximity out = pair.query();
    if (out.status != Status::Converged) continue;
    if (out.gap < -0.1 * pair.unit) ++deep;
    const double beside = excess(pair, out, out.contact);
    if (!(beside <= kTolerance)) FAIL_CHECK("pair ", k, ", gap ", out.gap / pair.unit, ": ", beside, " outside");
  }
  CHECK(deep > draws(2500));
}

TEST_CASE("the place of a contact takes no evaluation where bodies are round") {
  // 60 pairs each of which take as many evaluations as their gap alone: Newton's, or an ascent against faces.
  Placing placing(5);
  const std::array<std::shared_ptr<const Shape>, 4> bodies = {std::make_shared<Ellipsoid>(Vector3(0.4, 0.6, 1)),
                                                              std::make_shared<Sphere>(0.5),
                                                              std::make_shared<Superellipsoid>(Vector3(1, 0.7, 0.4), 4, 3),
                                                              std::make_shared<Superovoid>(Vector3(0.5, 0.5, 1), 2, 2.5, 0.3, 0.3)};
  for (const auto& one : bodies) {
    for (const auto& other : bodies) {
      for (int k = 0; k < 60; ++k) {
        const PlacedPair pair = placing.draw(one, other, -1e-3, Way::Anywhere);
        const Proximity out = pair.query();
        GapFunction gap(*one, {}, *other, pair.pose);
        GapJet jet;
        gap.evaluate(out.normal, Order::Hessian, jet);
        contact_point(gap, jet, StoppingRule(gap, 1e-9 * gap.length_unit(), 1000));
        CHECK(gap.evaluations() == 1);
      }
    }
  }
}

TEST_CASE("a pebble on a slab: the contact is at the pebble, in either order and any frame, and does not jump") {
  const auto pebble = samples::make_shape(samples::ellipsoid({0.05, 0.1, 0.25}).by_callbacks());
  const Body box = samples::box({10, 10, 1});
  const std::array<std::shared_ptr<const Shape>, 3> slabs = {samples::make_shape(superellipsoid({10, 10, 1}, 60, 60)),
                                                             samples::make_shape(box.by_callbacks()), samples::make_shape(box)};
  const Matrix3 rotation = Eigen::AngleAxisd(0.9, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  const Pose frame{Vector3(5, -7, 3), Eigen::AngleAxisd(2.1, Vector3(3, -1, 2).normalized()).toRotationMatrix()};
  for (const auto& slab : slabs) {
    for (int step = 0; step < 100; ++step) {
      // Along a path over the slab, a hundredth of its width a step.
      const Vector3 low = rotation * pebble->point(-rotation.row(2).transpose());
      const Vector3 place(-9 + 0.18 * step, 8 - 0.15 * step, 1);
      const Pose pose{place - low - Vector3(0, 0, 0.001), rotation};
      const Pose moved{frame.rotation * pose.position + frame.position, frame.rotation * rotation};
      const Vector3 expected = place - Vector3(0, 0, 0.0005);
      // A gap to 1e-9 of the size determines the normal, and the point of the pebble, to the root of that.
      CHECK((find_proximity(*slab, {}, *pebble, pose).contact - expected).norm() <= 5e-5);
      CHECK((find_proximity(*pebble, pose, *slab, {}).contact - expected).norm() <= 5e-5);
      const Vector3 in_frame = find_proximity(*pebble, moved, *slab, frame).contact;
      CHECK((frame.rotation.transpose() * (in_frame - frame.position) - expected).norm() <= 5e-5);
    }
  }
}

TEST_CASE("the contact does not depend on the order of the bodies") {
  for (const ReferencePair& pair : reference_pairs()) {
    // Both have one evaluation with the same normal, so that only the choice of the point differs.
    GapFunction gap(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2),
        swapped(*pair.shape2, pair.pose2, *pair.shape1, pair.pose1);
    GapJet jet, swapped_jet;
    const Vector3 n = pair.normal.normalized();
    gap.evaluate(n, Order::Hessian, jet);
    swapped.evaluate(-(pair.pose2.rotation.transpose() * n), Order::Hessian, swapped_jet);
    const double tolerance = 1e-9 * pair.unit;
    const Vector3 contact = contact_point(gap, jet, StoppingRule(gap, tolerance, 1000));
    const Vector3 seen_from_body2 = contact_point(swapped, swapped_jet, StoppingRule(swapped, tolerance, 1000));
    const Vector3 from_body2 = pair.pose2.position + pair.pose2.rotation * seen_from_body2;
    // A boundary point of a flat face is known to no digit, but lies on the face: it has little weight.
    const double difference = (contact - from_body2).norm();
    if (pair.is_well && !(difference <= 1e-6 * pair.unit)) FAIL_CHECK(pair.name, " contacts differ by ", difference);
    const double height = std::abs(n.dot(contact - from_body2));
    if (!(height <= 1e-12)) FAIL_CHECK(pair.name, " heights differ by ", height);
  }
}

TEST_CASE("the contact lies halfway between the two supporting planes, or between them where that is beside a body") {
  int moved = 0;
  for (const ReferencePair& pair : reference_pairs()) {
    const Proximity out = find_proximity(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2);
    const double above1 = out.normal.dot(out.contact - out.point1);
    const double size = pair.surface1.half_axes().maxCoeff() + pair.surface2.half_axes().maxCoeff();
    if (std::abs(above1 - 0.5 * out.gap) <= 1e-14 * size) continue;
    ++moved;
    const double depth = std::max(-out.gap, 0.0);
    if (!(above1 <= 1e-7 * size && above1 >= -depth - 1e-7 * size)) FAIL_CHECK(pair.name, " height ", above1, " of ", out.gap);
  }
  CHECK(moved <= 10);  // of 1600, octahedral ones
}

TEST_CASE("the contact lies halfway beside the edge of a nearly polyhedral body, which the least tilt of the normal leaves") {
  const Superellipsoid body(Vector3(0.84, 0.54, 0.92), 1.0334, 104.5);
  const Box box(Vector3(1, 1, 1));
  for (const Vector3& direction : random_normals(3000, 82)) {
    const Vector3 n = (Vector3(0.8, -0.36, -0.48) + 0.1 * direction).normalized();
    const Pose pose{body.point(n) - box.point(-n) + 1e-9 * n.cross(direction), Matrix3::Identity()};
    GapFunction gap(body, Pose{}, box, pose);
    GapJet jet;
    gap.evaluate(n, Order::Hessian, jet);
    const double above_middle = n.dot(contact_point(gap, jet, StoppingRule(gap, 1e-9, 1000)) - jet.jet1.r) - 0.5 * n.dot(jet.d);
    if (!(std::abs(above_middle) <= 1e-15)) FAIL_CHECK("n ", n.transpose(), " height ", above_middle);
  }
}

TEST_CASE("a flat face and a sharp vertex: at the vertex") {
  // The vertex of an octahedron, off the middle of the face of a box, pushed in by 0.01.
  const Superellipsoid box(Vector3(3, 2, 1), 100, 100), corner(Vector3::Constant(1), 1.05, 1.05);
  for (const Vector3& place : {Vector3(0, 0, 0), Vector3(1, 0.5, 0), Vector3(-2, -1.2, 0)}) {
    const Vector3 centre = place + Vector3(0, 0, 1 + 1 - 0.01);
    const Vector3 tip = centre - Vector3(0, 0, 1);
    for (const bool box_first : {true, false}) {
      const Proximity out = box_first ? find_proximity(box, {}, corner, at(centre)) : find_proximity(corner, at(centre), box, {});
      CHECK(out.status == Status::Converged);
      CHECK(std::abs(out.gap + 0.01) <= 1e-15);
      CHECK_MESSAGE((out.contact - (tip + Vector3(0, 0, 0.005))).norm() <= 1e-14, text(out.contact));
    }
  }
}

TEST_CASE("without radii of curvature: between the witness points, nearer to the sharper body's") {
  const auto ellipsoid = std::make_shared<Ellipsoid>(Vector3(3, 2, 1));
  const CallbackShape plain([=](const Vector3& n) { return ellipsoid->support(n); },
                            [=](const Vector3& n) { return ellipsoid->point(n); });
  const Ellipsoid sharper(Vector3(0.3, 0.2, 0.1));
  GapFunction gap(plain, {}, sharper, at({2.4, 1.8, 0.6}));
  GapJet jet;
  gap.evaluate(Vector3(2, 1.8, 0.7).normalized(), Order::Point, jet);
  const Vector3 across = jet.d - jet.s * jet.n;
  const Vector3 expected = jet.jet1.r + 0.5 * jet.s * jet.n + 10.0 / 11 * across;
  CHECK((contact_between(gap, jet) - expected).norm() <= 1e-7);
}
