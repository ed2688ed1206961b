// The snCreate… functions, bodies as text, and copies.
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "base/validation.hpp"
#include "ode/api/registration.hpp"
#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "ode/support/last_error.hpp"
#include "ode/support/require.hpp"
#include "supernormal/geom.hpp"
#include "supernormal/shapes/callback_shape.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/description.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::ode {
namespace {

using Direction = std::array<dReal, 3>;

Direction to_direction(const Vector3& n) { return {to_real(n.x()), to_real(n.y()), to_real(n.z())}; }

CallbackShape::Hessian wrap_hessian(const snShape& shape) {
  if (shape.hessian == nullptr) return {};
  return [shape](const Vector3& n) {
    std::array<dReal, 9> H{};
    shape.hessian(shape.user, to_direction(n).data(), H.data());
    Matrix3 hessian;
    for (int row = 0; row < 3; ++row) hessian.row(row) = to_vector(H.data() + std::ptrdiff_t{3} * row).transpose();
    return hessian;
  };
}

/// Tests the callbacks. Throws std::invalid_argument when they do not define a convex body. Does not call `release`.
std::shared_ptr<const Shape> make_user_shape(const snShape* shape) {
  require_not_null("shape", shape);
  const snShape copy = *shape;
  if (copy.support == nullptr) throw std::invalid_argument("shape->support = NULL, but a body needs its support function");
  if (copy.point == nullptr) throw std::invalid_argument("shape->point = NULL, but a body needs its boundary point");
  const auto point = [copy](const Vector3& n) {
    std::array<dReal, 3> r{};
    copy.point(copy.user, to_direction(n).data(), r.data());
    return to_vector(r.data());
  };
  const auto checked = std::make_shared<CallbackShape>(
      [copy](const Vector3& n) { return double{copy.support(copy.user, to_direction(n).data())}; }, point, wrap_hessian(copy));
  if constexpr (std::is_same_v<dReal, double>) return checked;
  // In single precision the callbacks see a rounded direction, and support() returns a rounded length. Only n.r is consistent with
  // the point r. The callback's value can differ from it by more than the depth of contacts with a much smaller body.
  return std::make_shared<CallbackShape>([point](const Vector3& n) { return n.dot(point(n)); }, point, wrap_hessian(copy));
}

void copy_geom(dGeomID from, dGeomID to) {
  const dReal* const position = dGeomGetPosition(from);
  dGeomSetPosition(to, position[0], position[1], position[2]);
  dGeomSetRotation(to, dGeomGetRotation(from));
  dGeomSetCategoryBits(to, dGeomGetCategoryBits(from));
  dGeomSetCollideBits(to, dGeomGetCollideBits(from));
  if (dGeomIsEnabled(from) == 0) dGeomDisable(to);
}

}  // namespace

dGeomID create_geom(dSpaceID space, const std::shared_ptr<const Shape>& shape) {
  require_not_null("shape", shape.get());
  // Its constructor tests the functions.
  static_cast<void>(
      CallbackShape([&](const Vector3& n) { return shape->support(n); }, [&](const Vector3& n) { return shape->point(n); }));
  return create_geom(space, Body::of(shape));
}

}  // namespace supernormal::ode

using namespace supernormal;
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

extern "C" int snGeomDescribe(dGeomID geom, char* text, int capacity) {
  return guarded("snGeomDescribe", -1, [&] {
    const std::string whole = describe(require_body(geom).shape());
    if (whole.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
      throw std::length_error("the text has more characters than an int counts");
    }
    const int length = static_cast<int>(whole.size());
    if (capacity < 0) throw std::invalid_argument("capacity = " + std::to_string(capacity) + ", but must be at least 0");
    if (capacity == 0) return length;
    require_not_null("text", text);
    *std::copy_n(whole.data(), std::min(length, capacity - 1), text) = '\0';
    return length;
  });
}

extern "C" dGeomID snCreateFromDescription(dSpaceID space, const char* text) {
  return guarded("snCreateFromDescription", dGeomID{}, [&] {
    require_not_null("text", text);
    return create_geom(space, Body::of(read_shape(text)));
  });
}

extern "C" dGeomID snGeomCopy(dSpaceID space, dGeomID geom) {
  return guarded("snGeomCopy", dGeomID{}, [&] {
    require_space(space);
    const dGeomID copy = create_geom(nullptr, require_body(geom).copy());
    copy_geom(geom, copy);
    if (space != nullptr) dSpaceAdd(space, copy);
    return copy;
  });
}
