// A body as data, so that a case can be printed, scaled and varied before a shape is made of it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "supernormal/shapes/shape.hpp"

namespace supernormal::samples {

/// One of the classes of include/supernormal/shapes and its parameters. The functions below make the usual ones.
struct Body {
  enum class Kind { Ellipsoid, Superellipsoid, Superovoid, Box, Capsule, Cylinder, Polytope };

  Kind kind = Kind::Ellipsoid;
  Vector3 lengths = Vector3::Ones();  ///< m; half-axes, half-lengths, or radius (x and y) and half-length (z)
  double delta = 2, epsilon = 2;      ///< exponents of superellipsoids and superovoids
  double taper_x = 0, taper_y = 0;    ///< tapers of superovoids
  std::vector<Vector3> points = {};   ///< m; points of polytopes
  double rounding = 0;                ///< m; radius of a sphere that sweeps the body
  bool is_callback = false;           ///< has only its support function and boundary point, without a Hessian

  /// This body swept by a sphere of this radius, m.
  Body rounded(double radius) const;

  /// This body with lengths in units of `unit` m. A power of two changes no digit.
  Body scaled(double unit) const;

  /// This body with is_callback.
  Body by_callbacks() const;
};

Body ellipsoid(const Vector3& half_axes);
Body superellipsoid(const Vector3& half_axes, double delta, double epsilon);
Body superovoid(const Vector3& half_axes, double delta, double epsilon, double taper_x, double taper_y);
Body box(const Vector3& half_lengths);
Body capsule(double radius, double half_length);
Body cylinder(double radius, double half_length);
Body polytope(std::vector<Vector3> points);

/// A superellipsoid with equal half-axes and exponents.
Body superball(double radius, double exponent);

/// Throws std::invalid_argument when the shape refuses a parameter.
std::shared_ptr<const Shape> make_shape(const Body& body);

/// A description of the body, such as "superellipsoid (1, 0.8, 0.5) m; 20, 4".
std::string describe(const Body& body);

/// Writes a number with the few digits of %g.
std::string text(double value);

/// Writes a number with all digits that reproduce it.
std::string exact_text(double value);
std::string exact_text(const Vector3& v);

}  // namespace supernormal::samples
