// Scenes with contacts before overlap.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "advise/doubts.hpp"
#include "observe/leaks.hpp"
#include "scenes.hpp"
#include "support/relative.hpp"
#include "world/stepper.hpp"
#include "world/world.hpp"

using namespace falling_particles;
using supernormal::test::relative;
namespace fx = supernormal::effects;

namespace {

constexpr const char* kSection = "[speculative_contacts]\n";

Scene ahead(Scene scene) {
  std::erase_if(scene.effects, [](const fx::Effect& effect) {
    return std::holds_alternative<fx::MaxCorrectingVelocity>(effect) || std::holds_alternative<fx::SurfaceLayer>(effect);
  });
  scene.effects.emplace_back(fx::SpeculativeContacts{});
  return scene;
}

unsigned long long contacts_ahead(const World& world) {
  for (const fx::Cost& cost : world.effects().costs()) {
    if (std::string(cost.name) == "speculative_contacts") return cost.contacts;
  }
  return 0;
}

/// Throws a ball at a wall; whether it has left the container.
bool leaves(const Scene& scene, const Point& velocity) {
  const World world(scene, {{0, {0.025, 0.025, 0.02}, {1, 0, 0, 0}}});
  dBodySetLinearVel(world.grains()[0].body, velocity[0], velocity[1], velocity[2]);
  Stepper stepper(world, scene);
  LeakWatch leaks(world);
  for (int k = 1; k <= 20; ++k) {
    stepper.step();
    leaks.after_step(k * scene.time.step);
  }
  return leaks.count() > 0;
}

}  // namespace

TEST_CASE("speculative contacts are on in scenes that name them, and in no others") {
  CHECK_FALSE(scene_of(kSceneText).looks_ahead());
  CHECK(scene_of(std::string(kSceneText) + kSection).looks_ahead());
  CHECK(scene_of(std::string(kSceneText) + kSection + "enabled = true\n").looks_ahead());
  CHECK_FALSE(scene_of(std::string(kSceneText) + kSection + "enabled = false\n").looks_ahead());
  check_says(complaint(std::string(kSceneText) + kSection + "enabled = 1\n"),
             {"speculative_contacts.enabled is 1", "true or false"});
  check_says(complaint(std::string(kSceneText) + kSection + "horizon = 1\n"), {"unknown key \"horizon\"", "enabled"});
}

TEST_CASE("a compression with speculative contacts is refused") {
  const std::string text =
      replaced(replaced(replaced(kSceneText, "kind = \"box\"\nwidth = [0.05, 0.06]", "kind = \"periodic\"\nside = 0.1"),
                        "[drop]\nheight = 0.01\ngap = 0.1\n", ""),
               "[gravity]\nacceleration = [0, 0, -9.81]\n", "") +
      "[compression]\noverlap = 1e-2\nfinal_overlap = 1e-4\ndamping = 0.1\n";
  CHECK(complaint(text).empty());
  check_says(complaint(text + kSection), {"speculative_contacts in a compression", "one of both"});
}

TEST_CASE("speculative contacts: grains of 500 m/s stay in their container at steps of 5 ms") {
  Scene scene = scene_of(Box{{0.05, 0.05}}, {{ball(), 1}});
  scene.time.step = 5e-3;
  scene.solver.iterations = 80;  // with 40, three walls at once are wrong by 1 % of the speed, a quarter of the box in a step
  for (const Point& velocity : {Point{500, 0, 0}, Point{0, -500, 0}, Point{0, 0, -500}, Point{300, 300, -300}}) {
    CHECK(leaves(scene, velocity));
    CHECK_FALSE(leaves(ahead(scene), velocity));
  }
}

TEST_CASE("speculative contacts: a ball bounces as high on a periodic boundary as elsewhere") {
  for (const double x : {0.03, 0.0, 0.002, 0.0595}) {  // on the boundary it has an image
    for (const double step : {1e-3, 1e-2}) {
      CAPTURE(x);
      CAPTURE(step);
      Scene scene = ahead(scene_of(Box{{0.06, 0.05}}, {{ball(), 1}}));
      scene.time.step = step;
      scene.solver.iterations = 200;
      scene.effects.emplace_back(fx::Restitution{0.8, 0.05, {}});
      scene.periodic[0] = Period{0, 0.06};
      const double height = 0.5;  // m
      const World world(scene, {{0, {x, 0.025, 5e-3 + height}, {1, 0, 0, 0}}});
      Stepper stepper(world, scene);
      dBodyID body = world.grains()[0].body;
      const auto rises = [&] { return dBodyGetLinearVel(body)[2] > 0; };
      for (int k = 0; k * step < 1 && !rises(); ++k) stepper.step();
      REQUIRE(rises());
      const double velocity = dBodyGetLinearVel(body)[2] - 9.81 * step / 2;
      CHECK(dBodyGetPosition(body)[2] - 5e-3 + velocity * velocity / (2 * 9.81) == relative(0.64 * height).epsilon(0.01));
      CHECK(contacts_ahead(world) > 0);
    }
  }
}

TEST_CASE("speculative contacts: there are no doubts about fast grains") {
  const std::string fast = replaced(replaced(kSceneText, "height = 0.01", "height = 20"), "step = 0.0005", "step = 0.002");
  CHECK(doubts_about(scene_of(fast)).size() == 1);
  CHECK(doubts_about(scene_of(fast + kSection)).empty());
}

TEST_CASE("a spring holds a grain on a wall whose rotation needs chords") {
  // The wall's velocity at a grain has a part along the normal, which is added to what the spring asks for.
  Scene scene = scene_of(std::string(kSceneText) +
                         "[[part]]\nname = \"plate\"\nshape = \"box\"\nsize = [0.5, 0.5, 0.1]\nposition = [0.025, 0.025, 0.05]\n"
                         "[[part.motion]]\nkind = \"rotation\"\naxis = [0, 1, 0]\npoint = [0.025, 0.025, 0.05]\nrpm = 1e-3\n");
  scene.kinds.resize(1);
  scene.effects = {fx::Gravity{{0, 0, -9.81}}, fx::Friction{0.4, {}}, fx::Compliance{1e3, 0.05, {}}};
  const World world(scene, {{0, {0.025, 0.025, 0.103}, {1, 0, 0, 0}}});
  Stepper stepper(world, scene);
  for (int k = 0; k < 400; ++k) stepper.step();
  CHECK(world.grains()[0].position()[2] > 0.1025);
}
