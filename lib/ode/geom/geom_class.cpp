#include "ode/geom/geom_class.hpp"

#include <atomic>
#include <csetjmp>
#include <cstdarg>
#include <cstdio>

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

// ODE does not report how many of its four user classes are taken. A fifth registration calls dDebug, which calls the debug handler
// and then abort(). So the handler must not return: it jumps back. The jump crosses only dCreateGeomClass, which tests the number
// first, and dDebug. Neither holds a lock or has a destructor to run.
thread_local std::jmp_buf* return_point = nullptr;
dMessageFunction* other_handler = nullptr;

extern "C" void on_debug(int number, const char* message, va_list arguments) {
  if (return_point != nullptr) std::longjmp(*return_point, 1);  // NOLINT(modernize-avoid-setjmp-longjmp)
  // Meanwhile, a failure in another thread has its usual consequences. ODE aborts afterwards.
  if (other_handler != nullptr) {
    other_handler(number, message, arguments);
    return;
  }
  std::fprintf(stderr, "\nODE INTERNAL ERROR %d: ", number);
  std::vfprintf(stderr, message, arguments);
  std::fputc('\n', stderr);
}

// The entry (dPlaneClass, dPlaneClass) in the collider table of ODE is empty, because ODE does not collide planes. We put a mark
// there. dInitODE2 clears the table when it really initialises.
thread_local bool mark_was_met = false;

extern "C" int meet_mark(dGeomID /*plane1*/, dGeomID /*plane2*/, int /*flags*/, dContactGeom* /*contacts*/, int /*skip*/) {
  mark_was_met = true;
  return 0;
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

int take_class_slot(const dGeomClass& geom_class) {
  std::jmp_buf here;
  other_handler = dGetDebugHandler();
  dSetDebugHandler(on_debug);
  volatile int number = -1;
  if (setjmp(here) == 0) {  // NOLINT(modernize-avoid-setjmp-longjmp,cert-err52-cpp)
    return_point = &here;
    number = dCreateGeomClass(&geom_class);
  }
  return_point = nullptr;
  dSetDebugHandler(other_handler);
  return number;
}

void mark_class_table() { dSetColliderOverride(dPlaneClass, dPlaneClass, meet_mark); }

bool class_table_is_marked() {
  mark_was_met = false;
  const dGeomID plane1 = dCreatePlane(nullptr, 0, 0, 1, 0);
  const dGeomID plane2 = dCreatePlane(nullptr, 0, 0, 1, 0);
  dContactGeom contact;
  dCollide(plane1, plane2, 1, &contact, sizeof contact);
  dGeomDestroy(plane1);
  dGeomDestroy(plane2);
  return mark_was_met;
}

}  // namespace supernormal::ode
