// A first guess of the nearest points.
#pragma once

#include <array>

#include "method.hpp"

namespace literature {

/// The angles of two near points: from Options::first_normal if it is there, otherwise by the search of Goncalves et al. (2017),
/// which quarters the angles of both surfaces six times and keeps the pair of quarters whose middles are nearest. Adds what it
/// evaluates to `evaluations`.
std::array<Vector2, 2> start_angles(const Bodies& bodies, const Options& options, int& evaluations);

}  // namespace literature
