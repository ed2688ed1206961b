// Tests of Body, the C++ object behind a geom.
#include "ode/geom/body.hpp"

#include <doctest/doctest.h>

#include <memory>

#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/rounded.hpp"

using namespace supernormal;

TEST_CASE("body: a copy has the sizes of the rounded body, and a serial number of its own") {
  const auto shape = std::make_shared<Rounded>(std::make_shared<Cylinder>(0.3, 0.4), 0.25);
  const auto body = ode::Body::of(shape);
  body->set_look_ahead(0.125);
  const auto copy = body->copy();
  CHECK(&copy->shape() == &body->shape());
  CHECK(copy->size() == body->size());
  CHECK(copy->radius() == body->radius());
  CHECK(copy->radius() == shape->bounding_radius());
  CHECK(copy->look_ahead() == 0.125);
  CHECK(copy->serial() > body->serial());
}
