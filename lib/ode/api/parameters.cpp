// Getters and setters of a geom's parameters.
#include <stdexcept>
#include <string>

#include "ode/geom/body.hpp"
#include "ode/geom/bounding_box.hpp"
#include "ode/geom/convert.hpp"
#include "ode/support/last_error.hpp"
#include "ode/support/require.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::ode {
namespace {

const SuperellipsoidParameters& require_superellipsoid(const Body& body) {
  if (body.superellipsoid() != nullptr) return *body.superellipsoid();
  throw std::invalid_argument(std::string("geom is ") + (body.superovoid() != nullptr ? "a superovoid" : "a user-defined body") +
                              ", but must be an ellipsoid or a superellipsoid");
}

const SuperovoidParameters& require_superovoid(const Body& body) {
  if (body.superovoid() != nullptr) return *body.superovoid();
  throw std::invalid_argument(std::string("geom is ") +
                              (body.superellipsoid() != nullptr ? "a superellipsoid" : "a user-defined body") +
                              ", but must be a superovoid");
}

void get_superellipsoid(const SuperellipsoidParameters& parameters, dReal* a, dReal* b, dReal* c, dReal* delta, dReal* epsilon) {
  require_not_null("a", a);
  require_not_null("b", b);
  require_not_null("c", c);
  require_not_null("delta", delta);
  require_not_null("epsilon", epsilon);
  *a = to_real(parameters.half_axes.x());
  *b = to_real(parameters.half_axes.y());
  *c = to_real(parameters.half_axes.z());
  *delta = to_real(parameters.delta);
  *epsilon = to_real(parameters.epsilon);
}

}  // namespace
}  // namespace supernormal::ode

using namespace supernormal::ode;

extern "C" int snGeomSuperellipsoidSetParams(dGeomID geom, dReal a, dReal b, dReal c, dReal delta, dReal epsilon) {
  return succeeds("snGeomSuperellipsoidSetParams", [&] {
    Body& body = require_body(geom);
    require_superellipsoid(body);
    body.set_superellipsoid({{a, b, c}, delta, epsilon});
    set_moved(geom);
  });
}

extern "C" int snGeomSuperellipsoidGetParams(dGeomID geom, dReal* a, dReal* b, dReal* c, dReal* delta, dReal* epsilon) {
  return succeeds("snGeomSuperellipsoidGetParams",
                  [&] { get_superellipsoid(require_superellipsoid(require_body(geom)), a, b, c, delta, epsilon); });
}

extern "C" int snGeomSuperovoidSetParams(dGeomID geom, dReal a, dReal b, dReal c, dReal delta, dReal epsilon, dReal taper_x,
                                         dReal taper_y) {
  return succeeds("snGeomSuperovoidSetParams", [&] {
    Body& body = require_body(geom);
    require_superovoid(body);
    body.set_superovoid({{{a, b, c}, delta, epsilon}, taper_x, taper_y});
    set_moved(geom);
  });
}

extern "C" int snGeomSuperovoidGetParams(dGeomID geom, dReal* a, dReal* b, dReal* c, dReal* delta, dReal* epsilon, dReal* taper_x,
                                         dReal* taper_y) {
  return succeeds("snGeomSuperovoidGetParams", [&] {
    const SuperovoidParameters& parameters = require_superovoid(require_body(geom));
    require_not_null("taper_x", taper_x);
    require_not_null("taper_y", taper_y);
    get_superellipsoid(parameters.straight, a, b, c, delta, epsilon);
    *taper_x = to_real(parameters.taper_x);
    *taper_y = to_real(parameters.taper_y);
  });
}

extern "C" int snGeomSetRounding(dGeomID geom, dReal radius) {
  return succeeds("snGeomSetRounding", [&] {
    require_body(geom).set_rounding(radius);
    set_moved(geom);
  });
}
