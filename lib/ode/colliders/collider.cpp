#include "ode/colliders/collider.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "ode/colliders/contact.hpp"
#include "ode/colliders/convex/primitives.hpp"
#include "ode/geom/convert.hpp"
#include "ode/geom/geom_class.hpp"
#include "ode/support/last_error.hpp"
#include "ode/support/require.hpp"

namespace supernormal::ode {
namespace {

std::string text_of(const Vector3& v) { return "(" + to_text(v.x()) + ", " + to_text(v.y()) + ", " + to_text(v.z()) + ")"; }

std::string named(dGeomID geom, const char* name) {
  return name == nullptr ? geom_class_name(geom) : std::string(name) + " (" + geom_class_name(geom) + ")";
}

void require_usable_pose(dGeomID geom, const char* name) {
  // These have no pose, or may have none. ODE aborts when asked for it.
  if (dGeomGetClass(geom) == dPlaneClass || dGeomGetClass(geom) == dHeightfieldClass) return;
  const Pose pose{to_vector(dGeomGetPosition(geom)), to_rotation(dGeomGetRotation(geom))};
  if (is_usable(pose)) return;
  if (is_usable(Pose{pose.position, Matrix3::Identity()})) {
    const Matrix3& R = pose.rotation;
    throw std::invalid_argument("the pose of " + named(geom, name) + " is not finite: rotation = (" + text_of(R.row(0)) + ", " +
                                text_of(R.row(1)) + ", " + text_of(R.row(2)) + ")");
  }
  throw std::invalid_argument("the pose of " + named(geom, name) + " is not finite, or its position is not within " +
                              to_text(kFarthest) + " m: position = " + text_of(pose.position) + " m");
}

/// The dColliderFn that writes the contacts of a query.
template <PairQuery kQuery>
int collide_by(dGeomID ours, dGeomID collider, int flags, dContactGeom* contacts, int skip) {
  return guarded("dCollide", 0, [&] {
    const ContactArray out{ours, collider, flags, contacts, skip};
    const ContactManifold manifold = kQuery(ours, collider, out.max_contacts() > 1 ? QueryKind::Contacts : QueryKind::OneContact);
    if (manifold.deepest.status == Status::InvalidInput) refuse_pair(ours, collider);
    return write_contacts(manifold, out);
  });
}

struct Collider {
  int geom_class;
  dColliderFn* collide;
  PairQuery* query;
};

// The other geometry classes of ODE, except spaces and dGeomTransform, which ODE resolves itself.
constexpr std::array<Collider, 5> kColliders = {{
    {dPlaneClass, collide_by<query_plane>, query_plane},
    {dRayClass, collide_with_ray, query_ray},
    {dConvexClass, collide_by<query_convex>, query_convex},
    {dTriMeshClass, collide_with_trimesh, query_trimesh},
    {dHeightfieldClass, collide_with_heightfield, query_heightfield},
}};

const Collider* find_builtin(int collider_class) {
  static constexpr Collider kPrimitive = {-1, collide_by<query_primitive>, query_primitive};
  if (find_primitive(collider_class) != nullptr) return &kPrimitive;
  const auto* const found = std::find_if(kColliders.begin(), kColliders.end(),
                                         [&](const Collider& collider) { return collider.geom_class == collider_class; });
  return found == kColliders.end() ? nullptr : found;
}

}  // namespace

dColliderFn* find_collider(int collider_class) {
  if (collider_class == geom_class()) return collide_by<query_body>;
  const Collider* const collider = find_builtin(collider_class);
  return collider == nullptr ? nullptr : collider->collide;
}

PairQuery* find_query(int collider_class) {
  if (collider_class == geom_class()) return query_body;
  const Collider* const collider = find_builtin(collider_class);
  return collider == nullptr ? nullptr : collider->query;
}

void set_colliders(int our_class) {
  for (const Collider& collider : kColliders) dSetColliderOverride(our_class, collider.geom_class, collider.collide);
  for (const Primitive& one : primitives()) dSetColliderOverride(our_class, one.geom_class, collide_by<query_primitive>);
  dSetColliderOverride(our_class, our_class, collide_by<query_body>);
}

void refuse_pair(dGeomID ours, dGeomID collider, const char* our_name, const char* collider_name) {
  require_usable_pose(ours, our_name);
  require_usable_pose(collider, collider_name);
  throw std::invalid_argument("the numbers that describe " + named(collider, collider_name) +
                              " and its pose, or what a user-defined body returned, are not finite, or a width is not positive");
}

void refuse_class(dGeomID collider, const char* name) {
  throw std::invalid_argument(
      std::string(name) + " is " + geom_class_name(collider) +
      ", but must be a body made by snCreate… or one of ODE's own geoms (not a space, not a dGeomTransform)");
}

}  // namespace supernormal::ode
