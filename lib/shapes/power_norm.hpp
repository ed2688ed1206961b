// The norm (x^p + y^p)^(1/p) of two nonnegative numbers: the building block of superellipsoids.
#pragma once

#include <array>
#include <cstddef>

namespace supernormal {

enum class Order;

/// Value and derivatives of a PowerNorm at (x, y). The second derivatives and dx_over_x are multiplied by `value`, which keeps them
/// finite at the origin: d2/dx2 = xx / value and so on.
struct PowerNormJet {
  double value = 0;      ///< the norm
  double dx = 0;         ///< first derivative, (x/value)^(p-1)
  double dy = 0;         ///< (y/value)^(p-1)
  double dx_over_x = 0;  ///< value * dx / x, large but finite where p < 2 and x vanishes
  double xx = 0;         ///< value times the second derivative with respect to x
  double xy = 0;         ///< value times the mixed second derivative
  double yy = 0;         ///< value times the second derivative with respect to y
};

class PowerNorm;

/// A request: a norm, the point of the evaluation, and the result.
struct PowerNormRequest {
  const PowerNorm* norm;  ///< the norm
  double x;               ///< not negative
  double y;               ///< not negative
  PowerNormJet jet;       ///< the result
};

/// A request for a norm of three numbers, and the result.
struct PowerNorm3Request {
  const PowerNorm* norm;          ///< the norm
  std::array<double, 3> x;        ///< not negative
  double value = 0;               ///< the norm of x
  std::array<double, 3> slope{};  ///< first derivatives
  /// value times the second derivatives. The mixed ones are -(p - 1) slope[i] slope[j] / value.
  std::array<double, 3> bend{};
};

/// The norm (x^p + y^p)^(1/p) from two powers, or from a square root for p = 2. The larger number is factored out, so nothing
/// overflows for any p.
class PowerNorm {
 public:
  /// The norm with p = exponent.
  static PowerNorm of_exponent(double exponent);

  /// The dual norm of `exponent`: p = exponent/(exponent - 1), with p - 1 and 1/p free of cancellation.
  static PowerNorm dual_to_exponent(double exponent);

  /// The norm of x and y, which are not negative.
  double value(double x, double y) const;

  /// Value and first derivatives. At the origin, where the direction is undefined, they are the values for x = y.
  void gradient(double x, double y, PowerNormJet& jet) const;

  /// k^(p-1): the ratio of the derivatives with respect to two numbers whose ratio is k.
  double slope(double k) const;

  /// Value, first and second derivatives: all members of PowerNormJet.
  void curvature(double x, double y, PowerNormJet& jet) const;

  /// Answers one or two requests up to `order`. Two requests together take two thirds of the time of two in sequence: the
  /// logarithms and exponentials of one norm wait for each other, but not for the other norm.
  template <std::size_t kCount>
  static void evaluate_requests(std::array<PowerNormRequest, kCount>& requests, Order order);

  /// The same for three numbers, which must be plain. This takes one root less than two nested norms.
  template <std::size_t kCount>
  static void evaluate_requests(std::array<PowerNorm3Request, kCount>& requests, Order order);

  /// Whether none of three numbers vanishes beside the others. Then every derivative is finite without special care.
  static bool is_plain(double x, double y, double z);

  double p_minus_1() const { return p_minus_1_; }  ///< p - 1, without cancellation

 private:
  PowerNorm(double p, double p_minus_1, double inverse_p);

  double p_minus_1_, inverse_p_;
  double flat_power_;  // k^(p-2) at the ratio below which the second derivative stays constant
  bool is_euclidean_;
};

}  // namespace supernormal
