#include "distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <supernormal/proximity/solve.hpp>
#include <supernormal/shapes/sphere.hpp>

namespace fit {

namespace {

// Inside, the distance function has as many local maxima as the body has faces. Down to this depth, relative to the smallest
// half-axis, the maximum nearest to the central projection of the point is used. Below it the global one is searched.
constexpr double kShallow = 0.1;

}  // namespace

DistanceFunction::DistanceFunction(const Body& body, double tolerance)
    : body_(body), tolerance_(tolerance), rotation_(body.rotation()), shape_(make_shape(body)) {}

// The normal at x of the scaled image of the body through x (body's frame), which is the gradient of the implicit function. Near
// the boundary it is so close to the normal of the witness that it halves the time of the search.
Vector3 DistanceFunction::gauge_normal(const Vector3& x) const {
  constexpr double kLeastSection = 0.05;
  const Vector3& axes = body_.half_axes;
  const double section = std::max(kLeastSection, 1 + body_.taper * x.z() / axes.z());
  const Vector3 widths(axes.x() * section, axes.y() * section, axes.z());
  Vector3 u = x.cwiseAbs().cwiseQuotient(widths);
  const double scale = u.maxCoeff();
  if (!(scale > 0)) return Vector3::UnitZ();
  u /= scale;  // prevents overflow
  const double sum = std::pow(u.x(), body_.delta) + std::pow(u.y(), body_.delta);
  Vector3 normal = Vector3::Zero();
  if (sum > 0) {
    const double outer = std::pow(sum, body_.epsilon / body_.delta - 1);
    for (int i = 0; i < 2; ++i) normal[i] = std::copysign(outer * std::pow(u[i], body_.delta - 1) / widths[i], x[i]);
    normal.z() = -scale * outer * sum * body_.taper / (axes.z() * section);
  }
  normal.z() += std::copysign(std::pow(u.z(), body_.epsilon - 1) / axes.z(), x.z());
  const double length = normal.norm();
  return length > 0 && std::isfinite(length) ? Vector3(normal / length) : Vector3::UnitZ();
}

bool DistanceFunction::contains(const Vector3& x) const {
  const Vector3 p = rotation_.transpose() * (x - body_.position);
  const double z = p.z() / body_.half_axes.z(), section = 1 + body_.taper * z;
  if (!(std::abs(z) < 1) || !(section > 0)) return false;
  const double u = std::abs(p.x() / (body_.half_axes.x() * section)), v = std::abs(p.y() / (body_.half_axes.y() * section));
  if (!(u < 1) || !(v < 1)) return false;
  const double sum = std::pow(u, body_.delta) + std::pow(v, body_.delta);
  return std::pow(sum, body_.epsilon / body_.delta) + std::pow(std::abs(z), body_.epsilon) < 1;
}

std::optional<Witness> DistanceFunction::find(const Vector3& x) const {
  static const supernormal::Sphere point(0);
  supernormal::Settings settings;
  settings.tolerance = tolerance_;
  const supernormal::Pose pose{body_.position, rotation_}, place{x, Matrix3::Identity()};
  const Vector3 first = gauge_normal(rotation_.transpose() * (x - body_.position));
  auto proximity = supernormal::find_proximity(*shape_, pose, point, place, settings, &first);
  if (proximity.status == supernormal::Status::InvalidInput) return std::nullopt;
  if (proximity.gap < -kShallow * body_.half_axes.minCoeff()) {
    proximity = supernormal::find_proximity(*shape_, pose, point, place, settings);
  }
  return Witness{proximity.gap, proximity.normal, x - proximity.gap * proximity.normal};
}

Gradient DistanceFunction::gradient(const Witness& witness) const {
  const Vector3 n = to_body(witness.normal), r = to_body(witness.foot - body_.position);
  Gradient gradient = -support_gradient(body_, n, r);
  gradient.segment<3>(kPosition) = -witness.normal;
  // A rotation of the body by w moves the boundary point by w x r. This changes the distance by -n.(w x r) = w.(n x r).
  gradient.segment<3>(kRotation) = n.cross(r);
  return gradient;
}

double least_distance(std::span<const DistanceFunction> functions, const Vector3& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const DistanceFunction& function : functions) least = std::min(least, function.find(x).value_or(Witness{least}).distance);
  return least;
}

double noise_offset(const DistanceFunction& function, const Witness& witness, double sigma) {
  const Vector3 n = function.to_body(witness.normal).normalized();
  const Matrix3 H = function.shape().jet(n).H;
  // H n = 0, so the principal radii of curvature are the other two eigenvalues. Their product is the sum of the principal minors.
  // The largest minor is exact for a flat face with one or two radii of 1e30.
  const auto minor = [&](int i, int j) { return H(i, i) * H(j, j) - H(i, j) * H(i, j); };
  const double product = minor(0, 1) + minor(1, 2) + minor(2, 0);
  const double half = H.trace() / 2, root = std::sqrt(std::max(0.0, half * half - product));
  const double larger = half + root, smaller = larger > 0 ? product / larger : 0;
  const auto curvature = [&](double radius) { return 1 / std::hypot(radius, 0.4 * sigma); };
  return sigma * sigma / 2 * (curvature(larger) + curvature(std::max(0.0, smaller)));
}

}  // namespace fit
