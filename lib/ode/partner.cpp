#include "ode/partner.hpp"

#include <algorithm>
#include <array>

#include "ode/geom_class.hpp"
#include "ode/solve_pair.hpp"

namespace supernormal::ode {
namespace {

struct Partner {
  int geom_class;
  const char* name;
  dColliderFn* collide;
  PairQuery* query;
};

// ODE's own classes but for spaces and dGeomTransform, which ODE takes apart itself.
constexpr std::array<Partner, 9> kPartners = {{
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

const Partner* find_builtin(int partner_class) {
  const auto* const found =
      std::find_if(kPartners.begin(), kPartners.end(), [&](const Partner& partner) { return partner.geom_class == partner_class; });
  return found == kPartners.end() ? nullptr : found;
}

}  // namespace

dColliderFn* find_collider(int partner_class) {
  if (partner_class == geom_class()) return collide_by<query_body>;
  const Partner* const partner = find_builtin(partner_class);
  return partner == nullptr ? nullptr : partner->collide;
}

PairQuery* find_query(int partner_class) {
  if (partner_class == geom_class()) return query_body;
  const Partner* const partner = find_builtin(partner_class);
  return partner == nullptr ? nullptr : partner->query;
}

void set_colliders(int our_class) {
  for (const Partner& partner : kPartners) dSetColliderOverride(our_class, partner.geom_class, partner.collide);
  dSetColliderOverride(our_class, our_class, collide_by<query_body>);
}

std::string geom_class_name(dGeomID geom) {
  const int number = dGeomGetClass(geom);
  if (number == geom_class()) return "a geom of this library's class";
  if (const Partner* const partner = find_builtin(number)) return std::string("a ") + partner->name;
  if (dGeomIsSpace(geom) != 0) return "a space";
  if (number == dGeomTransformClass) return "a dGeomTransform";
  return "a geom of user class " + std::to_string(number);
}

}  // namespace supernormal::ode
