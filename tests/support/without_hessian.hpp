// Bodies in the form in which a program defines its own.
#pragma once

#include <memory>

#include "supernormal/shapes/callback_shape.hpp"

namespace supernormal::test {

/// The same body as one of a program's own, without a Hessian.
inline CallbackShape without_hessian(const std::shared_ptr<const Shape>& shape) {
  return {[shape](const Vector3& n) { return shape->support(n); }, [shape](const Vector3& n) { return shape->point(n); }};
}

}  // namespace supernormal::test
