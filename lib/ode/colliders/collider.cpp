#include "ode/colliders/collider.hpp"

#include <algorithm>
#include <array>

#include "ode/colliders/solve_pair.hpp"
#include "ode/geom/geom_class.hpp"

namespace supernormal::ode {
namespace {

struct Collider {
  int geom_class;
  const char* name;
  dColliderFn* collide;
  PairQuery* query;
};

// ODE's own classes without spaces and dGeomTransform, which ODE resolves itself.
constexpr std::array<Collider, 9> kColliders = {{
    {dSphereClass, "dSphere", collide_by<query_sphere>, query_sphere},
    {dBoxClass, "dBox", collide_by<query_box>, query_box},
    {dCapsuleClass, "dCapsule", collide_by<query_capsule>, query_capsule},
    {dCylinderClass, "dCylinder", collide_by<query_cylinder>, query_cylinder},
    {dPlaneClass, "dPlane", collide_by<query_plane>, query_plane},
    {dRayClass, "dRay", collide_with_ray, query_ray},
    {dConvexClass, "dConvex", collide_by<query_convex>, query_convex},
    {dTriMeshClass, "dTriMesh", collide_with_trimesh, query_trimesh},
    {dHeightfieldClass, "dHeightfield", collide_with_heightfield, query_heightfield},
}};

const Collider* find_builtin(int collider_class) {
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
  dSetColliderOverride(our_class, our_class, collide_by<query_body>);
}

std::string geom_class_name(dGeomID geom) {
  const int number = dGeomGetClass(geom);
  if (number == geom_class()) return "a geom of this library's class";
  if (const Collider* const collider = find_builtin(number)) return std::string("a ") + collider->name;
  if (dGeomIsSpace(geom) != 0) return "a space";
  if (number == dGeomTransformClass) return "a dGeomTransform";
  return "a geom of user class " + std::to_string(number);
}

}  // namespace supernormal::ode
