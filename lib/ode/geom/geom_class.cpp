#include "ode/geom/geom_class.hpp"

#include <atomic>

namespace supernormal::ode {
namespace {

std::atomic<int> class_number{-1};

/// The name for messages. Null for user classes, spaces and dGeomTransform.
const char* builtin_name(int number) {
  switch (number) {
    case dSphereClass:
      return "a dSphere";
    case dBoxClass:
      return "a dBox";
    case dCapsuleClass:
      return "a dCapsule";
    case dCylinderClass:
      return "a dCylinder";
    case dPlaneClass:
      return "a dPlane";
    case dRayClass:
      return "a dRay";
    case dConvexClass:
      return "a dConvex";
    case dTriMeshClass:
      return "a dTriMesh";
    case dHeightfieldClass:
      return "a dHeightfield";
    default:
      return nullptr;
  }
}

}  // namespace

int geom_class() noexcept { return class_number.load(std::memory_order_acquire); }

void set_geom_class(int number) noexcept { class_number.store(number, std::memory_order_release); }

std::string geom_class_name(dGeomID geom) {
  const int number = dGeomGetClass(geom);
  if (number == geom_class()) return "a geom of this library's class";
  if (const char* const name = builtin_name(number)) return name;
  if (dGeomIsSpace(geom) != 0) return "a space";
  if (number == dGeomTransformClass) return "a dGeomTransform";
  return "a geom of user class " + std::to_string(number);
}

}  // namespace supernormal::ode
