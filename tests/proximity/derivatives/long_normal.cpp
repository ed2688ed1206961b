#include "proximity/derivatives/long_normal.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>

namespace supernormal::test {
namespace {

using Real2 = Eigen::Matrix<Real, 2, 1>;
using Real22 = Eigen::Matrix<Real, 2, 2>;

constexpr int kMaxSteps = 60;

/// One solution, in the frame of the world but with the origin in body 1.
class Search {
 public:
  Search(const LongBody& body1, const LongPose& pose1, const LongBody& body2, const LongPose& pose2,
         const std::vector<Real3>& edges1, const std::vector<Real3>& edges2)
      : body1_(body1), body2_(body2), R1_(pose1.rotation), R2_(pose2.rotation), offset_(pose2.position - pose1.position) {
    for (const Real3& e : edges1) edges_.push_back((R1_ * e).normalized());
    for (const Real3& e : edges2) edges_.push_back((R2_ * e).normalized());
    first_edges_ = edges1.size();
  }

  LongAnswer run(Real3 n) {
    LongAnswer out;
    if (edges_.size() > 2) return out;
    n = onto_edges(n);
    bool is_new = true;  // whether the radii of curvature are from this normal
    Real22 M = curvature(n, 1e-8L);
    for (int step = 0; step < kMaxSteps; ++step) {
      const Real before = residual(n);
      if (before <= 8 * limit() || edges_.size() == 2) break;
      // Steps with the radii of an earlier normal converge linearly, and take one evaluation each.
      const Real3 trial = onto_edges(n + newton_step(n, M));
      if (trial.allFinite() && residual(trial) < 0.5L * before) {
        n = trial;
        is_new = false;
        continue;
      }
      if (!is_new) {
        M = curvature(n, 1e-8L);
        is_new = true;
        continue;
      }
      Real3 best = n;
      Real least = before;
      for (const Real3& proposal : proposals(n)) {
        const Real after = residual(proposal);
        if (after < least) {
          least = after;
          best = proposal;
        }
      }
      if (!(least < 0.9L * before)) break;
      n = best;
      M = curvature(n, 1e-8L);
    }
    const Real3 p1 = point1(n), p2 = point2(n), d = p2 - p1;
    out.gap = n.dot(d);
    out.normal = n;
    out.point1 = p1 + shift1(n, d);
    out.point2 = out.point1 + out.gap * n;
    out.is_exact = residual(n) <= 1000 * limit();
    return out;
  }

 private:
  Real3 point1(const Real3& n) const { return R1_ * body1_.point(R1_.transpose() * n); }
  Real3 point2(const Real3& n) const { return offset_ + R2_ * body2_.point(-(R2_.transpose() * n)); }
  Real limit() const { return std::numeric_limits<Real>::epsilon() * (offset_.norm() + 1); }

  Real3 onto_edges(Real3 n) const {
    if (edges_.size() == 2) {
      const Real3 normal = edges_[0].cross(edges_[1]).normalized();
      return normal.dot(n) > 0 ? normal : Real3(-normal);
    }
    if (edges_.size() == 1) n -= edges_[0].dot(n) * edges_[0];
    return n.normalized();
  }

  /// The part of d that a common normal has not: across n and the edges.
  Real3 rest(const Real3& n) const {
    if (edges_.size() == 2) return Real3::Zero();
    const Real3 d = point2(n) - point1(n);
    Real3 across = d - d.dot(n) * n;
    if (edges_.size() == 1) across -= across.dot(edges_[0]) * edges_[0];
    return across;
  }
  Real residual(const Real3& n) const { return rest(n).norm(); }

  std::array<Real3, 2> basis(const Real3& n) const {
    const Real3 t1 = edges_.size() == 1 ? edges_[0] : n.unitOrthogonal();
    return {t1, n.cross(t1)};
  }

  /// The derivative of d across n, by differences, less s.
  Real22 curvature(const Real3& n, Real h) const {
    const auto [t1, t2] = basis(n);
    const auto column = [&, n](const Real3& t) -> Real3 {
      return (rest_all((n + h * t).normalized()) - rest_all((n - h * t).normalized())) / (2 * h);
    };
    const Real s = n.dot(rest_all(n));
    const Real3 c2 = column(t2);
    Real22 M = Real22::Identity();
    M(1, 1) = t2.dot(c2) - s;
    if (edges_.size() == 1) return M;
    const Real3 c1 = column(t1);
    M(0, 0) = t1.dot(c1) - s;
    M(0, 1) = t1.dot(c2);
    M(1, 0) = t2.dot(c1);
    return M;
  }

  Real3 newton_step(const Real3& n, const Real22& M) const {
    const auto [t1, t2] = basis(n);
    const Real3 d = rest_all(n);
    if (edges_.size() == 1) return -t2.dot(d) / M(1, 1) * t2;
    const Real2 u = -(M.inverse() * Real2(t1.dot(d), t2.dot(d)));
    return u.x() * t1 + u.y() * t2;
  }

  /// Newton's step with radii of curvature by other differences, and steps through the boundary points of bodies with an equation.
  std::vector<Real3> proposals(const Real3& n) const {
    std::vector<Real3> out;
    const Real3 from1 = point1(n), from2 = point2(n);
    const Real s = n.dot(from2 - from1);
    const auto push = [&](const Real3& g, const Real33& R, int sign) {
      if (g.norm() > 0 && g.allFinite()) out.emplace_back(sign * (R * g).normalized());
    };
    for (const Real h : {1e-5L, 1e-8L, 1e-12L}) {
      const Real3 step = newton_step(n, curvature(n, h));
      if (!step.allFinite()) continue;
      for (const Real part : {1.0L, 0.25L}) out.push_back(onto_edges(n + part * step));
      if (!edges_.empty()) continue;
      // The boundary point that Newton's step aims at, by the other body's point.
      const Real3 tilted = (n + step).normalized();
      push(body1_.gradient(R1_.transpose() * (point2(tilted) - s * tilted)), R1_, 1);
      push(body2_.gradient(R2_.transpose() * (point1(tilted) + s * tilted - offset_)), R2_, -1);
    }
    if (edges_.empty()) {
      push(body1_.gradient(R1_.transpose() * (from2 - s * n)), R1_, 1);
      push(body2_.gradient(R2_.transpose() * (from1 + s * n - offset_)), R2_, -1);
    }
    return out;
  }

  Real3 rest_all(const Real3& n) const { return point2(n) - point1(n); }

  /// How far point 1 moves along its edge or face to be opposite point 2.
  Real3 shift1(const Real3& n, const Real3& d) const {
    const Real3 across = d - d.dot(n) * n;
    if (edges_.empty() || first_edges_ == 0) return Real3::Zero();  // point 2 is free, or nothing is
    if (first_edges_ == edges_.size()) return across;               // point 1 is free
    const Real3 &e1 = edges_[0], &e2 = edges_[1];
    return n.cross(e2).dot(across) / n.cross(e2).dot(e1) * e1;
  }

  const LongBody &body1_, &body2_;
  const Real33 R1_, R2_;
  const Real3 offset_;
  std::vector<Real3> edges_;
  std::size_t first_edges_ = 0;
};

}  // namespace

LongPose exact_pose(const Pose& pose) {
  LongPose out{pose.position.cast<Real>(), pose.rotation.cast<Real>()};
  for (int k = 0; k < 3; ++k) out.rotation = (0.5L * (out.rotation + out.rotation.inverse().transpose())).eval();
  return out;
}

LongNormal::LongNormal(const Shape& shape1, const LongPose& pose1, const Shape& shape2, const LongPose& pose2,
                       const Vector3& normal)
    : body1_(long_body_of(shape1)), body2_(long_body_of(shape2)) {
  const Real3 n = normal.cast<Real>().normalized();
  normal1_ = pose1.rotation.transpose() * n;
  edges1_ = body1_->edges(normal1_);
  edges2_ = body2_->edges(-(pose2.rotation.transpose() * n));
}

LongAnswer LongNormal::solve(const LongPose& pose1, const LongPose& pose2, const LongBody& exact1, const LongBody& exact2) const {
  LongAnswer out = Search(exact1, pose1, exact2, pose2, edges1_, edges2_).run(pose1.rotation * normal1_);
  out.point1 += pose1.position;
  out.point2 += pose1.position;
  return out;
}

}  // namespace supernormal::test
