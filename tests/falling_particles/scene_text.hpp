// A valid catalogue and a valid scene as text.
#pragma once

#include <stdexcept>
#include <string>

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
