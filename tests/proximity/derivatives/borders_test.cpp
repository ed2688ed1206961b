// The status of derivatives beside the borders of faces and edges, where they jump.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "supernormal/proximity/derivatives.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/draw.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

constexpr double kFlat = std::numeric_limits<double>::infinity();

/// A point of a body where an edge or a face ends. From there the normal rotates from `normal` towards `across`, and a point of the
/// edge or the face is on the other side.
struct Border {
  std::string name;
  std::shared_ptr<const Shape> shape;
  Vector3 normal, across, point;
  double radius;        // m; of curvature along the border, before it
  double rounding = 0;  // m; that of the shape
};

std::vector<Border> borders(Draw& draw, std::vector<Vector3>& corners) {
  const Vector3 half = draw.log_within(0.2, 1);
  const double angle = draw.uniform(0.2, 1.3), azimuth = draw.uniform(0, 6), radius = draw.log_uniform(0.1, 1),
               half_length = draw.log_uniform(0.1, 1), rounding = draw.log_uniform(0.01, 1);
  const Vector3 edge(std::cos(angle), 0, std::sin(angle)), up = Vector3::UnitZ(), out(std::cos(azimuth), std::sin(azimuth), 0);
  const Matrix3 turn = draw.rotation();
  corners.clear();
  for (int k = 0; k < 8; ++k) {
    const Vector3 signs((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1);
    corners.emplace_back(turn * half.cwiseProduct(signs));
  }
  const auto box = std::make_shared<Box>(half);
  const auto can = std::make_shared<Cylinder>(radius, half_length);
  const Vector3 rim = radius * out + half_length * up;
  return {
      {"end of a box's edge", box, edge, Vector3::UnitY(), half, 0},
      {"border of a box's face", box, up, Vector3::UnitX(), Vector3(half.x(), draw.uniform(-0.9, 0.9) * half.y(), half.z()), kFlat},
      {"border of a cap", can, up, out, rim, kFlat},
      {"end of a cylinder's flank", can, out, up, rim, radius},
      {"end of a capsule", std::make_shared<Capsule>(rounding, half_length), out, up, half_length * up, rounding, rounding},
      {"polytope's corner", std::make_shared<Polytope>(corners), turn * edge, turn * Vector3::UnitY(), turn * half, 0},
      {"rounded box", std::make_shared<Rounded>(box, rounding), edge, Vector3::UnitY(), half, rounding, rounding}};
}

std::vector<std::shared_ptr<const Shape>> partners(Draw& draw) {
  const auto with_exponents = [&draw](double least, double most) {
    const double delta = draw.uniform(least, most);
    return std::make_shared<Superellipsoid>(draw.log_within(0.3, 1), delta, draw.uniform(least, most));
  };
  return {std::make_shared<Sphere>(draw.log_uniform(0.02, 2)), std::make_shared<Ellipsoid>(draw.log_within(0.3, 1)),
          with_exponents(2, 5), with_exponents(1.1, 1.5),
          std::make_shared<Ellipsoid>(Vector3(draw.log_uniform(2, 5), draw.log_uniform(0.05, 0.2), draw.log_uniform(0.05, 0.2)))};
}

/// The derivatives where the normal is `angle` (rad) beyond the border, or, if that is negative, before it.
ProximityDerivatives derivatives_beside(const Border& border, double angle, const Shape& partner, const Matrix3& rotation,
                                        double gap, bool is_swapped) {
  const Vector3 n = angle > 0 ? (border.normal + angle * border.across).normalized() : border.normal;
  Jet jet;
  partner.evaluate(-(rotation.transpose() * border.normal), Order::Hessian, jet);
  // How far a point slides on its edge or face as the other body's point rolls by a radian.
  const Matrix3 K = rotation * jet.H * rotation.transpose() + gap * Matrix3::Identity();
  const Vector3 aside = border.normal.cross(border.across);
  const double coupling = aside.dot(K * border.across);
  const double slide =
      std::min(angle, 0.0) * (border.across.dot(K * border.across) - coupling * coupling / (border.radius + aside.dot(K * aside)));
  const Vector3 point1 = border.point + slide * border.across + border.rounding * n;
  const Pose pose{point1 + gap * n - rotation * partner.point(-(rotation.transpose() * n)), rotation};
  return is_swapped
             ? find_proximity_derivatives(partner, pose, *border.shape, {}, find_proximity(partner, pose, *border.shape, {}))
             : find_proximity_derivatives(*border.shape, {}, partner, pose, find_proximity(*border.shape, {}, partner, pose));
}

}  // namespace

TEST_CASE("derivatives: within 1e-6 rad of the end of a face or an edge they are refused, and farther away they are defined") {
  Draw draw(2);
  std::vector<Vector3> corners;
  int jumps = 0, refused = 0, asked = 0;
  for (int k = 0; k < draws(40); ++k) {
    for (const Border& border : borders(draw, corners)) {
      CAPTURE(border.name);
      const auto all = partners(draw);
      for (std::size_t which = 0; which < all.size(); ++which) {
        const auto& partner = all[which];
        CAPTURE(k);
        CAPTURE(which);
        const Matrix3 rotation = draw.rotation();
        const double gap = draw.log_uniform(1e-3, 1);
        for (const bool is_swapped : {false, true}) {
          CAPTURE(is_swapped);
          const auto at = [&](double angle) { return derivatives_beside(border, angle, *partner, rotation, gap, is_swapped); };
          const ProximityDerivatives before = at(-1e-5), behind = at(1e-5);
          const double jump = (before.normal - behind.normal).norm() / std::max(before.normal.norm(), behind.normal.norm());
          for (const double angle : {1e-13, 1e-10, 1e-8, 9e-7, -1e-13, -1e-10, -1e-8, -9e-7}) {
            CAPTURE(angle);
            if (!(jump > 0.05)) continue;
            ++jumps;
            CHECK(!at(angle).has_normal);
          }
          for (const double angle : {3e-6, 1e-3, -3e-6, -1e-3}) {
            ++asked;
            refused += at(angle).status == DerivativeStatus::Degenerate;
          }
        }
      }
    }
  }
  CHECK(jumps > 1000);
  CHECK(refused <= asked / 300);
}
