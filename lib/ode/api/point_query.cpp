// Queries of one body and a point or a direction.
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "ode/colliders/collider.hpp"
#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "ode/support/last_error.hpp"
#include "ode/support/require.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/supernormal.h"

using namespace supernormal;
using namespace supernormal::ode;

extern "C" dReal snGeomPointDepth(dGeomID geom, dReal x, dReal y, dReal z) {
  return guarded("snGeomPointDepth", std::numeric_limits<dReal>::quiet_NaN(), [&] {
    const Body& body = require_body(geom);
    const Pose point_pose{require_place(Vector3(x, y, z)), Matrix3::Identity()};
    const Settings settings = settings_for(body.settings(), QueryKind::Distance);
    const Proximity result = find_proximity(body.shape(), pose_of(geom), Sphere(0), point_pose, settings);
    if (result.status == Status::InvalidInput) throw std::invalid_argument("the pose of geom" + no_answer_because());
    return to_real(0 - result.gap);  // 0 - 0 is +0, not -0
  });
}

extern "C" int snGeomSupport(dGeomID geom, const dVector3 direction, dVector3 point) {
  return succeeds("snGeomSupport", [&] {
    const Body& body = require_body(geom);
    require_not_null("direction", direction);
    require_not_null("point", point);
    const Vector3 normal = require_finite("direction", to_vector(direction));
    const double scale = normal.cwiseAbs().maxCoeff();  // the square of a very long or short vector overflows or underflows
    if (scale == 0) throw std::invalid_argument("direction = (0, 0, 0), but must have a length");
    const Pose pose = pose_of(geom);
    if (!is_usable(pose)) throw std::invalid_argument("the pose of geom" + no_answer_because());
    const Vector3 boundary_point = body.shape().point(pose.rotation.transpose() * (normal / scale).normalized());
    const Vector3 found = pose.position + pose.rotation * boundary_point;
    if (!all_finite(found)) throw std::invalid_argument("the pose of geom" + no_answer_because());
    from_vector(found, point);
  });
}
