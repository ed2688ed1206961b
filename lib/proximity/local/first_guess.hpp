// Where to start without an earlier normal.
#pragma once

#include "supernormal/proximity/gap_function.hpp"

namespace supernormal {

/// The normal at which the ray from centre 1 to centre 2 leaves an ellipsoid that resembles the Minkowski sum of the bodies: exact
/// for spheres and homothetic ellipsoids. The sum of two ellipsoids with matrices A and B lies within the one with
/// (1 + b/a) A + (1 + a/b) B for any positive a, b; the square roots of the traces make it the tightest in trace
/// (Kurzhanski and Valyi, Ellipsoidal Calculus, 1997).
/// Concentric bodies have no such ray: the thinnest axis of either.
Vector3 first_guess(const GapFunction& gap);

}  // namespace supernormal
