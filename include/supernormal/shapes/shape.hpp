// A convex body as its generating potential (support function): give a normal, get the boundary point that has it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "supernormal/export.h"

namespace supernormal {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

/// How much of the potential an evaluation has to deliver; each level includes those before it.
enum class Order {
  Value,    ///< h
  Point,    ///< h and r
  Hessian,  ///< h, r and H
};

/// The generating potential and its derivatives in one normal direction n, all in the body's frame.
struct Jet {
  double h = 0;                 ///< m; support function, the distance from the body's origin to the tangent plane with normal n
  Vector3 r = Vector3::Zero();  ///< m; gradient of h: the boundary point with outward normal n, n.r = h
  Matrix3 H = Matrix3::Zero();  ///< m; Hessian of h: symmetric, H n = 0; the other eigenvalues are the radii of curvature
};

/// Volume integrals of a homogeneous body of density one, in its own frame.
struct MassProperties {
  double volume = 0;                        ///< m^3
  Vector3 centroid = Vector3::Zero();       ///< m
  Matrix3 second_moment = Matrix3::Zero();  ///< m^5; integral of x x^T about the origin of the body's frame
  double relative_error = 0;                ///< estimated, of volume and moments relative to their size; 0 for closed forms
};

/// Some points of a body that has faces or straight edges, in its own frame: see Shape::add_active_vertices.
class ActiveVertices {
 public:
  static constexpr int kCapacity = 8;

  void clear() { *this = ActiveVertices(); }
  void add(const Vector3& point) { points_[static_cast<std::size_t>(count_++)] = point; }
  int size() const { return count_; }
  const Vector3& operator[](int k) const { return points_[static_cast<std::size_t>(k)]; }

  /// Whether the body has more corners than it named. They must then be the same points for every normal.
  bool is_partial() const { return is_partial_; }
  void set_partial() { is_partial_ = true; }

 private:
  std::array<Vector3, kCapacity> points_;
  int count_ = 0;
  bool is_partial_ = false;
};

class Superellipsoid;

/// A convex body known by its normal parameterization (Roemer; DESIGN section 1). The functions of a shape are pure:
/// any number of threads may call them at once.
class SUPERNORMAL_API Shape {
 public:
  Shape() = default;
  Shape(const Shape&) = default;
  Shape(Shape&&) = default;
  Shape& operator=(const Shape&) = default;
  Shape& operator=(Shape&&) = default;
  virtual ~Shape() = default;

  /// Evaluates the potential for the unit normal n, up to `order`; members of a higher order are left as they are.
  /// On a flat face the radius of curvature is infinite; H then holds a large finite number.
  virtual void evaluate(const Vector3& n, Order order, Jet& jet) const = 0;

  /// Itself, if it is one: two superellipsoids are evaluated together.
  virtual const Superellipsoid* as_superellipsoid() const { return nullptr; }

  /// Whether evaluate() can deliver Order::Hessian. Solvers estimate the curvature from boundary points otherwise.
  virtual bool has_hessian() const { return true; }

  /// The normal to move to when the boundary point is to move from jet.r by H dn: to first order n + dn. Shapes with flat faces
  /// override it, because there the normal is a smooth function of the boundary point but not the other way round.
  /// `jet` is the one of the unit normal n, with curvature. The result need not be of unit length.
  virtual Vector3 advance_normal(const Vector3& n, const Jet& jet, const Vector3& dn) const;

  /// Whether advance_normal() is more than n + dn.
  virtual bool has_flat_faces() const { return false; }

  /// Whether the body has flat faces or straight edges in the strict sense, so that its support function has kinks: all points of
  /// a face share one normal. evaluate() then delivers one of them, and H without the jump.
  virtual bool has_kinks() const { return false; }

  /// For a body with kinks: at most ActiveVertices::kCapacity points that are or become its boundary points as the normal turns,
  /// the first to do so. Each bounds the support function, h(m) >= m.corner for every m; r(n) may be among them. Of a curved face
  /// with normal n, three that have its point nearest to `toward` (body's frame) between them.
  virtual void add_active_vertices(const Vector3& n, const Vector3& toward, ActiveVertices& corners) const;

  /// Whether the way from one normal to another crosses that of a curved face, such as the cap of a cylinder, which no corners
  /// announce; then `face` is that normal.
  virtual bool crosses_curved_face(const Vector3& from, const Vector3& to, Vector3& face) const;

  /// Whether no cap of the body is wider than one of an ellipsoid is, but for a little: it never rests on more than one point
  /// (contact_manifold.hpp). False where it is not known.
  virtual bool is_round() const { return false; }

  /// Whether the body is its own image in the origin of its frame: h(-n) = h(n), digit by digit. False where it is not known.
  virtual bool is_symmetric() const { return false; }

  /// Half of the extent along the three axes of the body's frame, m.
  virtual Vector3 half_extents() const;

  /// m; about the smallest radius of curvature, 0 with an edge or a corner. An estimate, for where to look: rolling_radius() is
  /// proved. Of vertices where the radius vanishes at one normal only it may be that of what is beside them. Unless overridden,
  /// that of the ellipsoid of the same extents.
  virtual double min_curvature_radius_estimate() const;

  /// m; a ball of this radius provably rolls freely inside the body: no radius of curvature is smaller, so that the body is the sum
  /// of the ball and another convex body (Blaschke's rolling theorem; Schneider, Convex Bodies, theorem 3.2.12). A lower bound, 0
  /// where none is known. Two bodies that overlap by less than the sum of theirs have one local maximum of the gap only.
  virtual double rolling_radius() const { return 0; }

  /// Volume, centroid and second moments; a closed form where there is one, quadrature over the normals otherwise: to 1e-10 for a
  /// smooth body; flat faces and straight edges, which the normals do not see, are missing and counted in relative_error.
  /// std::domain_error when the shape delivers values that are not finite.
  virtual MassProperties mass_properties() const;

  /// h(n), m.
  double support(const Vector3& n) const;

  /// r(n), m.
  Vector3 point(const Vector3& n) const;

  /// h, r and H together.
  Jet jet(const Vector3& n) const;
};

}  // namespace supernormal
