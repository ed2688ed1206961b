// Bodies in the form of a program's own shape.
#pragma once

#include <memory>

#include "supernormal/shapes/callback_shape.hpp"

namespace supernormal::test {

/// The same body as a user shape, without a Hessian.
inline CallbackShape without_hessian(const std::shared_ptr<const Shape>& shape) {
  return {[shape](const Vector3& n) { return shape->support(n); }, [shape](const Vector3& n) { return shape->point(n); }};
}

}  // namespace supernormal::test
