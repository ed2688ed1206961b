// A convex body given by its support function and the boundary point of each outward normal.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "supernormal/export.h"

namespace supernormal {

using Vector3 = Eigen::Vector3d;  ///< a point, a direction or three lengths
using Matrix3 = Eigen::Matrix3d;  ///< a rotation, a Hessian or an inertia tensor

/// How much an evaluation has to deliver; each level includes those before it.
enum class Order {
  Value,    ///< h
  Point,    ///< h and r
  Hessian,  ///< h, r and H
};

/// The support function and its derivatives in one normal direction n, all in the body's frame.
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
  double relative_error = 0;                ///< estimate, for volume and moments relative to their size; 0 for closed forms

  /// m^5; inertia tensor about the centroid, along the axes of the body's frame: tr(C) 1 - C with C = second_moment - volume c c^T.
  /// Times the density (kg/m^3) it is in kg m^2.
  Matrix3 inertia() const {
    const Matrix3 central = second_moment - volume * centroid * centroid.transpose();
    return central.trace() * Matrix3::Identity() - central;
  }
};

/// Some points of a body that has faces or straight edges, in its own frame: see Shape::add_active_vertices.
class ActiveVertices {
 public:
  static constexpr int kCapacity = 8;  ///< the most points that a list holds

  void clear() { *this = ActiveVertices(); }                                               ///< empties the list
  void add(const Vector3& point) { points_[static_cast<std::size_t>(count_++)] = point; }  ///< m; at most kCapacity
  int size() const { return count_; }                                                      ///< how many points there are
  const Vector3& operator[](int k) const { return points_[static_cast<std::size_t>(k)]; }  ///< m; point k, from 0 to size() - 1

  /// Whether the body has more corners than the list names. They must then be the same points for every normal.
  bool is_partial() const { return is_partial_; }
  void set_partial() { is_partial_ = true; }  ///< says that the body has more corners

 private:
  std::array<Vector3, kCapacity> points_;
  int count_ = 0;
  bool is_partial_ = false;
};

class Superellipsoid;

/// A convex body known by its normal parameterization (Roemer; lib/shapes/README.md). The functions of a shape are pure: any
/// number of threads may call them at once.
class SUPERNORMAL_API Shape {
 public:
  Shape() = default;
  Shape(const Shape&) = default;
  Shape(Shape&&) = default;
  Shape& operator=(const Shape&) = default;
  Shape& operator=(Shape&&) = default;
  virtual ~Shape() = default;

  /// Evaluates the support function for the unit normal n, up to `order`; members of a higher order are left unchanged. It must
  /// deliver h and r. A shape that delivers H too says so with has_hessian(). On a flat face the radius of curvature is infinite; H
  /// then holds a large finite number.
  virtual void evaluate(const Vector3& n, Order order, Jet& jet) const = 0;

  /// This object if it is a superellipsoid, null otherwise: two superellipsoids are evaluated together.
  virtual const Superellipsoid* as_superellipsoid() const { return nullptr; }

  /// Whether evaluate() delivers H for Order::Hessian. Override it where it does: queries then take fewer evaluations. Otherwise
  /// solvers estimate the radii of curvature from boundary points, and mass_properties() takes differences of these.
  virtual bool has_hessian() const { return false; }

  /// The normal to move to when the boundary point is to move from jet.r by H dn; to first order it is n + dn. Shapes with flat
  /// faces override it, because there the normal is a smooth function of the boundary point but not the other way round. `jet`
  /// belongs to the unit normal n and has been evaluated with Order::Hessian. The result need not be of unit length.
  virtual Vector3 advance_normal(const Vector3& n, const Jet& jet, const Vector3& dn) const;

  /// Whether advance_normal() differs from n + dn.
  virtual bool has_flat_faces() const { return false; }

  /// Whether every flat face is across an axis of the body's frame. False where it is not known.
  virtual bool has_axis_aligned_faces() const { return false; }

  /// Whether the body has flat faces or straight edges in the strict sense, so that its support function has kinks: all points of
  /// a face share one normal. evaluate() then delivers one of them, and H without the jump.
  virtual bool has_kinks() const { return false; }

  /// For a body with kinks: adds at most ActiveVertices::kCapacity points that are or become its boundary points as the normal
  /// turns, the first to do so. Each bounds the support function, h(m) >= m.corner for every m; r(n) may be among them. For a
  /// curved face with normal n, they are three points of its rim whose triangle contains its point nearest to `toward` (body's
  /// frame).
  virtual void add_active_vertices(const Vector3& n, const Vector3& toward, ActiveVertices& corners) const;

  /// Whether the arc from one normal to another passes the normal of a curved face, such as the cap of a cylinder, which no
  /// active vertices announce; `face` is then set to that normal.
  virtual bool crosses_curved_face(const Vector3& from, const Vector3& to, Vector3& face) const;

  /// Whether no cap of the body is much wider than that of an ellipsoid: such a body never rests on more than one point
  /// (contact_manifold.hpp). False where it is not known.
  virtual bool is_round() const { return false; }

  /// Whether the body is point-symmetric about the origin of its frame: h(-n) = h(n), digit by digit. False where it is not
  /// known.
  virtual bool is_symmetric() const { return false; }

  /// Whether the body surely contains the point (body's frame, m), to rounding: so say bodies whose equation is at hand. False
  /// where that is not known without a search.
  virtual bool surely_contains(const Vector3& point) const;

  /// Half of the extent along the three axes of the body's frame, m.
  virtual Vector3 half_extents() const;

  /// m; no point of the body is farther from the origin of its frame, which may be outside of the body. By this the rounding error
  /// of a query is judged. Unless overridden, it is the distance of a corner of the bounding box.
  virtual double bounding_radius() const;

  /// m; an estimate of the smallest radius of curvature, 0 for a body with an edge or a corner. It tells solvers where to look;
  /// rolling_radius() is proved. For vertices where the radius vanishes at one normal only, it may be that of the vertex'
  /// surroundings. Unless overridden, it is that of the ellipsoid of the same extents.
  virtual double min_curvature_radius_estimate() const;

  /// m; a ball of this radius provably rolls freely inside the body: no radius of curvature is smaller, so that the body is the sum
  /// of the ball and another convex body (Blaschke's rolling theorem; Schneider, Convex Bodies, theorem 3.2.12). A lower bound, 0
  /// where none is known. Two bodies that overlap by less than the sum of theirs have one local maximum of the gap only.
  virtual double rolling_radius() const { return 0; }

  /// Volume, centroid and second moments, in closed form where there is one and otherwise by quadrature over the normals: to
  /// 1e-10 for a smooth body; the volume behind flat faces and straight edges, which the normals do not see, is missing and
  /// accounted for in relative_error. std::domain_error when the shape delivers values that are not finite.
  virtual MassProperties mass_properties() const;

  /// The support function h(n), m.
  double support(const Vector3& n) const;

  /// The boundary point r(n), m.
  Vector3 point(const Vector3& n) const;

  /// h, r and H together.
  Jet jet(const Vector3& n) const;
};

}  // namespace supernormal
