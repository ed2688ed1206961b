// Tests of parts that move in a world with grains, against closed forms.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "scenes.hpp"
#include "support/relative.hpp"
#include "world/stepper.hpp"
#include "world/world.hpp"

using namespace falling_particles;
using supernormal::test::relative;
namespace fx = supernormal::effects;

namespace {

constexpr double kFall = 9.81;
constexpr double kStepOfWalls = 2e-4;
constexpr double kTurn = 6.3;  // rad/s, of a turntable

GrainKind light_ball() { return {"ball", {5e-3, 5e-3, 5e-3}, 2, 2, 0, 2000, "test"}; }
GrainKind brick() { return {"brick", {0.01, 0.01, 4e-3}, 20, 20, 0, 2000, "test"}; }

WallMotion motion(decltype(WallMotion::kind) kind) { return {std::move(kind)}; }

/// One grain over parts.
Scene scene_on(std::vector<Wall> walls, const GrainKind& kind, std::vector<fx::Effect> effects) {
  Scene scene = scene_of(Open{{{-0.1, -0.1, 0}, {0.2, 0.2, 1}}, {{-1, -1, -1}, {2, 2, 3}}}, {{kind, 1}});
  scene.walls = std::move(walls);
  scene.effects = std::move(effects);
  scene.effects.emplace_back(fx::Gravity{{0, 0, -kFall}});
  scene.time = {2, kStepOfWalls, 0.1};
  return scene;
}

Wall plane(std::vector<WallMotion> motions) { return {"floor", PlaneShape{}, {}, std::move(motions)}; }

Placement at(double z) { return {0, {0, 0, z}, {1, 0, 0, 0}}; }

double height(const World& world) { return world.grains()[0].position()[2]; }
double speed(const World& world, int axis) { return dBodyGetLinearVel(world.grains()[0].body)[axis]; }

/// A plate that vibrates with a phase such that it starts in the middle, upwards.
Vibration shaking(double amplitude, double frequency) { return {{0, 0, amplitude}, frequency, 0}; }

/// The times when the grain first leaves the plate and when it meets the plate again; NaN if it does not leave.
struct GrainFlight {
  double start = NAN, end = NAN;
};
GrainFlight fly(double amplitude, double frequency, double duration) {
  const Scene scene = scene_on({plane({motion(shaking(amplitude, frequency))})}, light_ball(), {fx::SurfaceLayer{1e-7}});
  World world(scene, {at(5e-3)});
  Stepper stepper(world, scene);
  GrainFlight flight;
  for (int step = 1; step * kStepOfWalls < duration; ++step) {
    stepper.step();
    const bool touches = stepper.contacts() > 0;
    if (!touches && std::isnan(flight.start)) flight.start = step * kStepOfWalls;
    if (touches && !std::isnan(flight.start)) {
      flight.end = step * kStepOfWalls;
      break;
    }
  }
  return flight;
}

}  // namespace

TEST_CASE(
    "a grain takes off from a vibrating plate when the plate falls faster than the grain, and lands where its parabola meets the "
    "plate") {
  constexpr double kFrequency = 20;
  const double omega = 2 * std::numbers::pi * kFrequency;
  for (const double throw_number : {1.5, 2.5}) {
    CAPTURE(throw_number);
    const double amplitude = throw_number * kFall / (omega * omega);
    const double take_off = std::asin(1 / throw_number) / omega;
    const double z0 = amplitude * std::sin(omega * take_off);
    const double v0 = amplitude * omega * std::cos(omega * take_off);
    const auto above = [&](double t) {
      const double s = t - take_off;
      return z0 + v0 * s - kFall / 2 * s * s - amplitude * std::sin(omega * t);
    };
    double low = take_off + 1e-3;
    double high = take_off + 1 / kFrequency;
    while (high - low > 1e-9) (above((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
    const GrainFlight flight = fly(amplitude, kFrequency, 0.3);
    CHECK(std::abs(flight.start - take_off) < 3 * kStepOfWalls);
    CHECK(flight.end == relative(low).epsilon(0.01));
  }
  CHECK(std::isnan(fly(0.98 * kFall / (omega * omega), kFrequency, 0.5).start));
}

TEST_CASE("a brick on a conveyor has its speed after v / (mu g), and the conveyor stands") {
  constexpr double kSpeed = 0.4;
  for (const bool is_plane : {true, false}) {
    CAPTURE(is_plane);
    Wall belt = plane({motion(Conveyor{{kSpeed, 0, 0}, {Vector3::UnitZ(), Vector3::Zero(), 0}})});
    if (!is_plane) {
      belt.shape = BoxShape{{1, 1, 0.02}};
      belt.start.position.z() = -0.01;
    }
    const double mu = 0.3;
    const Scene scene = scene_on({belt}, brick(), {fx::Friction{mu, {}}, fx::SurfaceLayer{1e-5}});
    World world(scene, {at(4e-3)});
    Stepper stepper(world, scene);
    double time = 0;
    while (speed(world, 0) < 0.999 * kSpeed && time < 1) {
      stepper.step();
      time += kStepOfWalls;
    }
    CHECK(time == relative(kSpeed / (mu * kFall)).epsilon(0.01));
    for (int i = 0; i < 500; ++i) stepper.step();
    CHECK(speed(world, 0) == relative(kSpeed).epsilon(1e-3));
    CHECK(world.walls().state(0).pose.position == belt.start.position);
  }
}

TEST_CASE("a part's own friction holds for this part only") {
  std::string text = kSceneText;
  text.append("[[part]]\nname = \"ice\"\nshape = \"plane\"\nfriction = 0.1\n[[part]]\nname = \"rock\"\nshape = \"plane\"\n");
  const Scene scene = scene_of(text);
  std::vector<fx::Friction> found;
  for (const fx::Effect& effect : scene.effects) {
    if (const auto* friction = std::get_if<fx::Friction>(&effect)) found.push_back(*friction);
  }
  REQUIRE(found.size() == 2);
  CHECK(found[1].coefficient == 0.1);
  const World world(scene, {});
  const std::size_t sides = scene.walls.size() - scene.parts().size();
  const auto material = [&](std::size_t part) { return world.walls().side_of(world.walls().geoms()[sides + part]).material; };
  CHECK(found[1].on == fx::MaterialSelector::between(0, material(0)));
  CHECK(material(0) != material(1));
}

TEST_CASE("the pose of a wall is a function of time, for any step") {
  const std::vector<WallMotion> motions = {motion(Rotation{Vector3(1, 2, 2).normalized(), {0.1, 0, 0}, 50}),
                                           motion(shaking(0.01, 7)), motion(Translation{{0.1, 0, 0}})};
  Wall wall{"paddle", BoxShape{{0.1, 0.02, 0.05}}, {{0.2, 0.3, 0.5}, Eigen::Quaterniond::Identity()}, motions};
  const WallPose wanted = pose_at(wall.start, motions, 0.5);
  for (const double step : {1e-4, 1e-3, 1.0 / 300}) {
    Scene scene = scene_on({wall}, light_ball(), {});
    scene.time.step = step;
    const World world(scene, {at(0.9)});
    Stepper stepper(world, scene);
    const auto steps = std::lround(0.5 / step);
    for (int i = 0; i < steps; ++i) stepper.step();
    const WallPose pose = world.walls().state(0).pose;
    CHECK((pose.position - wanted.position).norm() < 1e-14);
    CHECK(pose.rotation.angularDistance(wanted.rotation) < 1e-7);  // its arccosine
    const dReal* p = dGeomGetPosition(world.walls().geoms()[0]);
    CHECK((Vector3(p[0], p[1], p[2]) - wanted.position).norm() < 1e-14);
  }
}

TEST_CASE("a plate that begins to move wakes a sleeping grain; a plate that stands does not") {
  WallMotion later = motion(Translation{{0, 0, 0.05}});
  later.from = 0.3;
  const Scene scene = scene_on({plane({later})}, light_ball(), {fx::AutoDisable{0.01, 1, 0, 10}, fx::SurfaceLayer{1e-5}});
  const World world(scene, {at(5e-3)});
  Stepper stepper(world, scene);
  for (int i = 0; i * kStepOfWalls < 0.299; ++i) stepper.step();
  CHECK(dBodyIsEnabled(world.grains()[0].body) == 0);
  for (int i = 0; i * kStepOfWalls < 0.2; ++i) stepper.step();
  CHECK(speed(world, 2) == relative(0.05).epsilon(1e-3));
  CHECK(height(world) == relative(5e-3 + 0.05 * 0.199).epsilon(0.01));
}

TEST_CASE("a grain follows a plate that is slower than the threshold of sleep") {
  const Scene scene = scene_on({plane({motion(Translation{{0.005, 0, 0}})})}, brick(),
                               {fx::AutoDisable{0.01, 1, 0, 10}, fx::Friction{0.3, {}}, fx::SurfaceLayer{1e-5}});
  const World world(scene, {at(4e-3)});
  Stepper stepper(world, scene);
  for (int i = 0; i < 2000; ++i) stepper.step();
  CHECK(speed(world, 0) == relative(0.005).epsilon(1e-3));
}

TEST_CASE("a grain on the floor of a rotating drum has the drum's velocity, also if only the surface moves") {
  for (const bool surface_only : {false, true}) {
    CAPTURE(surface_only);
    const Rotation turn{Vector3::UnitY(), {0, 0, -0.5}, 12};
    const std::vector<WallMotion> motions = {surface_only ? motion(Conveyor{Vector3::Zero(), turn}) : motion(turn)};
    Wall roller{"roller",
                CylinderShape{0.5, 0.4},
                {{0, 0, -0.5}, Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3::UnitX()))},
                motions};
    const Scene scene = scene_on({roller}, brick(), {fx::Friction{0.8, {}}, fx::SurfaceLayer{1e-5}});
    const World world(scene, {at(4e-3)});
    Stepper stepper(world, scene);
    for (int i = 0; i < 600; ++i) stepper.step();
    const double along = std::hypot(speed(world, 0), speed(world, 2));
    CHECK(along == relative(12.0 / 60 * 2 * std::numbers::pi * 0.504).epsilon(0.01));
  }
}

namespace {

/// m, how far a grain that rides on a wall that rotates about z moves from the axis in two seconds.
double drift(const Wall& wall, const GrainKind& kind, double step, const Vector3& axis_velocity) {
  Scene scene = scene_on({wall}, kind, {fx::Friction{1, {}}, fx::SurfaceLayer{1e-5}});
  scene.time.step = step;
  scene.solver.iterations = 100;
  const World world(scene, {{0, {0.05, 0.01, kind.half_axes[2]}, {1, 0, 0, 0}}});
  Stepper stepper(world, scene);
  int steps = 0;
  const auto distance_at = [&](double end) {
    for (const long last = std::lround(end / step); steps < last; ++steps) stepper.step();
    const double time = steps * step;
    const Point p = world.grains()[0].position();
    return std::hypot(p[0] - time * axis_velocity.x(), p[1] - time * axis_velocity.y());
  };
  const double before = distance_at(0.3);
  return std::abs(distance_at(2.3) - before);
}

}  // namespace

TEST_CASE("a grain that rides on a rotating wall stays at its distance from the axis, for any step") {
  const Rotation turn{Vector3::UnitZ(), {0, 0, 0}, 60};
  for (const double step : {2e-3, 5e-4}) {
    CAPTURE(step);
    Wall table = plane({motion(turn)});
    CHECK(drift(table, brick(), step, {0, 0, 0}) < 1e-6);
    table.start.position = {0.3, -0.2, 0};  // the axis is elsewhere
    CHECK(drift(table, brick(), step, {0, 0, 0}) < 1e-6);
    CHECK(drift(plane({motion(turn), motion(Translation{{0.05, 0, 0}})}), brick(), step, {0.05, 0, 0}) < 1e-6);
    CHECK(drift(plane({motion(Conveyor{Vector3::Zero(), turn})}), brick(), step, {0, 0, 0}) < 1e-6);
    // A ball that rolls without slip circles about the same axis, with 2/7 of the angular velocity.
    CHECK(drift(plane({motion(turn)}), light_ball(), step, {0, 0, 0}) < 2e-5);
  }
}

TEST_CASE("a brick that rides on a plate, a free box on a rotating wall or a grain, stays at its distance from the axis") {
  const auto speeds_at = [](const Vector3& position) {
    return WallVelocity{Vector3(0, 0, kTurn).cross(position), Vector3(0, 0, kTurn)};
  };
  const Wall table = plane({motion(Rotation{Vector3::UnitZ(), {0, 0, 0}, kTurn * 30 / std::numbers::pi})});
  for (const double step : {2e-3, 5e-4}) {
    CAPTURE(step);
    const auto on_table = [&](std::vector<Wall> walls, const GrainKind& kind) {
      walls.push_back(table);
      Scene scene = scene_on(std::move(walls), kind, {fx::Friction{1, {}}, fx::SurfaceLayer{1e-5}});
      scene.time.step = step;
      scene.solver.iterations = 100;
      return scene;
    };
    const auto drift = [&](const World& world, const Scene& scene, const auto& position) {
      Stepper stepper(world, scene);
      const auto distance_after = [&](double duration) {
        for (long left = std::lround(duration / step); left > 0; --left) stepper.step();
        return position().head(2).norm();
      };
      const double before = distance_after(0.3);
      return std::abs(distance_after(2) - before);
    };
    SUBCASE("a free box") {
      const Vector3 place(0.05, 0.01, 0.01);
      Wall box{"box", BoxShape{{0.03, 0.03, 0.02}}, {place, Eigen::Quaterniond::Identity()}};
      box.flight = Flight{0.1, Vector3::Zero(), 0.1 / 6 * 9e-4 * Eigen::Matrix3d::Identity(), speeds_at(place)};
      const Scene scene = on_table({box}, brick());
      const World world(scene, {at(0.5)});
      CHECK(drift(world, scene, [&] { return world.walls().state(0).pose.position; }) < 1e-6);
    }
    SUBCASE("a brick on a plate") {
      GrainKind plate = brick();
      plate.half_axes = {0.08, 0.08, 4e-3};
      Scene scene = on_table({}, plate);
      scene.kinds.push_back({brick(), 1});
      const Vector3 place(0.05, 0.01, 12e-3);
      const World world(
          scene,
          {{0, {0, 0, 4e-3}, {1, 0, 0, 0}, 1, {0, 0, 0}, {0, 0, kTurn}},
           {1, {place.x(), place.y(), place.z()}, {1, 0, 0, 0}, 1, {-kTurn * place.y(), kTurn * place.x(), 0}, {0, 0, kTurn}}});
      CHECK(drift(world, scene, [&] {
              const Point p = world.grains()[1].position();
              return Vector3(p[0], p[1], p[2]);
            }) < 1e-4);
    }
  }
}

TEST_CASE("a ball rests on the surface of every shape, and rises with it") {
  const MeshShape square{
      {{{-0.1F, -0.1F, 0.02F}, {0.1F, -0.1F, 0.02F}, {0.1F, 0.1F, 0.02F}, {-0.1F, 0.1F, 0.02F}}, {{0, 1, 2}, {0, 2, 3}}}};
  const std::vector<std::pair<WallShape, double>> shapes = {
      {PlaneShape{}, 0},
      {BoxShape{{0.1, 0.1, 0.04}}, 0.02},
      {CylinderShape{0.05, 0.04}, 0.02},
      {SmoothShape{{0.05, 0.04, 0.02}, 2, 2, 0, 0}, 0.02},
      {SmoothShape{{0.05, 0.04, 0.02}, 5, 3, 0, 0}, 0.02},
      {SmoothShape{{0.05, 0.04, 0.02}, 2, 2, 0.2, 0.2}, 0.02},
      {square, 0.02},
  };
  for (const auto& shape_and_top : shapes) {
    const auto& shape = shape_and_top.first;
    const double top = shape_and_top.second;
    CAPTURE(shape.index());
    const Wall wall{"part", shape, {{0, 0, 0.3}, Eigen::Quaterniond::Identity()}, {motion(Translation{{0, 0, 0.1}})}};
    const Scene scene = scene_on({wall}, light_ball(), {fx::Friction{0.5, {}}, fx::SurfaceLayer{1e-5}});
    const World world(scene, {at(0.3 + top + 5e-3)});
    Stepper stepper(world, scene);
    for (int i = 0; i < 500; ++i) stepper.step();
    CHECK(std::abs(height(world) - (0.3 + 0.1 * 0.1 + top + 5e-3)) < 5e-5);
    CHECK(speed(world, 2) == relative(0.1).epsilon(1e-3));
  }
}

namespace {

/// N, from the floor upwards on all grains, mean of a number of steps.
double load_on(const World& world, Stepper& stepper, dGeomID wall, int steps) {
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    stepper.step(true);
    for (const MeasuredContact& contact : stepper.measured_contacts()) {
      if (contact.geom.g1 == wall) sum -= contact.force()[2];
      if (contact.geom.g2 == wall) sum += contact.force()[2];
    }
  }
  CHECK(world.grains().size() == 1);
  return sum / steps;
}

Wall piston(double z) {
  Wall wall{"lid", BoxShape{{0.1, 0.1, 0.02}}, {{0, 0, z}, Eigen::Quaterniond::Identity()}};
  wall.drive = Drive{{0, 0, -1}, 3, 0.25};
  return wall;
}

}  // namespace

TEST_CASE("the floor below a piston carries the weights and the force") {
  const Scene scene = scene_on({plane({}), piston(0.025)}, light_ball(), {fx::Friction{0.5, {}}, fx::SurfaceLayer{1e-5}});
  const World world(scene, {at(5e-3)});
  Stepper stepper(world, scene);
  for (int i = 0; i < 2000; ++i) stepper.step();
  const double grain = world.grains()[0].mass.mass * kFall;
  CHECK(load_on(world, stepper, world.walls().geoms()[0], 200) == relative(grain + 3 + 0.25 * kFall).epsilon(1e-3));
  CHECK(load_on(world, stepper, world.walls().geoms()[1], 200) == relative(-3 - 0.25 * kFall).epsilon(1e-3));
  const WallState state = world.walls().state(1);
  CHECK(state.pose.position.head<2>().norm() < 1e-15);
  CHECK(state.pose.rotation.angularDistance(Eigen::Quaterniond::Identity()) == 0);
  CHECK(std::abs(state.pose.position.z() - 0.02) < 5e-5);  // two surface layers of 1e-5, and what the solver leaves
}

TEST_CASE("a piston is held until its time, falls with its damping, and stops where its travel ends") {
  Wall wall = piston(0.5);
  wall.drive->from = 0.1;
  wall.drive->damping = 5;
  wall.drive->travel = {0, 0.2};
  const Scene scene = scene_on({plane({}), wall}, light_ball(), {});
  const World world(scene, {at(5e-3)});
  Stepper stepper(world, scene);
  const auto run = [&](double seconds) {
    for (int i = 0; i < std::lround(seconds / kStepOfWalls); ++i) stepper.step();
    return world.walls().state(1);
  };
  CHECK(run(0.1).pose.position.z() == 0.5);
  // v = F / c (1 - exp(-c t / m)), with the weight in F.
  const double speed = (3 + 0.25 * kFall) / 5 * (1 - std::exp(-5 * 0.05 / 0.25));
  CHECK(run(0.05).velocity.linear.z() == relative(-speed).epsilon(0.01));
  CHECK(run(1.5).pose.position.z() == relative(0.3).epsilon(1e-3));
}

TEST_CASE("a piston on a grain off its axis neither tilts nor leaves the axis, and rotates as prescribed") {
  Wall wall = piston(0.025);
  wall.motions = {motion(Rotation{Vector3::UnitZ(), {0, 0, 0}, 30})};
  const Scene scene = scene_on({plane({}), wall}, brick(), {fx::Friction{0.5, {}}, fx::SurfaceLayer{1e-5}});
  const World world(scene, {{0, {0.03, 0.02, 4e-3}, {1, 0, 0, 0}}});
  Stepper stepper(world, scene);
  for (int i = 0; i < 2500; ++i) stepper.step();
  const WallState state = world.walls().state(1);
  CHECK(state.pose.position.head<2>().norm() < 1e-15);
  CHECK((state.pose.rotation * Vector3::UnitX() - Vector3::UnitY()).norm() < 1e-13);
  CHECK(state.pose.position.z() == relative(0.018).epsilon(0.01));
}
