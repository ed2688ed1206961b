// Rigid and elastic impacts against their closed forms.
#include <doctest/doctest.h>

#include <array>
#include <vector>

#include "effects/effects_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

struct Impact {
  double time = 0;     ///< s, in contact
  double overlap = 0;  ///< m, the largest
  double out = 0;      ///< m/s
};

/// Lets a body fly without gravity down onto the plane z = 0 and off again.
Impact impact(EffectsWorld& scene, dBodyID body, double speed, double step) {
  dBodySetLinearVel(body, 0, 0, dReal(-speed));
  Impact found;
  bool touched = false;
  scene.run_until(0.1, [&] {
    if (scene.depth > 0) {
      touched = true;
      found.time += step;
    }
    found.overlap = std::max(found.overlap, scene.depth);
    return touched && scene.depth == 0;
  });
  found.out = dBodyGetLinearVel(body)[2];
  return found;
}

/// The largest overlap under the force law F = k depth^(3/2) of a mass m that hits with velocity v (Johnson, section 11.4).
double hertz_overlap(double m, double k, double v) { return std::pow(1.25 * m * v * v / k, 0.4); }
double hertz_time(double m, double k, double v) { return 2.9432675 * hertz_overlap(m, k, v) / v; }

constexpr double kModulus = 5e7;  // Pa
constexpr double kPoisson = 0.3;
constexpr double kStar = kModulus / (1 - kPoisson * kPoisson);  // against a rigid plane

/// A cuboid as a geom of each kind. It holds what a dConvex and a dTriMesh refer to.
class Cuboid {
 public:
  explicit Cuboid(const Vec& half) : half_(half), data_(dGeomTriMeshDataCreate()) {
    for (int k = 0; k < 8; ++k) {
      for (std::size_t i = 0; i < 3; ++i) points_.push_back(dReal((k >> i & 1) != 0 ? half[i] : -half[i]));
    }
    vertices_.assign(points_.begin(), points_.end());
    dGeomTriMeshDataBuildSingle(data_, vertices_.data(), 3 * sizeof(float), 8, triangles_.data(), 36, 3 * sizeof(dTriIndex));
  }
  ~Cuboid() { dGeomTriMeshDataDestroy(data_); }
  Cuboid(const Cuboid&) = delete;
  Cuboid(Cuboid&&) = delete;
  Cuboid& operator=(const Cuboid&) = delete;
  Cuboid& operator=(Cuboid&&) = delete;

  dGeomID create(int number, dSpaceID space) const {
    const auto a = dReal(half_[0]), b = dReal(half_[1]), c = dReal(half_[2]);
    if (number == dBoxClass) return dCreateBox(space, 2 * a, 2 * b, 2 * c);
    if (number == dConvexClass) return dCreateConvex(space, planes_.data(), 1, points_.data(), 8, polygon_.data());
    if (number == dTriMeshClass) return dCreateTriMesh(space, data_, nullptr, nullptr, nullptr);
    return snCreateSuperellipsoid(space, a, b, c, 20, 20);
  }

 private:
  Vec half_;
  std::vector<dReal> points_;
  std::vector<float> vertices_;
  std::array<dReal, 4> planes_ = {0, 0, -1, 1};  // ODE's dConvex meets a dPlane with its points alone
  std::array<unsigned, 4> polygon_ = {3, 0, 2, 1};
  std::array<dTriIndex, 36> triangles_ = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                          2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  dTriMeshDataID data_;
};

}  // namespace

TEST_CASE("a ball that falls from h bounces to e^2 h") {
  for (const double e : {0.5, 0.9}) {
    const double height = 0.5;
    OnPlane scene({earth(), fx::Restitution{e, 0.05, {}}}, 1e-4);
    const dBodyID ball = scene.add_ball(kRadius, kDensity, {0, 0, kRadius + height});
    const auto velocity = [&] { return double{dBodyGetLinearVel(ball)[2]}; };
    double top = height;
    for (int bounce = 0; bounce < 3; ++bounce) {
      scene.run_until(1, [&] { return velocity() > 0; });
      scene.run_until(1, [&] { return velocity() <= 0; });
      const double reached = dBodyGetPosition(ball)[2] - kRadius;
      CHECK(reached == relative(e * e * top).epsilon(0.01));
      top = reached;
    }
  }
}

TEST_CASE("a body slower than the threshold does not bounce") {
  OnPlane scene({fx::Restitution{0.8, 0.2, {}}}, 1e-3);
  const dBodyID ball = scene.add_ball(kRadius, kDensity, {0, 0, kRadius});
  dBodySetLinearVel(ball, 0, 0, dReal(-0.19));
  scene.run_until(0.01);
  CHECK(dBodyGetLinearVel(ball)[2] < 0.05);  // the velocity by which the overlap of a step is pushed out
  dBodySetPosition(ball, 0, 0, dReal(kRadius));
  dBodySetLinearVel(ball, 0, 0, dReal(-0.21));
  scene.run_until(0.01);
  CHECK(dBodyGetLinearVel(ball)[2] == relative(0.8 * 0.21).epsilon(within_rounding(1e-6, 100)));
}

TEST_CASE("energy never grows at restitution up to 1") {
  // In free flight ODE's steps keep v^2/2 + g z up to a term that depends on the velocity alone. So energies are compared after
  // whole bounces.
  for (const double e : {0.7, 1.0}) {
    OnPlane scene({earth(), fx::Restitution{e, 0, {}}}, 5e-4);
    Random random(3);
    const dGeomID geom = snCreateEllipsoid(scene.world.space(), dReal(0.05), dReal(0.04), dReal(0.02));
    random.turn(geom);
    const dBodyID body = scene.add(geom, kDensity, {0, 0, 0.3});
    const double start = energy(body);
    double most = 0;
    for (int i = 0; i < 10000; ++i) {
      scene.step();
      if (std::abs(dBodyGetLinearVel(body)[2]) < 0.01) most = std::max(most, energy(body));
    }
    CHECK(most > 0);
    CHECK(most < 1.002 * start);
  }
}

TEST_CASE("a spring and damper give the contact time, overlap and rebound of the closed form") {
  const double k = 2000;
  const double v = 0.4;
  const double mass = kDensity * 4.0 / 3 * std::numbers::pi * std::pow(kRadius, 3);
  const double w = std::sqrt(k / mass);
  for (const double ratio : {0.0, 0.1, 0.3}) {  // relative to the critical damping
    CAPTURE(ratio);
    const double step = std::numbers::pi / w / 100;
    OnPlane scene({fx::Compliance{k, 2 * ratio * mass * w, {}}}, step);
    const Impact found = impact(scene, scene.add_ball(kRadius, kDensity, {0, 0, kRadius + 1e-5}), v, step);
    // The contact lasts until the force vanishes (Schwager and Poeschel, Granular Matter 9, 2007).
    const double beta = ratio * w;
    const double damped = std::sqrt(w * w - beta * beta);
    const double end = (std::numbers::pi - std::atan2(2 * beta * damped, damped * damped - beta * beta)) / damped;
    CHECK(found.out == relative(v * std::exp(-beta * end)).epsilon(0.01));
    if (ratio == 0) {
      CHECK(found.time == relative(std::numbers::pi / w).epsilon(1e-4));
      CHECK(found.overlap == relative(v / w).epsilon(within_rounding(8e-4, 1000)));
    } else {
      const double peak = std::atan2(damped, beta) / damped;
      CHECK(found.overlap == relative(v / w * std::exp(-beta * peak)).epsilon(0.02));
    }
  }
}

TEST_CASE("springs of two materials are in series, also of equal materials; a listed pair or all materials have one spring") {
  struct Case {
    std::vector<fx::Effect> list;
    fx::Material of_plane;
    double stiffness;
  };
  const double k = 3000;
  const std::vector<Case> cases = {
      {{fx::Compliance{k, 0, fx::MaterialSelector::of(1)}, fx::Compliance{2 * k, 0, fx::MaterialSelector::of(2)}}, 2, 2 * k / 3},
      {{fx::Compliance{k, 0, fx::MaterialSelector::of(1)}}, 2, k},
      {{fx::Compliance{k, 0, fx::MaterialSelector::of(1)}}, 1, k / 2},
      {{fx::Compliance{k, 0, fx::MaterialSelector::of(1)}, fx::Compliance{2 * k, 0, {}}}, 2, 2 * k / 3},
      {{fx::Compliance{k, 0, fx::MaterialSelector::between(1, 2)}}, 2, k},
      {{fx::Compliance{k, 0, {}}}, 1, k},
  };
  const double v = 0.4;
  const double mass = kDensity * 4.0 / 3 * std::numbers::pi * std::pow(kRadius, 3);
  const double step = std::numbers::pi / std::sqrt(k / mass) / 100;
  for (const Case& c : cases) {
    OnPlane scene(c.list, step);
    scene.material_of = [&](dGeomID geom) { return dGeomGetBody(geom) != nullptr ? 1 : c.of_plane; };
    const Impact found = impact(scene, scene.add_ball(kRadius, kDensity, {0, 0, kRadius + 1e-5}), v, step);
    CHECK(found.overlap == relative(v / std::sqrt(c.stiffness / mass)).epsilon(within_rounding(1.2e-3, 1000)));
  }
}

TEST_CASE("Hertz: a ball on a plane has the contact time and overlap of the closed form") {
  const double v = 0.5;
  const double mass = kDensity * 4.0 / 3 * std::numbers::pi * std::pow(kRadius, 3);
  const double k = 4.0 / 3 * kStar * std::sqrt(kRadius);
  for (const double steps : {200.0, 25.0}) {  // the contact lasts this many steps
    CAPTURE(steps);
    const double step = hertz_time(mass, k, v) / steps;
    OnPlane scene({fx::Hertz{kModulus, kPoisson, 1, fx::MaterialSelector::of(1)}}, step);
    scene.material_of = [](dGeomID geom) { return dGeomGetBody(geom) != nullptr ? 1 : 0; };
    const Impact found = impact(scene, scene.add_ball(kRadius, kDensity, {0, 0, kRadius + 0.3 * v * step}), v, step);
    CHECK(found.overlap == relative(hertz_overlap(mass, k, v)).epsilon(0.01));
    CHECK(std::abs(found.time - hertz_time(mass, k, v)) < 0.01 * hertz_time(mass, k, v) + step);
    CHECK(found.out == relative(v).epsilon(0.01));
    CHECK(cost_of(scene.effects, "hertz").coarse == 0);
  }
}

TEST_CASE("Hertz: an ellipsoid on a plane and two balls have the force of the exact solution") {
  // The exact solution for the ellipse k = b/a = 0.5: R'/R'' = 2.842753308671, F2 = 0.985172455666.
  const double ratio = 2.8427533086709977;
  const double correction = 0.9851724556662358;
  const double c = 0.01;
  const double a = 0.02;
  const double b = a / std::sqrt(ratio);
  const double v = 0.3;
  const double mass = kDensity * 4.0 / 3 * std::numbers::pi * a * b * c;
  const double k = 4.0 / 3 * kStar * std::sqrt(a * b / c) * std::pow(correction, -1.5);  // radii a^2/c, b^2/c
  const double step = hertz_time(mass, k, v) / 100;
  {
    EffectsWorld scene({fx::Hertz{2 * kModulus, kPoisson, 1, {}}}, step);  // two materials of twice the modulus
    scene.world.add_plane();
    const Impact found = impact(scene, scene.add_body({a, b, c}, 2, kDensity, {0, 0, c + 1e-6}), v, step);
    CHECK(found.overlap == relative(hertz_overlap(mass, k, v)).epsilon(0.005));
    CHECK(found.time == relative(hertz_time(mass, k, v)).epsilon(1e-4));
    CHECK(found.out == relative(v).epsilon(0.01));
  }
  {
    const double ball_mass = kDensity * 4.0 / 3 * std::numbers::pi * std::pow(kRadius, 3);
    const double pair_k = 4.0 / 3 * kStar * std::sqrt(kRadius / 2);
    EffectsWorld scene({fx::Hertz{2 * kModulus, kPoisson, 1, {}}}, step);
    const dBodyID low = scene.add_ball(kRadius, kDensity, {0, 0, -kRadius});
    const dBodyID high = scene.add_ball(kRadius, kDensity, {0, 0, kRadius + 1e-6});
    dBodySetLinearVel(low, 0, 0, dReal(v));
    const Impact found = impact(scene, high, v, step);
    CHECK(found.overlap == relative(hertz_overlap(ball_mass / 2, pair_k, 2 * v)).epsilon(0.005));
    CHECK(found.out == relative(v).epsilon(0.01));
  }
}

TEST_CASE("Hertz: a flat body sinks as a punch as wide as the mean of its half-extents, however it is turned") {
  const Vec half = {0.1, 0.02, 0.01};
  const double mass = kDensity * 8 * half[0] * half[1] * half[2];
  const double depth = mass * kGravity / (2 * kStar * (half[0] + half[1] + half[2]) / 3);
  const Cuboid cuboid(half);
  for (const int kind : {-1, int{dBoxClass}, int{dConvexClass}, int{dTriMeshClass}}) {
    for (const double heading : {0.0, 0.7853981633974483}) {
      CAPTURE(kind);
      CAPTURE(heading);
      OnPlane scene({earth(), fx::Hertz{2 * kModulus, kPoisson, 0.3, {}}}, kStep);
      dMass inertia;
      dMassSetBoxTotal(&inertia, dReal(mass), dReal(2 * half[0]), dReal(2 * half[1]), dReal(2 * half[2]));
      const dBodyID body = scene.world.add(cuboid.create(kind, scene.world.space()), inertia);
      turn(body, {0, 0, 1}, heading);
      dBodySetPosition(body, 0, 0, dReal(half[2]));
      scene.effects.add_body(body);
      scene.run_until(0.5);
      CHECK(half[2] - double{dBodyGetPosition(body)[2]} == relative(depth).epsilon(0.01));
    }
  }
}

TEST_CASE("Hertz: an impact rebounds with the given restitution at every velocity") {
  for (const double e : {0.2, 0.6, 0.9}) {
    for (const double v : {0.02, 2.0}) {
      CAPTURE(e);
      CAPTURE(v);
      const double mass = kDensity * 4.0 / 3 * std::numbers::pi * std::pow(kRadius, 3);
      const double step = hertz_time(mass, 4.0 / 3 * kStar * std::sqrt(kRadius), v) / 200;
      OnPlane scene({fx::Hertz{2 * kModulus, kPoisson, e, {}}}, step);
      const Impact found = impact(scene, scene.add_ball(kRadius, kDensity, {0, 0, kRadius + 0.1 * v * step}), v, step);
      CHECK(found.out == relative(e * v).epsilon(0.02));
    }
  }
}

TEST_CASE("a compliant contact that is too stiff for the step is counted and gains no energy") {
  OnPlane scene({earth(), fx::Compliance{1e9, 0, {}}}, 1e-3);
  const dBodyID ball = scene.add_ball(kRadius, kDensity, {0, 0, 0.1});
  const double start = energy(ball);
  double most = 0;
  for (int i = 0; i < 3000; ++i) {
    scene.step();
    if (dBodyGetPosition(ball)[2] > kRadius) most = std::max(most, energy(ball));
  }
  CHECK(most < 1.01 * start);
  CHECK(cost_of(scene.effects, "compliance").coarse > 0);
}

TEST_CASE("a flat body rests on springs at the depth where they carry its weight") {
  const double k = 1e5;
  OnPlane scene({earth(), fx::Friction{0.5, {}}, fx::Compliance{k, 300, {}}}, 5e-4);
  const dBodyID body = scene.add_body({0.1, 0.07, 0.05}, 8, 1000, {0, 0, 0.055});
  turn(body, {1, 0.5, 0}, 2 * kDegree);
  scene.run_until(3);
  CHECK(scene.depth == relative(mass_of(body) * kGravity / k).epsilon(1e-4));
  // The remaining motion is no more than with rigid contacts, half of g times the step (samples/studies/README.md).
  CHECK(norm(to_vec(dBodyGetLinearVel(body))) < 0.5 * kGravity * 5e-4);
  CHECK(norm(to_vec(dBodyGetAngularVel(body))) < 0.5 * kGravity * 5e-4 / 0.05);
}
