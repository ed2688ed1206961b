// A world of ODE that owns its space and the contacts of a step.
#pragma once

#include <ode/ode.h>
#include <supernormal/supernormal.h>

#include <stdexcept>

namespace common {

/// What every measurement in ODE has. The caller chooses contacts and ODE's settings.
class OdeWorld {
 public:
  /// `space` is destroyed with the world; null if there is none.
  explicit OdeWorld(dSpaceID space) : space_(space) {}
  ~OdeWorld() {
    dJointGroupDestroy(joints_);
    if (space_ != nullptr) dSpaceDestroy(space_);
    dWorldDestroy(id_);
  }
  OdeWorld(const OdeWorld&) = delete;
  OdeWorld& operator=(const OdeWorld&) = delete;

  dWorldID id() const { return id_; }
  dSpaceID space() const { return space_; }

  /// A new body of this mass with the geom.
  dBodyID add(dGeomID geom, const dMass& mass) {
    const dBodyID body = dBodyCreate(id_);
    dBodySetMass(body, &mass);
    dGeomSetBody(geom, body);
    return body;
  }

  /// The same for a geom of ours with this density, kg/m^3. Throws std::runtime_error.
  dBodyID add(dGeomID geom, double density) {
    dMass mass;
    if (geom == nullptr || snMassSet(&mass, static_cast<dReal>(density), geom) == 0) throw std::runtime_error(snLastError());
    return add(geom, mass);
  }

  /// Calls near(geom1, geom2) for each pair of the space whose bounding boxes meet.
  template <typename Near>
  void collide(Near near) {
    dSpaceCollide(space_, &near, call<Near>);
  }

  /// The same for pairs of a geom of the space and one of another.
  template <typename Near>
  void collide_with(dSpaceID other, Near near) {
    dSpaceCollide2(reinterpret_cast<dGeomID>(space_), reinterpret_cast<dGeomID>(other), &near, call<Near>);
  }

  /// The contact acts in the next step.
  void join(const dContact& contact) { join(contact, dGeomGetBody(contact.geom.g1), dGeomGetBody(contact.geom.g2)); }
  void join(const dContact& contact, dBodyID body1, dBodyID body2) {
    dJointAttach(dJointCreateContact(id_, joints_, &contact), body1, body2);
  }

  /// Makes quickstep's step, s, and ends the contacts.
  void step(double step) {
    dWorldQuickStep(id_, static_cast<dReal>(step));
    dJointGroupEmpty(joints_);
  }

 private:
  template <typename Near>
  static void call(void* near, dGeomID geom1, dGeomID geom2) {
    (*static_cast<Near*>(near))(geom1, geom2);
  }

  dWorldID id_ = dWorldCreate();
  dSpaceID space_;
  dJointGroupID joints_ = dJointGroupCreate(0);
};

}  // namespace common
