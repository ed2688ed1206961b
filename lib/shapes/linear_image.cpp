#include "supernormal/shapes/linear_image.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/finite.hpp"
#include "base/validation.hpp"

namespace supernormal {
namespace {

constexpr double kLargestRatio = 1e12;

}  // namespace

LinearImage::LinearImage(std::shared_ptr<const Shape> shape, const Matrix3& matrix) : shape_(std::move(shape)), matrix_(matrix) {
  if (!shape_) throw std::invalid_argument("shape is null; a shape is needed");
  if (!all_finite(matrix)) throw std::invalid_argument("matrix has an entry that is not finite");
  const Eigen::JacobiSVD<Matrix3> svd(matrix);
  largest_ = require_in("largest singular value of matrix", svd.singularValues()[0], kMinLength, kMaxLength);
  smallest_ = require_in("smallest singular value of matrix", svd.singularValues()[2], largest_ / kLargestRatio, largest_);
  inverse_ = matrix.inverse();
  half_extents_ = Shape::half_extents();
  bounding_radius_ = Shape::bounding_radius();
}

ShapeTraits LinearImage::traits() const {
  ShapeTraits traits = shape_->traits();
  traits.is_round = false;
  traits.has_axis_aligned_faces = false;
  return traits;
}

void LinearImage::evaluate(const Vector3& n, Order order, Jet& jet) const {
  const Vector3 covector = matrix_.transpose() * n;
  const double length = covector.norm();
  shape_->evaluate(covector / length, order, jet);
  jet.h *= length;
  if (order == Order::Value) return;
  jet.r = matrix_ * jet.r;
  if (order == Order::Point || !traits().has_hessian) return;
  const Matrix3 half = matrix_ * (jet.H / length);
  jet.H = half * matrix_.transpose();
  // The two triangles of the matrix differ by rounding.
  jet.H = (0.5 * (jet.H + jet.H.transpose())).eval();
}

Vector3 LinearImage::advance_normal(const Vector3& n, const Jet& jet, const Vector3& dn) const {
  if (!traits().has_flat_faces) return Shape::advance_normal(n, jet, dn);
  const Vector3 covector = matrix_.transpose() * n;
  const double length = covector.norm();
  Jet original;
  original.h = jet.h / length;
  original.r = inverse_ * jet.r;
  original.H = length * (inverse_ * jet.H * inverse_.transpose());
  return inverse_.transpose() * shape_->advance_normal(covector / length, original, matrix_.transpose() * dn / length);
}

void LinearImage::add_active_vertices(const Vector3& n, const Vector3& toward, ActiveVertices& vertices) const {
  ActiveVertices originals;
  shape_->add_active_vertices((matrix_.transpose() * n).normalized(), inverse_ * toward, originals);
  for (int k = 0; k < originals.size(); ++k) vertices.add(matrix_ * originals[k]);
  if (originals.is_partial()) vertices.set_partial();
}

bool LinearImage::crosses_curved_face(const Vector3& from, const Vector3& to, Vector3& face) const {
  Vector3 original;
  if (!shape_->crosses_curved_face(matrix_.transpose() * from, matrix_.transpose() * to, original)) return false;
  face = (inverse_.transpose() * original).normalized();
  return true;
}

double LinearImage::min_curvature_radius_estimate() const {
  return shape_->min_curvature_radius_estimate() * smallest_ * (smallest_ / largest_);
}

MassProperties LinearImage::mass_properties() const {
  MassProperties mass = shape_->mass_properties();
  const double dilation = std::abs(matrix_.determinant());
  mass.volume *= dilation;
  mass.centroid = matrix_ * mass.centroid;
  mass.second_moment = dilation * (matrix_ * mass.second_moment * matrix_.transpose());
  return mass;
}

void LinearImage::add_parameter_gradient(const Vector3& n, const Vector3& r, ParameterGradient& gradient) const {
  const Vector3 covector = matrix_.transpose() * n;
  const double length = covector.norm();
  const std::size_t first = gradient.size();
  shape_->add_parameter_gradient(covector / length, inverse_ * r, gradient);
  gradient.scale(length, first);
}

}  // namespace supernormal
