#include "support/long_body.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/linear_image.hpp"
#include "supernormal/shapes/minkowski_sum.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/shapes/superovoid.hpp"

namespace supernormal::test {
namespace {

using Kind = LongBody::Kind;

// Normals this near to the normal of a face or of an edge have it. The answers have them to rounding.
constexpr Real kSameNormal = 1e-11L;

/// The gradient of (x^p + y^p)^(1/p) at two numbers that are not negative, and the norm.
struct Norm {
  Real value, dx, dy;
};

Norm norm_of(Real x, Real y, Real p) {
  const Real larger = std::max(x, y);
  if (larger == 0) return {0, 0, 0};
  const Real u = x / larger, v = y / larger;
  const Real value = std::pow(std::pow(u, p) + std::pow(v, p), 1 / p);
  return {larger * value, std::pow(u / value, p - 1), std::pow(v / value, p - 1)};
}

Real dual(Real e) { return e / (e - 1); }

Real3 superellipsoid_point(const std::vector<Real>& q, const Real3& n) {
  const Norm inner = norm_of(std::abs(q[0] * n.x()), std::abs(q[1] * n.y()), dual(q[3]));
  const Norm outer = norm_of(inner.value, std::abs(q[2] * n.z()), dual(q[4]));
  return {std::copysign(q[0] * outer.dx * inner.dx, n.x()), std::copysign(q[1] * outer.dx * inner.dy, n.y()),
          std::copysign(q[2] * outer.dy, n.z())};
}

/// The height s maximises w(s) N(s) + c nz s, a concave function. With s = sign z^(1/epsilon), w = (1 - z)^(1/epsilon) near an end.
Real3 superovoid_point(const std::vector<Real>& q, const Real3& n) {
  const Real a = q[0], b = q[1], c = q[2], p = dual(q[3]), e = q[4];
  // The angle along the meridian: |s|^e = sin^2, w^e = cos^2.
  const auto slope_at = [&](Real angle, Real& s, Real& w, Norm& width) {
    const Real cosine = std::cos(angle), sine = std::sin(angle);
    s = std::copysign(std::pow(std::abs(sine), 2 / e), angle);
    w = std::pow(cosine, 2 / e);
    const Real X = 1 + q[5] * s, Y = 1 + q[6] * s;
    width = norm_of(a * X * std::abs(n.x()), b * Y * std::abs(n.y()), p);
    const Real width_slope = width.dx * a * q[5] * std::abs(n.x()) + width.dy * b * q[6] * std::abs(n.y());
    // dw/ds = -(|s|/w)^(epsilon - 1)
    const Real meridian = -std::copysign(std::pow(std::abs(sine), 2 - 2 / e), angle) * std::pow(cosine, 2 / e - 2);
    return meridian * width.value + w * width_slope + c * n.z();
  };
  const Real quarter = std::acos(static_cast<Real>(-1)) / 2;
  // The Illinois method: the secant, with half of a value that has stayed twice.
  Real low = -quarter, high = quarter, s = 0, w = 0;
  Norm width{};
  Real f_low = 1, f_high = -1, angle = 0;
  int side = 0;
  for (int k = 0; k < 200; ++k) {
    angle = k < 4 ? 0.5L * (low + high) : (low * f_high - high * f_low) / (f_high - f_low);
    if (!(angle > low && angle < high)) break;
    const Real f = slope_at(angle, s, w, width);
    if (f == 0) break;
    if (f > 0) {
      low = angle;
      f_low = f;
      if (side == 1) f_high *= 0.5L;
      side = 1;
    } else {
      high = angle;
      f_high = f;
      if (side == -1) f_low *= 0.5L;
      side = -1;
    }
  }
  slope_at(angle, s, w, width);
  return {std::copysign(a * (1 + q[5] * s) * w * width.dx, n.x()), std::copysign(b * (1 + q[6] * s) * w * width.dy, n.y()), c * s};
}

Real3 superellipsoid_gradient(const std::vector<Real>& q, const Real3& x) {
  const Norm inner = norm_of(std::abs(x.x() / q[0]), std::abs(x.y() / q[1]), q[3]);
  const Norm outer = norm_of(inner.value, std::abs(x.z() / q[2]), q[4]);
  return {std::copysign(outer.dx * inner.dx / q[0], x.x()), std::copysign(outer.dx * inner.dy / q[1], x.y()),
          std::copysign(outer.dy / q[2], x.z())};
}

Real3 farthest(const std::vector<Real3>& points, const Real3& n) {
  return *std::max_element(points.begin(), points.end(), [&](const Real3& a, const Real3& b) { return n.dot(a) < n.dot(b); });
}

/// At most two independent edges between the highest points.
std::vector<Real3> edges_of(const std::vector<Real3>& points, const Real3& n) {
  const Real3 top = farthest(points, n);
  Real size = 0;
  for (const Real3& p : points) size = std::max(size, p.norm());
  std::vector<Real3> edges;
  for (const Real3& p : points) {
    const Real3 edge = p - top;
    if (n.dot(-edge) > kSameNormal * size || edge.norm() < 1e-9L * size) continue;
    if (edges.empty() || (edges.size() == 1 && edges[0].cross(edge).norm() > 1e-6L * edges[0].norm() * edge.norm()))
      edges.push_back(edge);
  }
  return edges;
}

std::vector<Real3> box_vertices(const std::vector<Real>& q) {
  std::vector<Real3> points;
  points.reserve(8);
  for (int k = 0; k < 8; ++k) points.emplace_back(k & 1 ? q[0] : -q[0], k & 2 ? q[1] : -q[1], k & 4 ? q[2] : -q[2]);
  return points;
}

}  // namespace

Real3 LongBody::point(const Real3& n) const {
  const std::vector<Real>& q = parameters;
  switch (kind) {
    case Kind::Superellipsoid:
      return superellipsoid_point(q, n);
    case Kind::Superovoid:
      return superovoid_point(q, n);
    case Kind::Sphere:
      return q[0] * n;
    case Kind::Box:
      return {std::copysign(q[0], n.x()), std::copysign(q[1], n.y()), std::copysign(q[2], n.z())};
    case Kind::Capsule:
      return q[0] * n + Real3(0, 0, std::copysign(q[1], n.z()));
    case Kind::Cylinder: {
      const Real across = std::hypot(n.x(), n.y());
      if (across < kSameNormal) return {0, 0, std::copysign(q[1], n.z())};
      return {q[0] * n.x() / across, q[0] * n.y() / across, std::copysign(q[1], n.z())};
    }
    case Kind::Polytope:
      return farthest(vertices, n);
    case Kind::Rounded:
      return parts[0]->point(n) + q[0] * n;
    case Kind::Sum:
      return parts[0]->point(n) + parts[1]->point(n);
    case Kind::Image:
      return matrix * parts[0]->point((matrix.transpose() * n).normalized());
  }
  return Real3::Zero();
}

Real3 LongBody::gradient(const Real3& x) const {
  return kind == Kind::Superellipsoid ? superellipsoid_gradient(parameters, x) : Real3(Real3::Zero());
}

std::vector<Real3> LongBody::edges(const Real3& n) const {
  switch (kind) {
    case Kind::Superellipsoid:
    case Kind::Superovoid:
    case Kind::Sphere:
      return {};
    case Kind::Box:
      return edges_of(box_vertices(parameters), n);
    case Kind::Polytope:
      return edges_of(vertices, n);
    case Kind::Capsule:
      if (std::abs(n.z()) < kSameNormal) return {Real3::UnitZ()};
      return {};
    case Kind::Cylinder:
      if (std::abs(n.z()) < kSameNormal) return {Real3::UnitZ()};
      if (std::hypot(n.x(), n.y()) < kSameNormal) return {Real3::UnitX(), Real3::UnitY()};
      return {};
    case Kind::Rounded:
      return parts[0]->edges(n);
    case Kind::Sum: {
      std::vector<Real3> all = parts[0]->edges(n);
      for (const Real3& edge : parts[1]->edges(n)) all.push_back(edge);
      return all;
    }
    case Kind::Image: {
      std::vector<Real3> all = parts[0]->edges((matrix.transpose() * n).normalized());
      for (Real3& edge : all) edge = (matrix * edge).eval();
      return all;
    }
  }
  return {};
}

std::size_t LongBody::parameter_count() const {
  std::size_t count = parameters.size();
  for (const auto& part : parts) count += part->parameter_count();
  return count;
}

std::shared_ptr<const LongBody> LongBody::with_change(std::size_t k, Real change) const {
  auto changed = std::make_shared<LongBody>(*this);
  for (auto& part : changed->parts) {
    const std::size_t count = part->parameter_count();
    if (k < count) {
      part = part->with_change(k, change);
      return changed;
    }
    k -= count;
  }
  changed->parameters[k] += change;
  return changed;
}

std::shared_ptr<const LongBody> long_body_of(const Shape& shape) {
  const auto make = [](Kind kind, std::vector<Real> parameters, std::vector<std::shared_ptr<const LongBody>> parts = {}) {
    return std::make_shared<LongBody>(
        LongBody{.kind = kind, .parameters = std::move(parameters), .vertices = {}, .parts = std::move(parts)});
  };
  const auto with_lengths = [](const Vector3& a, std::vector<Real> others) {
    others.insert(others.begin(), {a.x(), a.y(), a.z()});
    return others;
  };
  if (const auto* it = dynamic_cast<const Superellipsoid*>(&shape))
    return make(Kind::Superellipsoid, with_lengths(it->half_axes(), {it->delta(), it->epsilon()}));
  if (const auto* it = dynamic_cast<const Ellipsoid*>(&shape))
    return make(Kind::Superellipsoid, with_lengths(it->half_axes(), {2, 2}));
  if (const auto* it = dynamic_cast<const Superovoid*>(&shape))
    return make(Kind::Superovoid, with_lengths(it->half_axes(), {it->delta(), it->epsilon(), it->taper_x(), it->taper_y()}));
  if (const auto* it = dynamic_cast<const Sphere*>(&shape)) return make(Kind::Sphere, {it->radius()});
  if (const auto* it = dynamic_cast<const Box*>(&shape)) return make(Kind::Box, with_lengths(it->half_lengths(), {}));
  if (const auto* it = dynamic_cast<const Capsule*>(&shape)) return make(Kind::Capsule, {it->radius(), it->half_length()});
  if (const auto* it = dynamic_cast<const Cylinder*>(&shape)) return make(Kind::Cylinder, {it->radius(), it->half_length()});
  if (const auto* it = dynamic_cast<const Rounded*>(&shape)) return make(Kind::Rounded, {it->radius()}, {long_body_of(it->core())});
  if (const auto* it = dynamic_cast<const MinkowskiSum*>(&shape))
    return make(Kind::Sum, {}, {long_body_of(it->first()), long_body_of(it->second())});
  if (const auto* it = dynamic_cast<const LinearImage*>(&shape)) {
    const auto image = make(Kind::Image, {}, {long_body_of(it->shape())});
    image->matrix = it->matrix().cast<Real>();
    return image;
  }
  const auto polytope = make(Kind::Polytope, {});
  for (const Vector3& p : dynamic_cast<const Polytope&>(shape).points()) polytope->vertices.emplace_back(p.cast<Real>());
  return polytope;
}

LongPose LongPose::moved(const Real3& v, const Real3& w) const {
  const Real angle = w.norm();
  return {position + v, angle > 0 ? Real33(Eigen::AngleAxis<Real>(angle, w / angle) * rotation) : rotation};
}

Real long_gap(const LongBody& body1, const LongPose& pose1, const LongBody& body2, const LongPose& pose2, const Real3& normal) {
  const Real3 n = normal.normalized(), n1 = pose1.rotation.transpose() * n, n2 = -(pose2.rotation.transpose() * n);
  return n.dot(pose2.position - pose1.position) - n1.dot(body1.point(n1)) - n2.dot(body2.point(n2));
}

}  // namespace supernormal::test
