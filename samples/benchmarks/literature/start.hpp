// First guesses of the nearest points.
#pragma once

#include <array>

#include "method.hpp"

namespace literature {

/// The start of a method without the normal of an earlier pose.
enum class Start {
  CentreLine,  ///< the points with normals along the line of centres, in closed form: fails least, costs least
  Quadtree,    ///< the search of Goncalves et al. (2017)
};

/// The angles of two starting points: from Options::first_normal if given, otherwise by `start`. Adds its evaluations to
/// `evaluations`.
std::array<Vector2, 2> start_angles(const Bodies& bodies, const Options& options, Start start, int& evaluations);

}  // namespace literature
