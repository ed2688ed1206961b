#include "ode/colliders/convex/primitives.hpp"

#include <algorithm>
#include <array>

#include "ode/colliders/collider.hpp"
#include "ode/colliders/solve_pair.hpp"
#include "ode/geom/convert.hpp"
#include "ode/runtime/warm_start.hpp"

namespace supernormal::ode {
namespace {

// The maxima of s(n) do not depend on the radius: any sphere with this centre can use the cached normal.
const Shape& make_sphere(dGeomID geom, KeptShape& kept, std::uint32_t& kind) {
  kind = collider_kind(dSphereClass, {});
  return kept.emplace<Sphere>(dGeomSphereGetRadius(geom));
}

const Shape& make_box(dGeomID geom, KeptShape& kept, std::uint32_t& kind) {
  dVector3 lengths;
  dGeomBoxGetLengths(geom, lengths);
  kind = collider_kind(dBoxClass, {lengths[0], lengths[1], lengths[2]});
  return kept.emplace<Box>(0.5 * to_vector(lengths));
}

const Shape& make_capsule(dGeomID geom, KeptShape& kept, std::uint32_t& kind) {
  dReal radius = 0, length = 0;
  dGeomCapsuleGetParams(geom, &radius, &length);
  kind = collider_kind(dCapsuleClass, {radius, length});
  return kept.emplace<Capsule>(radius, 0.5 * double{length});
}

const Shape& make_cylinder(dGeomID geom, KeptShape& kept, std::uint32_t& kind) {
  dReal radius = 0, length = 0;
  dGeomCylinderGetParams(geom, &radius, &length);
  kind = collider_kind(dCylinderClass, {radius, length});
  return kept.emplace<Cylinder>(radius, 0.5 * double{length});
}

constexpr std::array<Primitive, 4> kPrimitives = {{
    {dSphereClass, make_sphere},
    {dBoxClass, make_box},
    {dCapsuleClass, make_capsule},
    {dCylinderClass, make_cylinder},
}};

}  // namespace

std::span<const Primitive> primitives() { return kPrimitives; }

const Primitive* find_primitive(int geom_class) {
  const auto* const found = std::ranges::find(kPrimitives, geom_class, &Primitive::geom_class);
  return found == kPrimitives.end() ? nullptr : found;
}

// The rotation of a sphere is irrelevant, so the sphere gets the rotation of our body. Its relative pose then changes only when its
// centre moves relative to the body.
ContactManifold query_primitive(dGeomID ours, dGeomID collider, QueryKind kind) {
  const int geom_class = dGeomGetClass(collider);
  KeptShape kept;
  std::uint32_t number = 0;
  const Shape& shape = find_primitive(geom_class)->make(collider, kept, number);
  const TestedPose pose =
      geom_class == dSphereClass ? tested_pose(dGeomGetPosition(collider), dGeomGetRotation(ours), ours) : tested_pose_of(collider);
  return solve_pair(ours, {collider, shape, pose, number}, kind);
}

}  // namespace supernormal::ode
