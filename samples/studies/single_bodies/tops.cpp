// Spinning bodies with unexpected motions.
#include <algorithm>
#include <cmath>

#include "lab.hpp"
#include "rattleback.hpp"

namespace single_bodies {

Results rattleback() {
  Lab lab({fx::Gravity{{0, 0, -kGravity}}, fx::Friction{100, {}}}, 4e-6);
  lab.add_floor();
  Rattleback rattleback(lab.world(), lab.space(), -5);
  double reversal = 0;
  double smallest = 0;
  for (int step = 1; step * lab.step_length() < 2.9; ++step) {
    lab.step();
    rattleback.follow();
    smallest = std::min(smallest, rattleback.yaw());
    if (reversal == 0 && rattleback.spin() > 0) reversal = step * lab.step_length();
  }
  const char* const source = "Kane and Levinson 1982";
  return {{"rattleback, spun the wrong way with 5 rad/s", "first reversal, s", reversal, 2.3527, source},
          {"", "smallest yaw, rad", smallest, -6.81015, source}};
}

// A ball with its centre of mass below its centre turns upside down if it slides with friction. At any friction, the component of
// the angular momentum along the line from the centre of mass to the contact is conserved (Jellett 1872).
Results tippe_top() {
  const double radius = 0.02;
  const double offset = 0.3 * radius;
  const double m = 0.02;
  Lab lab({fx::Gravity{{0, 0, -kGravity}}, fx::Friction{0.1, {}}}, 2e-5);
  lab.add_floor();
  const dGeomID geom = snCreateEllipsoid(lab.space(), dReal(radius), dReal(radius), dReal(radius));
  dMass mass;
  const double I3 = 0.4 * m * radius * radius;
  const double I1 = 131.0 / 350 * m * radius * radius;
  dMassSetParameters(&mass, dReal(m), 0, 0, 0, dReal(I1), dReal(I1), dReal(I3), 0, 0, 0);
  const dBodyID body = lab.add(geom, mass);
  dGeomSetOffsetPosition(geom, 0, 0, dReal(offset));
  const double tilt = 0.3;
  turn(body, Vector3::UnitX(), tilt);
  set_position(body, {0, 0, radius - offset * std::cos(tilt)});
  set_spin(body, {0, 0, 155});
  const auto jellett = [&] {
    const Vector3 to_contact = offset * third_axis(body) - radius * Vector3::UnitZ();
    return -angular_momentum(body).dot(to_contact);
  };
  const double start = jellett();
  double worst = 0;
  for (int step = 0; step * lab.step_length() < 8; ++step) {
    lab.step();
    worst = std::max(worst, std::abs(jellett() / start - 1));
  }
  const double inclination = std::acos(std::min(1.0, std::max(-1.0, third_axis(body).z()))) / kDegree;
  return {{"tippe top, 155 rad/s, 8 s", "inclination at the end, degrees", inclination, 180,
           "turns over: Glad, Petersson and Rauch 2007"},
          {"", "largest change of Jellett's integral / itself", worst, 0, "conserved: Jellett 1872"}};
}

}  // namespace single_bodies
