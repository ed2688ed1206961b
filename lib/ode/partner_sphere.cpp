// Our bodies and dSphere.
#include "ode/convert.hpp"
#include "ode/partner.hpp"
#include "ode/solve_pair.hpp"
#include "ode/warm_start.hpp"
#include "supernormal/shapes/sphere.hpp"

namespace supernormal::ode {

// However the sphere is turned, it is as good as turned with the body: so it has the same place as long as it has the same place on
// the body. And the normals at which s has its maxima do not depend on the radius: any sphere that has come to this place will do.
ContactManifold query_sphere(dGeomID ours, dGeomID partner, Goal goal) {
  const Sphere sphere(dGeomSphereGetRadius(partner));
  const Pose pose{to_vector(dGeomGetPosition(partner)), rotation_of(ours)};
  return solve_pair(ours, {sphere, pose, partner_kind(dSphereClass, {})}, goal);
}

}  // namespace supernormal::ode
