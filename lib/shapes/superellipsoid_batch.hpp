// Several superellipsoids evaluated together.
#pragma once

#include <array>
#include <cstddef>
#include <typeinfo>

#include "shapes/nested_norms.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

namespace supernormal {

/// The shape if it is a superellipsoid, null otherwise. Every query asks, so it compares addresses. Where a program
/// has two copies of this library, it may be null: then the bodies are evaluated one by one, with the same digits.
inline const Superellipsoid* as_superellipsoid(const Shape& shape) {
  return &typeid(shape) == &typeid(Superellipsoid) ? static_cast<const Superellipsoid*>(&shape) : nullptr;
}

/// Evaluates several superellipsoids, with the digits of Superellipsoid::evaluate(). No body waits for the powers and roots of
/// another: two take two thirds of the time of two calls.
class SuperellipsoidBatch {
 public:
  struct Request {
    const Superellipsoid* body;
    const Vector3* n;  ///< unit, in the body's frame
    Jet* jet;          ///< the result
  };

  /// For one or two requests.
  template <std::size_t kCount>
  static void evaluate(const std::array<Request, kCount>& requests, Order order);

 private:
  template <std::size_t kCount>
  static void evaluate_by_one_norm(const std::array<Request, kCount>& requests, Order order);
  template <std::size_t kCount>
  static void evaluate_by_two_norms(const std::array<Request, kCount>& requests, Order order);
};

}  // namespace supernormal
