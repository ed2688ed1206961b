// Two tangents of a surface from its normal, with their derivatives.
#pragma once

#include <array>
#include <limits>

#include "superquadric.hpp"

namespace literature {

/// The second and third columns of the Householder matrix that maps a unit normal to the x-axis (Lopes et al. 2010, 2013), and
/// their derivatives by the normal.
struct Tangents {
  std::array<Vector3, 2> tangent;
  std::array<Matrix3, 2> rate;
};

Tangents tangents_of(const Vector3& normal);

/// A unit vector and its derivative, from a vector of any length with its derivative. NaN for a zero vector.
template <int kColumns>
struct Normalized {
  Vector3 vector;
  Eigen::Matrix<double, 3, kColumns> rate;

  Normalized(const Vector3& v, const Eigen::Matrix<double, 3, kColumns>& v_rate) {
    double length = v.norm();
    if (length == 0) length = std::numeric_limits<double>::quiet_NaN();
    vector = v / length;
    rate = (v_rate - vector * (vector.transpose() * v_rate)) / length;
  }
};

}  // namespace literature
