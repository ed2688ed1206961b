// The normal to start from without an earlier normal.
#pragma once

#include "supernormal/proximity/gap_function.hpp"

namespace supernormal {

/// The unit normal at which the ray from centre 1 to centre 2 leaves an ellipsoid that approximates the Minkowski sum of the
/// bodies. It is exact for spheres and homothetic ellipsoids. The sum of two ellipsoids with the matrices A and B is inside the
/// ellipsoid with (1 + b/a) A + (1 + a/b) B for any positive a and b. The square roots of the traces make it the tightest in trace
/// (Kurzhanski and Valyi, Ellipsoidal Calculus, 1997). For concentric bodies, which have no such ray, it is the thinnest axis of
/// either.
Vector3 first_guess(const GapFunction& gap);

}  // namespace supernormal
