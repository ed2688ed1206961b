// Scenes for tests: texts of a valid catalogue and a valid scene, scenes with a few grains in a container, and messages about
// mistakes.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/input_error.hpp"
#include "model/container.hpp"
#include "model/scene.hpp"
#include "support/refusal.hpp"
#include "support/temporary_folder.hpp"

// Tests make these texts invalid one line at a time.

inline constexpr const char* kCatalogueText = R"([pea]
half_axes = [3e-3, 3e-3, 3e-3]
delta = 2
epsilon = 2
density = 1200
source = "typical"

[die]
half_axes = [6e-3, 6e-3, 6e-3]
delta = 8
epsilon = 8
rounding = 1e-3
density = 1190
source = "typical"
)";

inline constexpr const char* kSceneText = R"(seed = 7
catalogue = "grains.toml"
[container]
kind = "box"
width = [0.05, 0.06]
[drop]
height = 0.01
gap = 0.1
[[grain]]
name = "pea"
count = 5
[[grain]]
name = "die"
count = 2
[time]
duration = 0.1
step = 0.0005
frame = 0.01
[solver]
iterations = 20
erp = 0.2
cfm = 1e-10
[surface_layer]
relative_depth = 0.002
[max_correcting_velocity]
velocity = 0.05
[gravity]
acceleration = [0, 0, -9.81]
[friction]
coefficient = 0.4
)";

inline constexpr const char* kHopperText = R"(kind = "hopper"
outlet = 0.05
wall_angle = 30
diameter = 0.1
cylinder_height = 0.1
segments = 12
clearance = 0.05
tray_width = 0.15
opens_at = 0.05)";

inline constexpr const char* kTerrainText = R"(kind = "terrain"
width = [0.05, 0.06]
amplitude = 0.004
wavelength = 0.03
ridge_height = 0.002
samples = 21
seed = 3)";

/// Returns `text` with the only occurrence of `from` replaced.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos || text.find(from, at + 1) != std::string::npos) {
    throw std::logic_error("\"" + from + "\" does not occur exactly once");
  }
  return text.replace(at, from.size(), to);
}

/// The scene above with another container.
inline std::string scene_in(const std::string& container) {
  return replaced(kSceneText, "kind = \"box\"\nwidth = [0.05, 0.06]", container);
}

namespace falling_particles {

/// A scene with the grains of kCatalogueText.
inline Scene scene_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  folder.write("grains.toml", kCatalogueText);
  return load_scene(folder.write("scene.toml", text), overrides);
}

/// A ball of 1 cm, kg and m.
inline GrainKind ball() { return {"ball", {5e-3, 5e-3, 5e-3}, 2, 2, 0, 2500, "test"}; }

inline Scene scene_of(Container container, std::vector<GrainCount> kinds) {
  namespace fx = supernormal::effects;
  double smallest = 1;
  for (const GrainCount& entry : kinds) smallest = std::min(smallest, entry.kind.smallest_half_axis());
  std::vector<Wall> walls = walls_in(container);
  return {.name = "test",
          .seed = 1,
          .container = std::move(container),
          .kinds = std::move(kinds),
          .drop = {0.001, 0.02},
          .time = {2, 5e-4, 0.1},
          .solver = {40, 0.2, 1e-10},
          .effects = {fx::Gravity{{0, 0, -9.81}}, fx::Friction{0.4, {}}, fx::MaxCorrectingVelocity{0.05},
                      fx::SurfaceLayer{2e-3 * smallest}},
          .walls = std::move(walls)};
}

inline GrainKind lentil() { return {"lentil", {3.36e-3, 3.36e-3, 1.29e-3}, 2, 2, 0, 1170, "test"}; }

}  // namespace falling_particles

/// The message with which a call refuses its input; "" if it does not.
inline std::string refusal_by(const std::function<void()>& call) {
  return supernormal::test::refusal<falling_particles::InputError>(call);
}

inline std::string without_folder(std::string text, const TemporaryFolder& folder) {
  const std::string prefix = folder.path().string() + "/";
  for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix)) text.erase(at, prefix.size());
  return text;
}

/// The message from loading the scene, without the name of the temporary folder; "" if it is accepted.
inline std::string complaint(const std::string& scene, const std::string& catalogue = kCatalogueText,
                             const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  folder.write("grains.toml", catalogue);
  const std::string path = folder.write("scene.toml", scene);
  return without_folder(refusal_by([&] { falling_particles::load_scene(path, overrides); }), folder);
}

struct Mistake {
  const char* from;
  const char* to;
  std::vector<const char*> says;  // the place, the value and the valid range
};

inline void check_says(const std::string& text, const std::vector<const char*>& says) {
  CAPTURE(text);
  CHECK(text.find('\n') == std::string::npos);
  for (const std::string part : says) {
    CAPTURE(part);
    CHECK(text.find(part) != std::string::npos);
  }
}
