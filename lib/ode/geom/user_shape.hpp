// A body described by the callbacks of the C interface.
#pragma once

#include <memory>

#include "supernormal/shapes/shape.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::ode {

/// Tries the callbacks out; std::invalid_argument when they do not describe a convex body. Copies *shape; does not call `release`.
std::shared_ptr<const Shape> make_user_shape(const snShape* shape);

}  // namespace supernormal::ode
