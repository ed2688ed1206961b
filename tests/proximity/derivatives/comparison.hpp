// Random pairs of all classes, and the comparison of their derivatives with differences of the reference.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>

#include "proximity/derivatives/long_normal.hpp"
#include "supernormal/proximity/derivatives.hpp"
#include "support/draw.hpp"

namespace supernormal::test {

struct DerivativePair {
  std::string kind;
  std::shared_ptr<const Shape> shape1, shape2;
  Pose pose1, pose2;
};

/// Draws pairs: the kinds of bodies in turn, apart, touching and overlapped by up to 0.3 of the smallest half-extent.
class DerivativePairs : private Draw {
 public:
  using Draw::Draw;
  DerivativePair draw();

  /// Bodies of 1 mm to 10 m, a face or flat side of one opposite to one of the other, tilted by 0 to 1e-3 rad.
  DerivativePair draw_flat();

 private:
  Vector3 direction();
  Vector3 lengths(double low, double high);
  std::shared_ptr<const Shape> smooth(int kind);
  std::shared_ptr<const Shape> any(int kind);
  Vector3 normal_of_face_or_edge(int kind, const Shape& shape);
  Vector3 witness(const Shape& shape, const Vector3& n);

  double scale_ = 1;  // of the lengths
  int count_ = 0;
};

/// What differs, relative to the norm of the derivative in units of the bodies' size. The last two compare all derivatives with
/// those of the swapped bodies, and of both bodies in a moved frame.
enum Quantity { OfGap, OfNormal, OfPoint1, OfPoint2, OfHessian, OfParameters, OfSwapped, OfMoved, QuantityCount };
inline constexpr std::array<const char*, QuantityCount> kQuantityNames = {"gap",     "normal",     "point 1", "point 2",
                                                                          "Hessian", "parameters", "swapped", "moved"};

/// The figures of many comparisons.
struct Tally {
  struct Figures {
    int compared = 0, undecided = 0, wrong = 0;
    double worst = 0;
  };
  std::array<Figures, QuantityCount> figures;
  std::map<DerivativeStatus, int> statuses;
  int pairs = 0, not_finite = 0, evaluations = 0, unreferenced = 0;
  std::string first_wrong;
};

/// Largest relative errors that count as right.
inline constexpr std::array<double, QuantityCount> kLargestErrors = {1e-6, 1e-6, 1e-6, 1e-6, 1e-4, 1e-6, 1e-6, 1e-6};

/// Compares one pair and adds it to the tally. `name` is for the report.
void compare(const DerivativePair& pair, const std::string& name, Tally& tally);

/// Gradients of the gap of flat pairs, beside one-sided differences over 1e-6 rad.
struct FlatTally {
  int pairs = 0, defined = 0, refused = 0, unanswered = 0, evaluations = 0;
  int second = 0;    ///< all derivatives are defined
  int wrong = 0;     ///< the gradient is defined, and a difference is off by 1e-2 sizes of the smaller body
  int needless = 0;  ///< refused, though the differences of both sides agree to 1e-4 sizes
  std::string wrong_pairs;
};

/// Compares one pair and adds it to the tally. `name` is for the report.
void compare_flat(const DerivativePair& pair, const std::string& name, FlatTally& tally);

}  // namespace supernormal::test
