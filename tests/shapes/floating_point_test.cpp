// Tests that valid input raises no floating-point exception that a program may have trapped, and gives finite results.
#include <doctest/doctest.h>

#include <cfenv>
#include <memory>
#include <string>

#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

constexpr int kTrapped = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;

std::string raised() {
  std::string names;
  if (std::fetestexcept(FE_INVALID)) names += " invalid";
  if (std::fetestexcept(FE_DIVBYZERO)) names += " division by zero";
  if (std::fetestexcept(FE_OVERFLOW)) names += " overflow";
  return names;
}

/// Evaluates all orders at n, and a step from there.
void check_quiet(const Shape& shape, const Vector3& n, const std::string& name) {
  std::feclearexcept(kTrapped);
  Jet jet;
  for (const Order order : {Order::Value, Order::Point, Order::Hessian}) {
    shape.evaluate(n, order, jet);
    if (std::fetestexcept(kTrapped)) FAIL_CHECK(name, " n ", text(n), " order ", static_cast<int>(order), raised());
    std::feclearexcept(kTrapped);
  }
  if (!(std::isfinite(jet.h) && jet.r.allFinite() && jet.H.allFinite())) FAIL_CHECK(name, " n ", text(n), " is not finite");
  const Vector3 dn = 1e-3 * tangents(n)[0];
  std::feclearexcept(kTrapped);
  const Vector3 advanced = shape.advance_normal(n, jet, dn);
  const bool usable = advanced.allFinite() && advanced.norm() > 0;
  if (std::fetestexcept(kTrapped) || !usable) FAIL_CHECK(name, " n ", text(n), " advanced ", text(advanced), raised());
}

}  // namespace

TEST_CASE("superellipsoids of every exponent are finite everywhere and raise nothing") {
  for (const Superellipsoid& shape : superellipsoids(1.01, 1000)) {
    const std::string name = text(shape);
    for (const Vector3& n : all_normals(50, 51)) check_quiet(shape, n, name);
  }
}

TEST_CASE("the smallest, largest and thinnest bodies are finite everywhere and raise nothing") {
  for (const Vector3& half_axes :
       {Vector3(1e-30, 1e-30, 1e-30), Vector3(1e30, 1e30, 1e30), Vector3(1e30, 1, 1e-30), Vector3(1, 1e4, 1e-4)}) {
    for (const double exponent : {1.01, 1.5, 2.0, 5.0, 1000.0}) {
      const Superellipsoid shape(half_axes, exponent, exponent);
      const std::string name = text(shape);
      for (const Vector3& n : all_normals(50, 51)) check_quiet(shape, n, name);
    }
    const std::string name = "ellipsoid " + text(half_axes);
    for (const Vector3& n : all_normals(50, 51)) check_quiet(Ellipsoid(half_axes), n, name);
  }
}

TEST_CASE("spheres, points and rounded bodies raise nothing") {
  const Rounded rounded(std::make_shared<Superellipsoid>(Vector3(3, 2, 1), 50, 4), 0.1);
  for (const Vector3& n : all_normals(50, 51)) {
    check_quiet(Sphere(1e30), n, "sphere");
    check_quiet(Sphere(0), n, "point");
    check_quiet(rounded, n, "rounded");
  }
}

TEST_CASE("mass properties raise nothing") {
  std::feclearexcept(kTrapped);
  for (const double exponent : {1.01, 1.5, 2.0, 5.0, 1000.0}) {
    for (const Vector3& half_axes : {Vector3(1e-30, 1e-30, 1e-30), Vector3(1e30, 1e30, 1e30), Vector3(3, 2, 1)}) {
      const auto shape = std::make_shared<Superellipsoid>(half_axes, exponent, exponent);
      const MassProperties plain = shape->mass_properties();
      const MassProperties swept = Rounded(shape, 0.1 * half_axes.x()).mass_properties();
      CHECK(std::isfinite(plain.volume + swept.volume));
      CHECK((plain.second_moment + swept.second_moment).allFinite());
      CHECK(plain.volume > 0);
      CHECK(swept.volume > plain.volume);
    }
  }
  Ellipsoid(Vector3(3, 2, 1)).Shape::mass_properties();
  Sphere(0).Shape::mass_properties();
  CHECK_MESSAGE(std::fetestexcept(kTrapped) == 0, raised());
}
