#include "ode/geom/rotation.hpp"

#include <stdexcept>
#include <string>

#include "base/finite.hpp"
#include "base/validation.hpp"
#include "ode/geom/geom_class.hpp"

namespace supernormal::ode {
namespace {

// A rotation typed with three decimals is accepted. A scale or shear of one per cent is not.
constexpr double kNearRotation = 1e-2;

// A step squares the error of a rotation. Below this error, one more step leaves only rounding.
constexpr double kLastError = 1e-8;

// The squares of entries larger than this would overflow.
constexpr double kLargestEntry = 1e100;

std::string matrix_text(const Matrix3& R) {
  std::string text;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      text += to_text(R(row, column)) + (column < 2 ? ", " : row < 2 ? "; " : "");
    }
  }
  return "[" + text + "]";
}

}  // namespace

// Newton-Schulz iteration for the orthogonal factor of the polar decomposition: no inverse is needed.
Matrix3 nearest_rotation(const Matrix3& R, dGeomID geom) {
  if (!all_finite(R)) return R;
  const bool is_near = all_within(R, kLargestEntry) && rotation_error(R) <= kNearRotation;
  if (!is_near) {
    throw std::invalid_argument("the rotation of " + geom_class_name(geom) + " is " + matrix_text(R) +
                                " (by rows), but must be orthonormal and right-handed to " + to_text(kNearRotation));
  }
  Matrix3 Q = R;
  double error = 0;
  do {
    error = rotation_error(Q);
    Q = Q * (1.5 * Matrix3::Identity() - 0.5 * Q.transpose() * Q);
  } while (error > kLastError);
  return Q;
}

}  // namespace supernormal::ode
