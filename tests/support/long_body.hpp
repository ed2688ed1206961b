// Bodies in long double: an independent reference for derivatives and moving bodies.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "supernormal/shapes/shape.hpp"

namespace supernormal::test {

using Real = long double;
using Real3 = Eigen::Matrix<Real, 3, 1>;
using Real33 = Eigen::Matrix<Real, 3, 3>;

/// A convex body by its boundary point of a normal, in long double, from the formulas of DESIGN and not from the library's code.
/// Its parameters can be changed one by one, in the order of ParameterGradient.
struct LongBody {
  enum class Kind { Superellipsoid, Superovoid, Sphere, Box, Capsule, Cylinder, Polytope, Rounded, Sum, Image };

  Kind kind;
  std::vector<Real> parameters;
  std::vector<Real3> vertices;                           // of a polytope
  Real33 matrix = Real33::Identity();                    // of an image
  std::vector<std::shared_ptr<const LongBody>> parts{};  // of a composition

  /// A boundary point with the unit normal n.
  Real3 point(const Real3& n) const;

  /// The normal at a point beside the boundary, of any length; zero for bodies without an equation here.
  Real3 gradient(const Real3& x) const;

  /// At most two vectors that are perpendicular to n and to all normals near it which keep the edge or face of n.
  std::vector<Real3> edges(const Real3& n) const;

  /// The number of parameters, those of the parts included.
  std::size_t parameter_count() const;

  /// The same body with parameter k changed by `change`.
  std::shared_ptr<const LongBody> with_change(std::size_t k, Real change) const;
};

/// The reference of a body of the library. Throws std::bad_cast for a class that it does not know.
std::shared_ptr<const LongBody> long_body_of(const Shape& shape);

struct LongPose {
  Real3 position = Real3::Zero();
  Real33 rotation = Real33::Identity();

  /// Moved by v (m) and rotated by exp([w]), w in rad, about its origin.
  LongPose moved(const Real3& v, const Real3& w) const;
};

/// s(n), m: a lower bound of the gap for any normal from body 1 to body 2, and the gap at the common normal of separate bodies.
Real long_gap(const LongBody& body1, const LongPose& pose1, const LongBody& body2, const LongPose& pose2, const Real3& normal);

}  // namespace supernormal::test
