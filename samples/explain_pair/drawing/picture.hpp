// The picture of a pair: its panels, titles and legend.
#pragma once

#include <string>

#include "method/explanation.hpp"

namespace explain_pair {

/// An SVG document.
std::string picture_of(const Explanation& explanation);

/// "converged", or why not.
const char* name_of(supernormal::Status status);

}  // namespace explain_pair
