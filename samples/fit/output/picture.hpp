// A picture of data and bodies.
#pragma once

#include <span>
#include <string>

#include "model/body.hpp"
#include "model/cloud.hpp"

namespace fit {

/// An SVG of three views along the axes of the first body: data as dots, red outside of the bodies and blue inside, and the bodies'
/// exact outlines. `rms` is the distance at which the colour is full by half.
std::string draw(std::span<const Body> bodies, const Cloud& data, double rms, const std::string& title);

}  // namespace fit
