#include "supernormal/shapes/silhouette.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/submerged_volume.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/shapes/superovoid.hpp"

using namespace supernormal;

TEST_CASE("an ellipsoid's silhouette equals its closed form") {
  const Vector3 a(3, 0.2, 1);
  const Ellipsoid body(a);
  for (const Vector3& u : {Vector3(1, 0, 0), Vector3(0, 0, 5), Vector3(1, 2, 3), Vector3(-0.3, 0.9, 0.01)}) {
    const Vector3 n = u.normalized();
    const double area = std::numbers::pi * std::hypot(a.y() * a.z() * n.x(), a.z() * a.x() * n.y(), a.x() * a.y() * n.z());
    CHECK(std::abs(projected_area(body, u) / area - 1) < 1e-12);
  }
}

TEST_CASE("the silhouette of a box-like body equals the silhouette of the box to half a per cent") {
  const Vector3 a(0.3, 0.5, 0.2);
  const Superellipsoid body(a, 800, 800);
  for (const Vector3& u : {Vector3(0, 0, 1), Vector3(1, 1, 1), Vector3(3, 1, -2)}) {
    const Vector3 n = u.normalized().cwiseAbs();
    const double area = 4 * (a.y() * a.z() * n.x() + a.z() * a.x() * n.y() + a.x() * a.y() * n.z());
    CHECK(std::abs(projected_area(body, u) / area - 1) < 0.005);
  }
}

TEST_CASE("the surface of spheroids") {
  const auto oblate = [](double a, double c) {
    const double e = std::sqrt(1 - c * c / (a * a));
    return 2 * std::numbers::pi * a * a * (1 + (1 - e * e) / e * std::atanh(e));
  };
  CHECK(std::abs(surface_area(Ellipsoid(Vector3(2, 2, 2))) / (16 * std::numbers::pi) - 1) < 1e-12);
  CHECK(std::abs(surface_area(Ellipsoid(Vector3(1, 1, 0.4))) / oblate(1, 0.4) - 1) < 1e-3);
}

TEST_CASE("the submerged part of an ellipsoid is the image of a sphere's cap") {
  const Vector3 a(0.3, 0.2, 0.1);
  const SubmergedVolume submerged_volume{Ellipsoid(a)};
  const double whole = 4 * std::numbers::pi / 3 * a.prod();
  CHECK(std::abs(submerged_volume.volume() / whole - 1) < 1e-12);
  const Vector3 up = Vector3(1, -2, 2) / 3;
  const Vector3 scaled = a.cwiseProduct(up);
  for (const double t : {-0.6, 0.0, 0.3, 0.8}) {
    const Submerged part = submerged_volume.below(up, t * scaled.norm());
    const double share = (2 + 3 * t - t * t * t) / 4;
    CHECK(std::abs(part.volume / whole - share) < 0.005);
    const double depth = -3 * (1 - t * t) * (1 - t * t) / (16 * share);  // depth of the cap's centroid, in radii
    CHECK((part.centre - depth * a.cwiseProduct(scaled.normalized())).norm() < 1e-3);
  }
}

TEST_CASE("a body that is wholly in or out of the water is exact") {
  const Superovoid egg(Vector3(0.02, 0.02, 0.03), 2, 2, 0.3, 0.3);
  const SubmergedVolume submerged_volume(egg);
  const MassProperties exact = egg.mass_properties();
  const Submerged all = submerged_volume.below(Vector3::UnitZ(), 1);
  CHECK(all.volume == exact.volume);
  CHECK(all.centre == exact.centroid);
  CHECK(submerged_volume.below(Vector3::UnitZ(), -1).volume == 0);
}
