// A user shape: a body defined by the callbacks of the C interface.
#pragma once

#include <memory>

#include "supernormal/shapes/shape.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::ode {

/// Tests the callbacks. Throws std::invalid_argument when they do not define a convex body. Copies *shape; does not call `release`.
std::shared_ptr<const Shape> make_user_shape(const snShape* shape);

}  // namespace supernormal::ode
