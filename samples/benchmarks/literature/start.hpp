// A first guess of the nearest points.
#pragma once

#include <array>

#include "method.hpp"

namespace literature {

/// How a method starts that has no normal of an earlier pose.
enum class Start {
  CentreLine,  ///< at the two points with normals along the line of the centres, known in closed form: fails least, costs least
  Quadtree,    ///< by the search of Goncalves et al. (2017)
};

/// The angles of two points to start from: those of Options::first_normal if it is there, otherwise by `start`. Adds what it
/// evaluates to `evaluations`.
std::array<Vector2, 2> start_angles(const Bodies& bodies, const Options& options, Start start, int& evaluations);

}  // namespace literature
