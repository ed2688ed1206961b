#include "ode/partner.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "ode/geom_class.hpp"
#include "ode/last_error.hpp"

namespace supernormal::ode {
namespace {

struct Partner {
  int geom_class;
  const char* name;
  dColliderFn* collide;
  PairQuery* query;  // null: not supported
};

const char* builtin_name(int geom_class);

// Sees every pair whose partner is not supported: no contacts, and snLastError says why bodies fall through each other.
int collide_with_unsupported(dGeomID /*ours*/, dGeomID partner, int /*flags*/, dContactGeom* /*contacts*/, int /*skip*/) {
  std::array<char, 128> message{};
  std::snprintf(message.data(), message.size(), "the partner is a %s, which this version does not support: no contacts",
                builtin_name(dGeomGetClass(partner)));
  set_last_error("dCollide", message.data());
  return 0;
}

// ODE's own classes but for spaces and dGeomTransform, which ODE takes apart itself.
constexpr std::array<Partner, 9> kPartners = {{
    {dSphereClass, "dSphere", collide_with_sphere, query_sphere},
    {dBoxClass, "dBox", collide_with_unsupported, nullptr},
    {dCapsuleClass, "dCapsule", collide_with_unsupported, nullptr},
    {dCylinderClass, "dCylinder", collide_with_unsupported, nullptr},
    {dPlaneClass, "dPlane", collide_with_plane, query_plane},
    {dRayClass, "dRay", collide_with_unsupported, nullptr},
    {dConvexClass, "dConvex", collide_with_unsupported, nullptr},
    {dTriMeshClass, "dTriMesh", collide_with_unsupported, nullptr},
    {dHeightfieldClass, "dHeightfield", collide_with_unsupported, nullptr},
}};

const Partner* find_builtin(int partner_class) {
  const auto* const found =
      std::find_if(kPartners.begin(), kPartners.end(), [&](const Partner& partner) { return partner.geom_class == partner_class; });
  return found == kPartners.end() ? nullptr : found;
}

const char* builtin_name(int geom_class) {
  const Partner* const partner = find_builtin(geom_class);
  return partner == nullptr ? "geom of unknown class" : partner->name;
}

}  // namespace

dColliderFn* find_collider(int partner_class) {
  if (partner_class == geom_class()) return collide_with_body;
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
  dSetColliderOverride(our_class, our_class, collide_with_body);
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
