#include "ode/api/registration.hpp"

#include <atomic>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <string>

#include "base/validation.hpp"
#include "ode/colliders/collider.hpp"
#include "ode/geom/body.hpp"
#include "ode/geom/bounding_box.hpp"
#include "ode/geom/geom_class.hpp"
#include "ode/support/last_error.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::ode {
namespace {

std::mutex class_mutex;
std::atomic<int> live_geoms{0};
int last_class_number = -1;  // class number before the last snClose; guarded by class_mutex

// Another program may call dCreateGeom(snGeomClass()). The class data of this geom are zero, and every callback must accept them.
void destroy_geom_data(dGeomID geom) {
  Body* const body = static_cast<ClassData*>(dGeomGetClassData(geom))->body;
  if (body == nullptr) return;
  delete body;
  --live_geoms;
}

void require_same_precision() {
  const bool is_double = sizeof(dReal) == sizeof(double);
  if (dCheckConfiguration(is_double ? "ODE_double_precision" : "ODE_single_precision") != 0) return;
  throw std::runtime_error(std::string("this library was built for ODE with ") + (is_double ? "double" : "single") +
                           " precision, but the ODE library of this process reports: " + dGetConfiguration());
}

int register_class() {
  dGeomClass description{};
  description.bytes = sizeof(ClassData);
  description.collider = find_collider;
  description.aabb = compute_aabb;
  description.aabb_test = test_aabb;
  description.dtor = destroy_geom_data;
  const int number = take_class_slot(description);
  if (number >= 0) return number;
  throw std::runtime_error("ODE has no free geometry class: a process has " + std::to_string(dMaxUserClasses) +
                           ", and other code has registered all of them");
}

// ODE must be initialised. Our class outlives snClose if another client keeps ODE open.
int register_class_once() {
  if (last_class_number >= 0 && class_table_is_marked()) return last_class_number;
  const int number = register_class();
  // Fill the table now. Two threads may collide the first pair at once, and then dCollide must not write to the table.
  set_colliders(number);
  mark_class_table();
  return number;
}

void close() {
  const std::lock_guard lock(class_mutex);
  if (geom_class() < 0) return;
  if (live_geoms > 0) {
    throw std::runtime_error("live geoms = " + std::to_string(live_geoms) +
                             ", but must be 0: destroy them first; nothing was closed");
  }
  last_class_number = geom_class();
  set_geom_class(-1);
  dCloseODE();
}

}  // namespace

int require_geom_class() {
  if (const int number = geom_class(); number >= 0) return number;
  const std::lock_guard lock(class_mutex);
  if (const int number = geom_class(); number >= 0) return number;
  require_same_precision();
  if (dInitODE2(0) == 0) throw std::runtime_error("dInitODE2 failed");
  try {
    set_geom_class(register_class_once());
  } catch (...) {
    dCloseODE();
    throw;
  }
  return geom_class();
}

void require_space(dSpaceID space) {
  const auto geom = reinterpret_cast<dGeomID>(space);
  if (geom == nullptr || dGeomIsSpace(geom) != 0) return;
  throw std::invalid_argument("space is " + geom_class_name(geom) + ", but must be a space");
}

dGeomID create_geom(dSpaceID space, std::unique_ptr<Body> body) {
  require_space(space);
  const char* const names[] = {"the half-width of the shape along x", "the half-width of the shape along y",
                               "the half-width of the shape along z"};
  const Vector3 half = body->shape().half_extents();
  for (int axis = 0; axis < 3; ++axis) require_in(names[axis], half[axis], kMinLength, kMaxLength, "m");
  const dGeomID geom = dCreateGeom(require_geom_class());
  static_cast<ClassData*>(dGeomGetClassData(geom))->body = body.release();
  ++live_geoms;
  if (space != nullptr) dSpaceAdd(space, geom);
  return geom;
}

}  // namespace supernormal::ode

using namespace supernormal::ode;

extern "C" const char* snLastError(void) { return last_error(); }

extern "C" int snInit(void) {
  return succeeds("snInit", [] { require_geom_class(); });
}

extern "C" void snClose(void) {
  succeeds("snClose", [] { close(); });
}

extern "C" int snGeomClass(void) { return geom_class(); }
