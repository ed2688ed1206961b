// Tests that the former content of the stack does not decide an answer: the reference pairs, and bodies that do not name all of
// their vertices.
#include <doctest/doctest.h>

#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "support/draw.hpp"
#include "support/painted_stack.hpp"
#include "support/reference_pairs.hpp"
#include "support/traps.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

/// A box that says that it has faces and edges, and not where.
class Reticent : public Shape {
 public:
  explicit Reticent(const Vector3& half_lengths) : box_(half_lengths) {}

  void evaluate(const Vector3& n, Order order, Jet& jet) const override { box_.evaluate(n, order, jet); }
  ShapeTraits traits() const override { return {.has_hessian = true, .has_nonsmooth_points = true}; }
  Vector3 half_extents() const override { return box_.half_extents(); }

 private:
  Box box_;
};

}  // namespace

TEST_CASE("reference pairs: every solver gives the same digits over any stack, and computes with nothing that it has not set") {
  for (const ReferencePair& pair : some_of(reference_pairs())) {
    for (const Solver solver : {Solver::Hybrid, Solver::Newton, Solver::FixedPoint}) {
      Settings settings;
      settings.solver = solver;
      const auto ask = [&] { return find_proximity(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, settings); };
      if (!is_same_on_every_stack(ask)) FAIL_CHECK(pair.name);
      const Traps traps(pair.name.c_str());
      if (solver == Solver::Hybrid) ask_on_painted_stack(kSignallingNan, ask);
    }
  }
}

TEST_CASE("a body with faces that names no vertex is known by its boundary points") {
  const Reticent box(Vector3(0.5, 0.4, 0.3));
  const Ellipsoid body(Vector3(1, 0.8, 0.6));
  for (const double height : {0.5, 0.85, 0.95}) {
    const Pose pose2{{0.1, 0.2, height}, Matrix3::Identity()};
    const auto ask = [&] { return find_proximity(body, {}, box, pose2, {}); };
    CHECK(is_same_on_every_stack(ask));
    const Proximity known = find_proximity(body, {}, Box(Vector3(0.5, 0.4, 0.3)), pose2, {});
    CHECK(ask().gap == doctest::Approx(known.gap).epsilon(1e-6));
  }
}
