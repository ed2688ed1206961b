// Tests of geoms of C++ shapes.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "supernormal/geom.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/supernormal.h"
#include "support/ode_fixture.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

/// A class as a program writes it: an ellipsoid by its support function and boundary point, or what a mistake makes of it.
class OwnShape final : public Shape {
 public:
  explicit OwnShape(double factor_of_point = 1) : factor_of_point_(factor_of_point) {}
  void evaluate(const Vector3& n, Order /*order*/, Jet& jet) const override {
    jet.h = n.cwiseProduct(kHalfAxes).norm();
    jet.r = factor_of_point_ * n.cwiseProduct(kHalfAxes.cwiseAbs2()) / jet.h;
  }
  inline static const Vector3 kHalfAxes = {0.3, 0.2, 0.1};  // m

 private:
  double factor_of_point_;
};

}  // namespace

TEST_CASE("a class of one's own collides in ODE as the ellipsoid that it is, and lives as long as its geom") {
  OdeSession session;
  auto shape = std::make_shared<const OwnShape>();
  const std::weak_ptr<const OwnShape> alive = shape;
  {
    const Geom own(ode::create_geom(nullptr, shape));
    shape.reset();
    const Geom known(snCreateEllipsoid(nullptr, dReal(0.3), dReal(0.2), dReal(0.1)));
    const Geom floor(dCreatePlane(nullptr, 0, 0, 1, 0));
    const Geom box(dCreateBox(nullptr, 1, 1, dReal(0.1)));
    for (const dGeomID geom : {dGeomID(own), dGeomID(known)}) {
      dGeomSetPosition(geom, dReal(0.02), dReal(0.01), dReal(0.145));
      const dQuaternion turn = {dReal(0.9), dReal(0.1), dReal(0.3), dReal(0.3)};
      dGeomSetQuaternion(geom, turn);
    }
    for (const dGeomID other : {dGeomID(floor), dGeomID(box)}) {
      std::array<dContactGeom, 2> found{};
      REQUIRE(dCollide(own, other, 1, &found[0], sizeof(dContactGeom)) == 1);
      REQUIRE(dCollide(known, other, 1, &found[1], sizeof(dContactGeom)) == 1);
      CHECK(found[0].depth == doctest::Approx(found[1].depth).epsilon(sizeof(dReal) == 8 ? 1e-9 : 1e-4));
      for (int k = 0; k < 3; ++k) CHECK(std::abs(found[0].normal[k] - found[1].normal[k]) < (sizeof(dReal) == 8 ? 1e-7 : 1e-3));
    }
    CHECK_FALSE(alive.expired());
  }
  CHECK(alive.expired());
}

TEST_CASE("a geom of a known C++ shape is the geom that the C interface makes") {
  OdeSession session;
  const Geom geom(ode::create_geom(
      nullptr, std::make_shared<const Rounded>(std::make_shared<const Superellipsoid>(Vector3(0.3, 0.2, 0.1), 4, 6), 0.05)));
  dReal a = 0, b = 0, c = 0, delta = 0, epsilon = 0;
  CHECK(snGeomSuperellipsoidGetParams(geom, &a, &b, &c, &delta, &epsilon) == 1);
  CHECK(std::array{a, b, c, delta, epsilon} == std::array{dReal(0.3), dReal(0.2), dReal(0.1), dReal(4), dReal(6)});
  std::array<char, 200> text{};
  CHECK(snGeomDescribe(geom, text.data(), static_cast<int>(text.size())) > 0);
  CHECK(std::string(text.data()).find("radius=0.05)") != std::string::npos);
}

TEST_CASE("mistakes in a C++ shape are refused with what is wrong") {
  OdeSession session;
  const auto says = [](const std::shared_ptr<const Shape>& shape, const char* text) {
    CHECK_THROWS_WITH_AS(ode::create_geom(nullptr, shape), doctest::Contains(text), std::invalid_argument);
  };
  says(nullptr, "shape = NULL");
  says(std::make_shared<const OwnShape>(1.1), "differs from support");
  says(std::make_shared<const OwnShape>(std::numeric_limits<double>::quiet_NaN()), "is not finite");
}
