// A convex body given by its support function and the boundary point of each outward normal.
#pragma once

#if (defined(_MSVC_LANG) ? _MSVC_LANG : __cplusplus) < 202002L
#error "supernormal's C++ headers need C++20 (-std=c++20). The C interface, supernormal/supernormal.h, takes any C or C++."
#endif

#include <Eigen/Core>
#include <array>
#include <span>

#include "supernormal/export.h"
#include "supernormal/shapes/parameter_gradient.hpp"

namespace supernormal {

using Vector3 = Eigen::Vector3d;  ///< a point, a direction or three lengths
using Matrix3 = Eigen::Matrix3d;  ///< a rotation, a Hessian or an inertia tensor

/// What an evaluation has to deliver; each level includes the levels before it.
enum class Order {
  Value,    ///< h
  Point,    ///< h and r
  Hessian,  ///< h, r and H
};

/// The support function and its derivatives at one unit normal n, in the body's frame.
struct Jet {
  double h = 0;                 ///< m; support function: the distance from the body's origin to the tangent plane with normal n
  Vector3 r = Vector3::Zero();  ///< m; gradient of h: the boundary point with outward normal n, n.r = h
  Matrix3 H = Matrix3::Zero();  ///< m; Hessian of h: symmetric, H n = 0; the other eigenvalues are the radii of curvature
};

/// Volume integrals of a homogeneous body of density one, in its own frame.
struct MassProperties {
  double volume = 0;                        ///< m^3
  Vector3 centroid = Vector3::Zero();       ///< m
  Matrix3 second_moment = Matrix3::Zero();  ///< m^5; integral of x x^T about the origin of the body's frame
  double relative_error = 0;                ///< estimate, for volume and moments relative to their size; 0 for closed forms

  /// m^5; the inertia tensor about the centroid, along the axes of the body's frame: tr(C) 1 - C with C = second_moment - volume c
  /// c^T. Multiplied by the density (kg/m^3) it is in kg m^2.
  Matrix3 inertia() const {
    const Matrix3 central = second_moment - volume * centroid * centroid.transpose();
    return central.trace() * Matrix3::Identity() - central;
  }
};

/// Some vertices of a body with faces or straight edges, in its own frame: see Shape::add_active_vertices.
class ActiveVertices {
 public:
  static constexpr int kCapacity = 8;  ///< the capacity of a list

  void clear() { *this = ActiveVertices(); }                                               ///< empties the list
  void add(const Vector3& point) { points_[static_cast<std::size_t>(count_++)] = point; }  ///< m; at most kCapacity
  int size() const { return count_; }                                                      ///< the number of points
  const Vector3& operator[](int k) const { return points_[static_cast<std::size_t>(k)]; }  ///< m; point k, from 0 to size() - 1

  /// Whether the body has more vertices than the list. They must then be the same points for every normal.
  bool is_partial() const { return is_partial_; }
  void set_partial() { is_partial_ = true; }  ///< marks that the body has more vertices

 private:
  std::array<Vector3, kCapacity> points_;
  int count_ = 0;
  bool is_partial_ = false;
};

/// What is known of a body besides its support function. The defaults hold for every convex body. Each trait saves evaluations, or
/// lets a query answer more.
struct ShapeTraits {
  /// Shape::evaluate() delivers H for Order::Hessian. Queries then take fewer evaluations. Otherwise they estimate the radii of
  /// curvature from boundary points, and mass_properties() uses differences of boundary points.
  bool has_hessian = false;

  /// The body is point-symmetric about the origin of its frame: h(-n) = h(n), digit by digit.
  bool is_symmetric = false;

  /// No cap of the body is much wider than an ellipsoid's. Such a body never rests on more than one point (contact_manifold.hpp).
  bool is_round = false;

  /// The body has flat faces or straight edges in the strict sense. Its support function then has nonsmooth points: all points of a
  /// face share one normal. There evaluate() delivers one of these points, and H without the jump. Override
  /// Shape::add_active_vertices(), too.
  bool has_nonsmooth_points = false;

  /// The body is smooth, but flat somewhere: the radius of curvature is infinite there. Override Shape::advance_normal(), too.
  bool has_flat_faces = false;

  /// Every flat face is across an axis of the body's frame.
  bool has_axis_aligned_faces = false;
};

/// A convex body in its normal parameterization (Roemer; lib/shapes/README.md). A class of your own needs evaluate() alone. The
/// functions of a shape are pure: any number of threads may call them at once.
class SUPERNORMAL_API Shape {
 public:
  Shape() = default;
  Shape(const Shape&) = default;
  Shape(Shape&&) = default;
  Shape& operator=(const Shape&) = default;
  Shape& operator=(Shape&&) = default;
  virtual ~Shape() = default;

  /// Evaluates the support function for the unit normal n, up to `order`. Members of a higher order stay unchanged. It must deliver
  /// h and r. A shape that also delivers H says so in traits(). On a flat face the radius of curvature is infinite, and H holds a
  /// large finite number.
  virtual void evaluate(const Vector3& n, Order order, Jet& jet) const = 0;

  /// What else is known of the body.
  virtual ShapeTraits traits() const { return {}; }

  /// The normal to move to if the boundary point is to move from jet.r by H dn. To first order it is n + dn. Shapes with the trait
  /// has_flat_faces override it, because there the normal is a smooth function of the boundary point, but not the other way round.
  /// `jet` belongs to the unit normal n and has been evaluated with Order::Hessian. The result need not have unit length.
  virtual Vector3 advance_normal(const Vector3& n, const Jet& jet, const Vector3& dn) const;

  /// For a body with nonsmooth points: adds at most ActiveVertices::kCapacity active vertices. They are boundary points of n, or
  /// the first points to become boundary points as the normal rotates. Each bounds the support function: h(m) >= m.vertex for every
  /// m. r(n) may be one of them. If n is the normal of a curved face, they are three points of its edge. Their triangle contains
  /// the face's point nearest to `toward` (body's frame).
  virtual void add_active_vertices(const Vector3& n, const Vector3& toward, ActiveVertices& vertices) const;

  /// Whether the arc between two normals passes the normal of a curved face, such as the cap of a cylinder, which active vertices
  /// do not announce. `face` is then set to this normal.
  virtual bool crosses_curved_face(const Vector3& from, const Vector3& to, Vector3& face) const;

  /// Whether the body surely contains the point (body's frame, m), to rounding. Bodies with a known equation decide this. False if
  /// it would need a search.
  virtual bool surely_contains(const Vector3& point) const;

  /// Appends the derivatives of h(n) with respect to the shape's parameters, at fixed n. `r` is the boundary point r(n); on a face
  /// or an edge, any point of it. A shape without parameters appends nothing.
  virtual void add_parameter_gradient(const Vector3& n, const Vector3& r, ParameterGradient& gradient) const;

  /// m; half of the extents along the three axes of the body's frame.
  virtual Vector3 half_extents() const;

  /// m; an upper bound on the distance of the body's points from the origin of its frame, which may be outside of the body. The
  /// rounding error of a query depends on it. Unless overridden, it is the distance of the farthest vertex of the bounding box.
  virtual double bounding_radius() const;

  /// m; an estimate of the smallest radius of curvature; 0 for a body with an edge or a vertex. Solvers use it to decide where to
  /// search; rolling_radius() is proved. If the radius vanishes at a single normal only, the estimate may be the radius around that
  /// vertex. Unless overridden, it is the radius of the ellipsoid with the same extents.
  virtual double min_curvature_radius_estimate() const;

  /// m; a ball of this radius provably rolls freely inside the body. So no radius of curvature is smaller, and the body is the sum
  /// of the ball and another convex body (Blaschke's rolling theorem; Schneider, Convex Bodies, theorem 3.2.12). A lower bound, 0
  /// if none is known. If two bodies overlap by less than the sum of their rolling radii, the gap function has only one local
  /// maximum.
  virtual double rolling_radius() const { return 0; }

  /// Volume, centroid and second moments, in closed form if there is one, otherwise by quadrature over the normals. Quadrature is
  /// accurate to 1e-10 for a smooth body. It misses the volume behind flat faces and straight edges, which relative_error includes.
  /// Throws std::domain_error if the shape returns values that are not finite.
  virtual MassProperties mass_properties() const;

  /// m; the support function h(n).
  double support(const Vector3& n) const;

  /// m; the boundary point r(n).
  Vector3 point(const Vector3& n) const;

  /// h, r and H together.
  Jet jet(const Vector3& n) const;
};

}  // namespace supernormal
