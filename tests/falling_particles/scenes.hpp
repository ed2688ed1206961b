// Scenes for tests: from the text of a file, or with a few grains in a container.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "model/container_walls.hpp"
#include "model/scene.hpp"
#include "scene_text.hpp"
#include "support/temporary_folder.hpp"

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
