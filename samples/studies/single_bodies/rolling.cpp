// Rocking, rolling, tipping over and skipping.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "lab.hpp"

namespace single_bodies {
namespace {

fx::Gravity earth() { return {{0, 0, -kGravity}}; }

/// Gravity in the frame of an incline that falls along x.
fx::Gravity incline_of(double angle) { return {{kGravity * std::sin(angle), 0, -kGravity * std::cos(angle)}}; }

/// s; the mean of ten periods of an ellipsoid that is released at a small tilt.
double rocking_period(const std::vector<fx::Effect>& effects) {
  const double tilt = 0.01;
  Lab lab(effects, 1e-4);
  lab.add_floor();
  const dGeomID geom = snCreateEllipsoid(lab.space(), dReal(0.3), dReal(0.2), dReal(0.1));
  const dBodyID body = lab.add(geom, 1000);
  turn(body, Vector3::UnitY(), tilt);
  set_position(body, {0, 0, std::hypot(0.3 * std::sin(tilt), 0.1 * std::cos(tilt))});
  double first = 0;
  double last = 0;
  int crossings = 0;
  double before = 0;
  for (int step = 1; crossings < 11; ++step) {
    lab.step();
    const double rate = spin(body).y();
    if (before < 0 && rate >= 0) {
      last = (step - rate / (rate - before)) * lab.step_length();
      if (crossings++ == 0) first = last;
    }
    before = rate;
  }
  return (last - first) / 10;
}

/// The downhill acceleration of a body with a circular equator, over the acceleration of sliding without friction.
double rolling_ratio(double epsilon) {
  const double angle = 10 * kDegree;
  Lab lab({incline_of(angle), fx::Friction{0.8, {}}}, 1e-4);
  lab.add_floor();
  const dBodyID body = lab.add(snCreateSuperellipsoid(lab.space(), dReal(0.1), dReal(0.1), dReal(0.1), 2, dReal(epsilon)), 1000);
  turn(body, Vector3::UnitX(), 90 * kDegree);  // it rolls about its z-axis
  set_position(body, {0, 0, 0.1});
  for (int step = 0; step < 10000; ++step) lab.step();
  return velocity(body).x() / (kGravity * std::sin(angle));
}

/// Degrees; the incline at which a body with a superelliptic section of equal half-axes tips over. The incline gets steeper by a
/// degree in ten seconds.
double greatest_incline(double exponent, double start) {
  Lab lab({earth(), fx::Friction{2, {}}, fx::Damping{0, 5}}, 1e-3);
  lab.add_floor();
  const auto e = static_cast<dReal>(exponent);
  // The section is in the xz-plane. The body is long across it, so it only tips about y.
  const dBodyID body = lab.add(snCreateSuperellipsoid(lab.space(), dReal(0.1), dReal(0.3), dReal(0.1), e, e), 1000);
  set_position(body, {0, 0, 0.1});
  double angle = 0;
  for (int step = 0; dBodyGetRotation(body)[10] > std::cos(60 * kDegree); ++step) {
    const double time = step * lab.step_length();
    angle = time < 1 ? start * time : start + 0.1 * (time - 1);
    const Vector3 g = incline_of(angle * kDegree).acceleration;
    dWorldSetGravity(lab.world(), static_cast<dReal>(g.x()), 0, static_cast<dReal>(g.z()));
    lab.step();
  }
  return angle;
}

struct Flight {
  double time, x, top;
};

/// The place of a point's landing number `landings`, with linear drag of the time constant tau and restitution e, in closed form
/// between impacts.
Flight fly(double height, double speed, double tau, double e, int landings) {
  Flight flight{0, 0, height};
  double up = 0;
  double start = height;
  for (int landing = 0; landing < landings; ++landing) {
    const auto z = [&](double t) { return start + tau * (up + kGravity * tau) * (1 - std::exp(-t / tau)) - kGravity * tau * t; };
    double low = up > 0 ? tau * std::log1p(up / (kGravity * tau)) : 0;  // the top of the flight
    flight.top = z(low);
    double high = low + 10;
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (low + high);
      (z(middle) > 0 ? low : high) = middle;
    }
    up = -e * ((up + kGravity * tau) * std::exp(-low / tau) - kGravity * tau);
    start = 0;
    flight.time += low;
  }
  flight.x = speed * tau * (1 - std::exp(-flight.time / tau));
  return flight;
}

}  // namespace

Results rocking() {
  return {{"rocking ellipsoid 0.3, 0.2, 0.1 m", "period without friction, s", rocking_period({earth()}), 0.317495960,
           "closed form, small angles"},
          {"", "period of rolling, s", rocking_period({earth(), fx::Friction{100, {}}}), 0.388773991, "closed form, small angles"}};
}

Results rolling() {
  return {{"rolling down an incline, circular equator", "a / (g sin), ball", rolling_ratio(2), 0.714286, "closed form"},
          {"", "a / (g sin), epsilon = 4", rolling_ratio(4), 0.686033, "closed form"},
          {"", "a / (g sin), epsilon = 8", rolling_ratio(8), 0.673540, "closed form"}};
}

Results incline() {
  return {{"superelliptic section on an incline", "tips over from, degrees, exponent 4", greatest_incline(4, 18.5), 19.4712,
           "closed form"},
          {"", "tips over from, degrees, exponent 8", greatest_incline(8, 29.5), 30.3696, "closed form"}};
}

Results skipping_bean() {
  // A bean that lies across its flight has the same projected area and the same curvature in every direction of that plane.
  const double radius = 0.004;
  const double viscosity = 0.05;
  const double e = 0.8;
  const double height = 0.3;
  const double speed = 2;
  Lab lab({earth(), fx::StokesDrag{viscosity}, fx::Restitution{e, 0.02, {}}}, 2e-5);
  lab.add_floor();
  const dBodyID bean = lab.add(snCreateEllipsoid(lab.space(), dReal(radius), dReal(0.007), dReal(radius)), 1300);
  set_position(bean, {0, 0, radius + height});
  set_velocity(bean, {speed, 0, 0});
  const int landings = 5;
  Flight ours{0, 0, 0};
  int seen = 0;
  double before = 0;
  for (int step = 1; seen < landings; ++step) {
    lab.step();
    const double up = velocity(bean).z();
    if (before < 0 && up > 0) {
      ours.time = step * lab.step_length();
      ours.x = position(bean).x();
      if (++seen < landings) ours.top = 0;
    }
    ours.top = std::max(ours.top, position(bean).z() - radius);
    before = up;
  }
  // Leith's diameter, with the surface of the prolate spheroid.
  const double pi = std::numbers::pi;
  const double c = 0.007;
  const double ecc = std::sqrt(1 - radius * radius / (c * c));
  const double surface = 2 * pi * radius * radius * (1 + c / (radius * ecc) * std::asin(ecc));
  const double diameter = std::sqrt(4 * radius * c) / 3 + 2 * std::sqrt(surface / pi) / 3;
  const double tau = mass_of(bean) / (3 * pi * viscosity * diameter);
  const Flight exact = fly(height, speed, tau, e, landings);
  return {{"bean that skips over a floor under drag", "time of the fifth landing, s", ours.time, exact.time,
           "closed form from impact to impact"},
          {"", "its distance, m", ours.x, exact.x, "closed form"},
          {"", "height of the leap before, m", ours.top, exact.top, "closed form"}};
}

}  // namespace single_bodies
