// Supernormal's C++ core: shapes, gap function and solvers; no ODE needed.
#pragma once

#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/callback_shape.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/shape.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/solvers/gap_function.hpp"
#include "supernormal/solvers/plane.hpp"
#include "supernormal/solvers/pose.hpp"
#include "supernormal/solvers/proximity.hpp"
#include "supernormal/solvers/solve.hpp"
