#include "rocking.hpp"

#include <cmath>
#include <limits>

#include "common/ode_world.hpp"

namespace scene_cost {
namespace {

using common::grain_maker;
using common::GrainForm;
using common::OdeGeom;

constexpr double kGravity = 9.81;
constexpr double kA = 0.3, kB = 0.2, kC = 0.1;  // m; the half-axes
constexpr double kTilt = 0.3;                   // rad, about y
// The period from conservation of energy, g h(theta) + (I + h'^2) theta'^2 / 2 = g h(tilt), by quadrature, s: see
// tests/dynamics/rocking_test.cpp.
constexpr double kPeriod = 0.489837517;
constexpr double kStep = 1e-4;  // s; error of the period below 1e-4
constexpr int kPeriods = 3;
constexpr int kMaxContacts = 5;

constexpr common::GrainBody kEllipsoid{{kA, kB, kC}};
constexpr double kDensity = 1000;  // kg/m^3

class Rocking {
 public:
  explicit Rocking(const GrainForm& form) : geom_(grain_maker(form, kEllipsoid)()), floor_(dCreateBox(nullptr, 2, 2, 1)) {
    dGeomSetPosition(floor_.id(), 0, 0, -0.5);
    dWorldSetGravity(world_.id(), 0, 0, -kGravity);
    dWorldSetERP(world_.id(), 0.8);  // the constraint acts on velocities: without ERP the centre lags behind the rising support
    const OdeGeom exact = grain_maker({}, kEllipsoid)();
    dMass mass;
    snMassSet(&mass, kDensity, exact.id());
    dBodySetMass(body_, &mass);
    dGeomSetBody(geom_.id(), body_);
    dQuaternion orientation;
    dQFromAxisAndAngle(orientation, 0, 1, 0, kTilt);
    dBodySetQuaternion(body_, orientation);
    dBodySetPosition(body_, 0, 0, std::hypot(kA * std::sin(kTilt), kC * std::cos(kTilt)));  // touching
  }

  /// Steps the world. Returns the angle about y, rad.
  double step() {
    std::array<dContactGeom, kMaxContacts> found;
    dReal aabb[6];
    dGeomGetAABB(geom_.id(), aabb);  // a space does this before dCollide
    const int count = dCollide(geom_.id(), floor_.id(), kMaxContacts, found.data(), sizeof(dContactGeom));
    for (int k = 0; k < count; ++k) {
      dContact contact{};
      contact.geom = found[static_cast<std::size_t>(k)];
      if (!(std::abs(dCalcVectorLength3(contact.geom.normal) - 1) < 1e-6)) continue;  // libccd makes such contacts
      world_.join(contact);
    }
    world_.step(kStep);
    const dReal* const q = dBodyGetQuaternion(body_);
    return 2 * std::atan2(q[2], q[0]);
  }

 private:
  common::OdeWorld world_{nullptr};
  dBodyID body_ = dBodyCreate(world_.id());
  OdeGeom geom_, floor_;
};

}  // namespace

double rocking_error(const GrainForm& form) {
  Rocking rocking(form);
  int passages = 0;
  double first = 0;
  double before = kTilt;
  for (int step = 1; step * kStep < 2 * (kPeriods + 1) * kPeriod; ++step) {
    const double theta = rocking.step();
    if (theta * before < 0) {
      const double time = kStep * (step - theta / (theta - before));
      if (passages == 0) first = time;
      if (passages == 2 * kPeriods) return std::abs((time - first) / kPeriods / kPeriod - 1);
      ++passages;
    }
    before = theta;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace scene_cost
