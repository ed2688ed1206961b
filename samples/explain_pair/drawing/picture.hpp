// The picture of a pair: panels, titles and legend.
#pragma once

#include <string>

#include "method/explanation.hpp"

namespace explain_pair {

/// Returns an SVG document.
std::string picture_of(const Explanation& explanation);

/// "converged", or the reason for the failure.
const char* name_of(supernormal::Status status);

}  // namespace explain_pair
