// Bodies in long double: an independent reference for derivatives.
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

/// A body of the library and its reference.
struct PairedBody {
  std::shared_ptr<const Shape> shape;
  std::shared_ptr<const LongBody> exact;
};

PairedBody paired_superellipsoid(const Vector3& half_axes, double delta, double epsilon);
PairedBody paired_ellipsoid(const Vector3& half_axes);
PairedBody paired_superovoid(const Vector3& half_axes, double delta, double epsilon, double taper_x, double taper_y);
PairedBody paired_sphere(double radius);
PairedBody paired_box(const Vector3& half_lengths);
PairedBody paired_capsule(double radius, double half_length);
PairedBody paired_cylinder(double radius, double half_length);
PairedBody paired_polytope(const std::shared_ptr<const std::vector<Vector3>>& points);
PairedBody rounded(const PairedBody& core, double radius);
PairedBody sum(const PairedBody& first, const PairedBody& second);
PairedBody image(const PairedBody& body, const Matrix3& matrix);

}  // namespace supernormal::test
