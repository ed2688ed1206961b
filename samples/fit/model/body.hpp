// The bodies that are fitted: one family of parameters, and how the support function depends on them.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <supernormal/proximity/pose.hpp>
#include <supernormal/shapes/shape.hpp>

namespace fit {

using supernormal::Matrix3;
using supernormal::Vector3;

/// Each family contains the one before it.
enum class Family {
  Ellipsoid,       ///< both exponents are 2, no taper
  Superellipsoid,  ///< no taper
  Superovoid,      ///< one taper for both directions of the section, which is convex for every exponent
};

const char* name_of(Family family);

/// How many numbers a body of the family has: position, attitude and half-axes are 9, then the exponents, then the taper.
int parameter_count(Family family);

/// A body and its place among the data.
struct Body {
  Family family = Family::Ellipsoid;
  Vector3 position = Vector3::Zero();  ///< of the centre
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();
  Vector3 half_axes = Vector3::Ones();
  double delta = 2, epsilon = 2;
  double taper = 0;  ///< taper_x = taper_y of snCreateSuperovoid

  Matrix3 rotation() const { return attitude.toRotationMatrix(); }
  supernormal::Pose pose() const { return {position, rotation()}; }
};

/// The shape of the body in its own frame. std::invalid_argument where a parameter is out of its range.
std::unique_ptr<supernormal::Shape> make_shape(const Body& body);

/// The same body with its axes named in the customary order: a superellipsoid's section has its longer half-axis along x, an
/// ellipsoid's half-axes fall from x to z, a superovoid grows thinner upwards or not at all.
Body in_customary_order(const Body& body);

/// The body seen in axes that are the columns of `axes`, a signed permutation of its own: another body with its place and size,
/// the same one where the exponents agree.
Body with_axes(const Body& body, const Matrix3& axes);

/// The body after x -> scale x + offset.
Body moved(const Body& body, double scale, const Vector3& offset);

/// The numbers of a body in the order of gradients and covariances. Each has about the same weight for a body of size 1: lengths
/// and angles (rad, about the body's axes) as they are, half-axes and exponents by logarithms, of a and of delta - 1.
constexpr int kPosition = 0;  // three, in the frame of the data
constexpr int kRotation = 3;  // three, about the body's axes
constexpr int kLogAxes = 6;   // three
constexpr int kLogDelta = 9;
constexpr int kLogEpsilon = 10;
constexpr int kTaper = 11;
constexpr int kParameters = 12;

using Gradient = Eigen::Matrix<double, kParameters, 1>;

/// The derivatives of the support function h(n) in the body's frame with respect to half-axes, exponents and taper; the entries
/// of position and rotation are 0. `r` is the boundary point with the normal n.
///
/// h is a maximum over the boundary, so that its derivative is that of the maximised function at the fixed maximiser (Danskin's
/// theorem). With the shares e_i = n_i r_i of h: dh/d(ln a_i) = e_i; for the section, a norm with the dual exponent p and weights
/// v, 1 - v of its two terms, d(ln t)/dp = -S(v)/p^2 with the entropy S(v) = -v ln v - (1-v) ln(1-v), and correspondingly along
/// the meridian.
Gradient support_gradient(const Body& body, const Vector3& n, const Vector3& r);

/// The limit of |taper| for a convex body: Superovoid::max_taper(epsilon), and its derivative by ln(epsilon - 1).
double taper_limit(double epsilon);
double taper_limit_slope(double epsilon);

}  // namespace fit
