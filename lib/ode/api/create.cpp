// The snCreate… functions.
#include <memory>
#include <utility>

#include "base/validation.hpp"
#include "ode/api/registration.hpp"
#include "ode/geom/body.hpp"
#include "ode/geom/user_shape.hpp"
#include "ode/support/last_error.hpp"
#include "ode/support/require.hpp"
#include "supernormal/geom.hpp"
#include "supernormal/shapes/callback_shape.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::ode {

dGeomID create_geom(dSpaceID space, const std::shared_ptr<const Shape>& shape) {
  require_not_null("shape", shape.get());
  // Its constructor tests the functions.
  static_cast<void>(
      CallbackShape([&](const Vector3& n) { return shape->support(n); }, [&](const Vector3& n) { return shape->point(n); }));
  return create_geom(space, Body::of(shape));
}

}  // namespace supernormal::ode

using namespace supernormal::ode;

extern "C" dGeomID snCreateEllipsoid(dSpaceID space, dReal a, dReal b, dReal c) {
  return guarded("snCreateEllipsoid", dGeomID{}, [&] {
    return create_geom(space, std::make_unique<Body>(SuperellipsoidParameters{{a, b, c}, 2, 2}));
  });
}

extern "C" dGeomID snCreateSuperellipsoid(dSpaceID space, dReal a, dReal b, dReal c, dReal delta, dReal epsilon) {
  return guarded("snCreateSuperellipsoid", dGeomID{}, [&] {
    return create_geom(space, std::make_unique<Body>(SuperellipsoidParameters{{a, b, c}, delta, epsilon}));
  });
}

extern "C" dGeomID snCreateSuperovoid(dSpaceID space, dReal a, dReal b, dReal c, dReal delta, dReal epsilon, dReal taper_x,
                                      dReal taper_y) {
  return guarded("snCreateSuperovoid", dGeomID{}, [&] {
    return create_geom(space, std::make_unique<Body>(SuperovoidParameters{{{a, b, c}, delta, epsilon}, taper_x, taper_y}));
  });
}

extern "C" dGeomID snCreateCapsule(dSpaceID space, dReal radius, dReal length) {
  return guarded("snCreateCapsule", dGeomID{}, [&] {
    // The core accepts radius 0 (a segment). A geom must have an interior.
    supernormal::require_in("radius", radius, supernormal::kMinLength, supernormal::kMaxLength, "m");
    supernormal::require_in("length", length, 0, supernormal::kMaxLength, "m");
    return create_geom(space, std::make_unique<Body>(std::make_shared<supernormal::Capsule>(radius, length / 2)));
  });
}

extern "C" dGeomID snCreateConvex(dSpaceID space, const snShape* shape) {
  return guarded("snCreateConvex", dGeomID{}, [&] {
    auto body = std::make_unique<Body>(make_user_shape(shape));
    body->set_release_callback(shape->release, shape->user);
    Body& alive = *body;
    const dGeomID geom = create_geom(space, std::move(body));
    alive.arm_release_callback();  // only now: a refused call must not call release
    return geom;
  });
}
