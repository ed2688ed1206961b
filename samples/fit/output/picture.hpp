// A picture of data and bodies.
#pragma once

#include <span>
#include <string>

#include "model/body.hpp"
#include "model/cloud.hpp"

namespace fit {

/// An SVG with three views along the axes of the first body. The data are dots, red outside the bodies and blue inside. The
/// outlines of the bodies are exact. At the distance `rms` the colour is half saturated.
std::string draw(std::span<const Body> bodies, const Cloud& data, double rms, const std::string& title);

}  // namespace fit
