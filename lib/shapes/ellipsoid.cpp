#include "supernormal/shapes/ellipsoid.hpp"

#include "base/validation.hpp"
#include "shapes/lanes/lane_body_of.hpp"
#include "shapes/nested_norms.hpp"

namespace supernormal {

Ellipsoid::Ellipsoid(const Vector3& half_axes)
    : half_axes_(require_half_axes(half_axes)),
      squares_(half_axes.cwiseProduct(half_axes)),
      numbers_(make_lane_body(*this, half_axes, 2, 2)) {}

double Ellipsoid::rolling_radius() const {
  const double smallest = half_axes_.minCoeff();
  return smallest * (smallest / half_axes_.maxCoeff());
}

bool Ellipsoid::surely_contains(const Vector3& point) const { return point.cwiseQuotient(half_axes_).squaredNorm() <= 1; }

void Ellipsoid::evaluate(const Vector3& n, Order order, Jet& jet) const {
  jet.h = half_axes_.cwiseProduct(n).norm();
  if (order == Order::Value) return;
  const double inverse = 1 / jet.h;
  jet.r = squares_.cwiseProduct(n) * inverse;
  if (order == Order::Point) return;
  // H = (diag(a^2) - r r^T)/h with r = a w and |w| = 1. Writing 1 - w_x^2 as w_y^2 + w_z^2 keeps the digits of a needle's small
  // radii.
  const Vector3 w = half_axes_.cwiseProduct(n) * inverse;  // unit vector
  const Vector3 rest(w.y() * w.y() + w.z() * w.z(), w.z() * w.z() + w.x() * w.x(), w.x() * w.x() + w.y() * w.y());
  const Vector3 aw = half_axes_.cwiseProduct(w);
  jet.H.noalias() = aw * (aw * -inverse).transpose();
  jet.H.diagonal() = squares_.cwiseProduct(rest) * inverse;
}

void Ellipsoid::add_parameter_gradient(const Vector3& n, const Vector3& r, ParameterGradient& gradient) const {
  add_half_axes_gradient(half_axes_, n, r, gradient);
}

}  // namespace supernormal
