// The bodies to fit: families of parameters, and the derivatives of the support function.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <optional>
#include <supernormal/proximity/pose.hpp>
#include <supernormal/shapes/shape.hpp>

namespace fit {

using supernormal::Matrix3;
using supernormal::Vector3;

/// Each family contains the preceding one.
enum class Family {
  Ellipsoid,       ///< both exponents are 2, no taper
  Superellipsoid,  ///< no taper
  Superovoid,      ///< equal tapers in x and y; such a body is convex for every exponent
};

const char* name_of(Family family);

/// The number of parameters of a body: 9 for position, orientation and half-axes, then the exponents, then the taper.
int parameter_count(Family family);

/// A body and its pose in the frame of the data.
struct Body {
  Family family = Family::Ellipsoid;
  Vector3 position = Vector3::Zero();  ///< of the centre
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Vector3 half_axes = Vector3::Ones();
  double delta = 2, epsilon = 2;
  double taper = 0;  ///< taper_x = taper_y of snCreateSuperovoid

  Matrix3 rotation() const { return orientation.toRotationMatrix(); }
  supernormal::Pose pose() const { return {position, rotation()}; }
};

/// The shape in the body's frame. Throws std::invalid_argument if a parameter is out of range.
std::unique_ptr<supernormal::Shape> make_shape(const Body& body);

/// The same body with its axes in canonical order. The section of a superellipsoid has its longer half-axis along x. The half-axes
/// of an ellipsoid decrease from x to z. The taper of a superovoid is <= 0.
Body in_customary_order(const Body& body);

/// The body in a frame whose axes are the columns of `axes`, a signed permutation. Its position and size are the same. It is the
/// same body if the exponents agree.
Body with_axes(const Body& body, const Matrix3& axes);

/// The image of the body under x -> scale x + offset.
Body moved(const Body& body, double scale, const Vector3& offset);

/// Indices of the parameters in gradients and covariances. For a body of size 1 all have similar weight. Lengths and angles (rad,
/// about the body's axes) are used directly. Half-axes a and exponents delta enter as ln(a) and ln(delta - 1).
constexpr int kPosition = 0;  // three, in the frame of the data
constexpr int kRotation = 3;  // three, about the body's axes
constexpr int kLogAxes = 6;   // three
constexpr int kLogDelta = 9;
constexpr int kLogEpsilon = 10;
constexpr int kTaper = 11;
constexpr int kParameters = 12;

using Gradient = Eigen::Matrix<double, kParameters, 1>;

/// The derivatives of the support function h(n) in the body's frame by half-axes, exponents and taper. The entries of position and
/// rotation are 0. `r` is the boundary point with the normal n.
///
/// h is a maximum over the boundary, so its derivative equals the derivative of the maximised function at the fixed maximiser
/// (Danskin's theorem). Let e_i = n_i r_i be the terms of h. Then dh/d(ln a_i) = e_i. The section is a norm with the dual exponent
/// p and the weights v, 1 - v of its two terms. So d(ln t)/dp = -S(v)/p^2 with the entropy S(v) = -v ln v - (1-v) ln(1-v). The
/// meridian is analogous.
Gradient support_gradient(const Body& body, const Vector3& n, const Vector3& r);

/// The boundary point in the body's frame whose direction, after the half-axes become 1 and the taper 0, is u (not 0).
/// `derivatives`: one column for each parameter; 0 for position and rotation.
using PointDerivatives = Eigen::Matrix<double, 3, kParameters>;
Vector3 boundary_point(const Body& body, const Vector3& u, PointDerivatives* derivatives = nullptr);

/// What a fit may not change.
struct ShapeLimits {
  double max_exponent = 1000;            ///< in (1, 1000]; without unit
  std::optional<double> delta, epsilon;  ///< fixed exponents, in [1.001, 1000]
  bool has_round_section = false;        ///< a = b and delta = 2: a body of revolution about z
};

/// The parameters that these limits fix, in the order of kPosition to kTaper. A round section fixes b, which follows a.
std::array<bool, kParameters> fixed_parameters(const ShapeLimits& limits);

/// The limit of |taper| for a convex body, Superovoid::max_taper(epsilon), and its derivative by ln(epsilon - 1).
double taper_limit(double epsilon);
double taper_limit_slope(double epsilon);

}  // namespace fit
