#include "proximity/derivatives/comparison.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <utility>

#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/linear_image.hpp"
#include "supernormal/shapes/minkowski_sum.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/shapes/superovoid.hpp"
#include "support/rotation_between.hpp"
#include "support/superellipsoid_classes.hpp"

namespace supernormal::test {
namespace {

using Values = Eigen::Matrix<Real, 10, 1>;  // gap, normal, point 1, point 2

constexpr int kKinds = 16, kSmoothKinds = 10;
constexpr const char* kKindNames[kKinds] = {"ellipsoid", "needle",     "moderate", "boxy",       "extreme boxy", "octahedral",
                                            "mixed",     "superovoid", "rounded",  "sum",        "image",        "box",
                                            "capsule",   "cylinder",   "polytope", "rounded box"};
// An extended difference that is known less well than a tenth of the allowed error decides nothing.
constexpr double kResolution = 0.1;

/// f'(0) or f''(0) by differences in ever smaller steps, extrapolated to step 0 (Ridders).
template <typename Value>
struct Extrapolated {
  Value value;
  double error = std::numeric_limits<double>::infinity();
};

template <typename Value, typename Difference>
Extrapolated<Value> extrapolate(const Difference& difference, Real first_step, int levels) {
  std::vector<std::vector<Value>> table;
  Extrapolated<Value> best;
  const auto size = [](const Value& v) {
    if constexpr (std::is_same_v<Value, Real>) {
      return static_cast<double>(std::abs(v));
    } else {
      return static_cast<double>(v.norm());
    }
  };
  Real step = first_step;
  for (int level = 0; level < levels; ++level, step /= 4) {
    table.emplace_back();
    table[level].push_back(difference(step));
    Real factor = 16;
    for (int order = 1; order <= level; ++order, factor *= 16) {
      const Value coarse = table[level - 1][order - 1];
      const Value fine = table[level][order - 1];  // the table grows
      table[level].push_back(Value((factor * fine - coarse) / (factor - 1)));
      const double error = std::max(size(Value(table[level][order] - fine)), size(Value(table[level][order] - coarse)));
      if (error < best.error) best = {table[level][order], error};
    }
  }
  return best;
}

Values values_of(const LongAnswer& answer, const LongPose& pose1, bool& is_exact) {
  is_exact = is_exact && answer.is_exact;
  Values v;
  v << answer.gap, answer.normal, answer.point1 - pose1.position, answer.point2 - pose1.position;
  return v;
}

/// The comparison of one pair.
class Comparison {
 public:
  Comparison(const DerivativePair& pair, std::string name, Tally& tally)
      : pair_(pair), name_(std::move(name)), tally_(tally), pose1_(exact_pose(pair.pose1)), pose2_(exact_pose(pair.pose2)) {}

  void run() {
    ++tally_.pairs;
    const Shape &shape1 = *pair_.shape1, &shape2 = *pair_.shape2;
    const Proximity answer = find_proximity(shape1, pair_.pose1, shape2, pair_.pose2);
    found_ = find_proximity_derivatives(shape1, pair_.pose1, shape2, pair_.pose2, answer);
    ++tally_.statuses[found_.status];
    tally_.evaluations += found_.evaluations;
    const bool is_finite = found_.gap_gradient.allFinite() && found_.normal.allFinite() && found_.point1.allFinite() &&
                           found_.point2.allFinite() && found_.gap_hessian.allFinite();
    tally_.not_finite += !is_finite;
    if (!found_.has_normal) return;
    unit_ = std::min(shape1.half_extents().norm(), shape2.half_extents().norm());
    compare_swapped();
    compare_moved();
    // Between a vertex and an edge the gap itself is the radius of curvature.
    const auto is_sharp = [](const Shape& shape) {
      return shape.traits().has_nonsmooth_points && shape.min_curvature_radius_estimate() == 0;
    };
    if (is_sharp(shape1) && is_sharp(shape2)) step_ = std::min(1.0, std::abs(answer.gap) / unit_);
    const LongNormal reference(*pair_.shape1, pose1_, *pair_.shape2, pose2_, found_.common_normal);
    bool is_exact = true;
    base_ = values_of(reference.solve(pose1_, pose2_), pose1_, is_exact);
    if (!is_exact || (base_.segment<3>(1).cast<double>() - found_.common_normal).norm() > 1e-6) {
      ++tally_.unreferenced;
      return;
    }
    compare_first(reference);
    compare_second(reference);
    compare_parameters(reference);
  }

 private:
  /// The derivatives in units of the bodies' size, each quantity divided by its norm in `scale`. Matrices have dynamic sizes here
  /// and in turned(), because each product of fixed sizes is compiled by itself; lazy products compile without Eigen's blocked
  /// ones.
  Eigen::MatrixXd relative(const ProximityDerivatives& d, const ProximityDerivatives& scale) const {
    Eigen::VectorXd units(12);
    for (int k = 0; k < 12; ++k) units[k] = static_cast<double>(this->scale(k));
    const auto rows_of = [&units](const ProximityDerivatives& from) {
      Eigen::MatrixXd rows(22, 12);
      rows << from.gap_gradient.transpose(), from.normal, from.point1, from.point2, from.gap_hessian;
      rows = (rows * units.asDiagonal()).eval();
      for (int k = 0; k < 12; ++k) rows.row(10 + k) *= units[k];
      return rows;
    };
    Eigen::MatrixXd rows = rows_of(d);
    const Eigen::MatrixXd sizes = rows_of(scale);
    int row = 0;
    for (const auto& [count, least] : {std::pair{1, unit_}, {3, 1.0}, {3, unit_}, {3, unit_}, {12, unit_}}) {
      rows.middleRows(row, count) /= sizes.middleRows(row, count).norm() + least;
      row += count;
    }
    return rows;
  }

  /// Derivatives for the twists that `turn` maps to those of `d`, with vectors turned by `rotation`.
  static ProximityDerivatives turned(const ProximityDerivatives& d, const Eigen::MatrixXd& turn, const Eigen::MatrixXd& rotation) {
    const auto product = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) -> Eigen::MatrixXd { return a.lazyProduct(b); };
    const auto rows = [&](const Eigen::MatrixXd& of) { return product(product(rotation, of), turn); };
    const Eigen::MatrixXd back_turn = turn.transpose();
    ProximityDerivatives back = d;
    back.gap_gradient = product(back_turn, d.gap_gradient);
    back.normal = rows(d.normal);
    back.point1 = rows(d.point1);
    back.point2 = rows(d.point2);
    back.gap_hessian = product(product(back_turn, d.gap_hessian), turn);
    return back;
  }

  void compare_with(Quantity what, const ProximityDerivatives& other) {
    const double off = (relative(found_, found_) - relative(other, found_)).rowwise().norm().maxCoeff();
    count(what, off, other.has_normal ? 0 : std::numeric_limits<double>::infinity());
  }

  static Proximity answer_at(const Vector3& normal) { return {.normal = normal, .status = Status::Converged}; }

  void compare_swapped() {
    const ProximityDerivatives swapped =
        find_proximity_derivatives(*pair_.shape2, pair_.pose2, *pair_.shape1, pair_.pose1, answer_at(-found_.common_normal));
    Eigen::MatrixXd swap = Eigen::MatrixXd::Zero(12, 12);
    swap.topRightCorner(6, 6).setIdentity();
    swap.bottomLeftCorner(6, 6).setIdentity();
    ProximityDerivatives back = turned(swapped, swap, Matrix3::Identity());
    back.normal = -back.normal;
    std::swap(back.point1, back.point2);
    compare_with(OfSwapped, back);
  }

  /// Body 1 comes to the origin of another frame. So the rounding of positions hardly moves the bodies.
  void compare_moved() {
    const Matrix3 R = Eigen::Quaterniond(-0.3, 0.8, 0.2, 0.4).normalized().toRotationMatrix();
    const Pose moved1{Vector3::Zero(), R * pair_.pose1.rotation},
        moved2{R * (pair_.pose2.position - pair_.pose1.position), R * pair_.pose2.rotation};
    const ProximityDerivatives moved =
        find_proximity_derivatives(*pair_.shape1, moved1, *pair_.shape2, moved2, answer_at(R * found_.common_normal));
    Eigen::MatrixXd turn = Eigen::MatrixXd::Zero(12, 12);
    for (int i = 0; i < 12; i += 3) turn.block(i, i, 3, 3) = R;
    const ProximityDerivatives back = turned(moved, turn, R.transpose());
    compare_with(OfMoved, back);
  }

  LongAnswer moved(const LongNormal& reference, const Eigen::Matrix<Real, 12, 1>& twist) const {
    return reference.solve(pose1_.moved(twist.segment<3>(0), twist.segment<3>(3)),
                           pose2_.moved(twist.segment<3>(6), twist.segment<3>(9)));
  }

  /// 1 rad, or the unit of length.
  Real scale(int k) const { return k % 6 < 3 ? static_cast<Real>(unit_) : 1; }

  void compare_first(const LongNormal& reference) {
    Eigen::Matrix<double, 10, 12> claimed;
    claimed << found_.gap_gradient.transpose(), found_.normal, found_.point1, found_.point2;
    Eigen::Matrix<double, 10, 12> numeric;
    Eigen::Matrix<double, 1, 12> errors;
    bool is_exact = true;
    for (int k = 0; k < 12; ++k) {
      const auto difference = [&](Real step) -> Values {
        Eigen::Matrix<Real, 12, 1> twist = Eigen::Matrix<Real, 12, 1>::Zero();
        twist[k] = step * scale(k);
        const Values ahead = values_of(moved(reference, twist), pose1_, is_exact);
        const Values behind = values_of(moved(reference, -twist), pose1_, is_exact);
        return (ahead - behind) / (2 * step);
      };
      const auto derivative = extrapolate<Values>(difference, 1e-3L * step_, 6);
      numeric.col(k) = derivative.value.cast<double>();
      errors[k] = derivative.error;
      claimed.col(k) *= static_cast<double>(scale(k));
    }
    if (!is_exact) {
      ++tally_.unreferenced;
      return;
    }
    const auto check = [&](Quantity what, int row, int rows, double least) {
      const double size = claimed.middleRows(row, rows).norm() + least;
      count(what, (claimed - numeric).middleRows(row, rows).norm() / size, errors.norm() / size);
    };
    check(OfGap, 0, 1, unit_);
    check(OfNormal, 1, 3, 1);
    check(OfPoint1, 4, 3, unit_);
    check(OfPoint2, 7, 3, unit_);
  }

  void compare_second(const LongNormal& reference) {
    Draw draw(7);
    for (int k = 0; k < 3; ++k) {
      TwistVector direction;
      for (int i = 0; i < 12; ++i) direction[i] = draw.gauss() * static_cast<double>(scale(i));
      direction /= std::sqrt(12);
      bool is_exact = true;
      const auto difference = [&](Real step) -> Real {
        const Eigen::Matrix<Real, 12, 1> twist = step * direction.cast<Real>();
        const Real ahead = values_of(moved(reference, twist), pose1_, is_exact)[0];
        const Real behind = values_of(moved(reference, -twist), pose1_, is_exact)[0];
        return (ahead - 2 * base_[0] + behind) / (step * step);
      };
      constexpr Real kFirst = 2e-3L;
      const auto derivative = extrapolate<Real>(difference, kFirst * step_, 5);
      // Differences of steps that are too short may all be 0, and agree. This is the rounding of the longest.
      const Real longest = kFirst * step_;
      const auto rounding = static_cast<double>(1e-18L * static_cast<Real>(unit_) / (longest * longest));
      if (!is_exact) return;
      Eigen::Matrix<double, 12, 12> H = found_.gap_hessian;
      for (int i = 0; i < 12; ++i) {
        H.row(i) *= static_cast<double>(scale(i));
        H.col(i) *= static_cast<double>(scale(i));
      }
      const double size = H.norm() + unit_;
      count(OfHessian,
            std::abs(direction.dot(found_.gap_hessian.lazyProduct(direction)) - static_cast<double>(derivative.value)) / size,
            (derivative.error + rounding) / size);
    }
  }

  void compare_parameters(const LongNormal& reference) {
    for (const bool is_first : {true, false}) {
      const ParameterGradient& claimed = is_first ? found_.parameters1 : found_.parameters2;
      const LongBody &exact1 = reference.body1(), &exact2 = reference.body2();
      const LongBody& body = is_first ? exact1 : exact2;
      // An ellipsoid has no exponents.
      for (std::size_t k = 0; k < std::min(claimed.size(), body.parameter_count()); ++k) {
        bool is_exact = true;
        const std::string parameter = claimed[k].name;
        const bool is_length = parameter.size() == 1 || parameter == "radius" || parameter == "half_length";
        const Real first_step = (is_length ? 1e-3L * static_cast<Real>(unit_) : 1e-3L);
        const auto difference = [&](Real step) -> Real {
          const auto ahead = body.with_change(k, step), behind = body.with_change(k, -step);
          const LongAnswer up =
              is_first ? reference.solve(pose1_, pose2_, *ahead, exact2) : reference.solve(pose1_, pose2_, exact1, *ahead);
          const LongAnswer down =
              is_first ? reference.solve(pose1_, pose2_, *behind, exact2) : reference.solve(pose1_, pose2_, exact1, *behind);
          is_exact = is_exact && up.is_exact && down.is_exact;
          return (up.gap - down.gap) / (2 * step);
        };
        const auto derivative = extrapolate<Real>(difference, first_step * step_, 6);
        const double size = std::abs(claimed[k].value) + (is_length ? 1 : 0.1 * unit_);
        if (is_exact) {
          count(OfParameters, std::abs(claimed[k].value - static_cast<double>(derivative.value)) / size, derivative.error / size);
        }
      }
    }
  }

  void count(Quantity what, double difference, double error) {
    Tally::Figures& figures = tally_.figures[what];
    if (!(error <= kResolution * kLargestErrors[what])) {
      ++figures.undecided;
      return;
    }
    ++figures.compared;
    figures.worst = std::max(figures.worst, difference);
    if (difference <= kLargestErrors[what]) return;
    ++figures.wrong;
    if (tally_.first_wrong.size() > 3000) return;
    std::ostringstream text;
    text << name_ << ' ' << pair_.kind << ": " << kQuantityNames[what] << " off by " << difference << " (reference " << error
         << "), status " << static_cast<int>(found_.status) << '\n';
    tally_.first_wrong += text.str();
  }

  const DerivativePair& pair_;
  const std::string name_;
  Tally& tally_;
  const LongPose pose1_, pose2_;
  ProximityDerivatives found_;
  Values base_;
  double unit_ = 1;
  Real step_ = 1;  // of the differences, relative to the usual
};

}  // namespace

// A distribution for each, so that a seed gives the pairs of lib/proximity/README.md.
Vector3 DerivativePairs::direction() {
  std::normal_distribution<double> gauss;
  return Vector3{gauss(engine()), gauss(engine()), gauss(engine())}.normalized();
}

Vector3 DerivativePairs::lengths(double low, double high) { return scale_ * log_within(low, high); }

std::shared_ptr<const Shape> DerivativePairs::smooth(int kind) {
  const auto superellipsoid = [this](double low, double high, double least, double most) {
    const Vector3 a = lengths(low, high);
    const double delta = log_uniform(least, most);
    return std::make_shared<Superellipsoid>(a, delta, log_uniform(least, most));
  };
  if (kind < 7) {
    const SuperellipsoidClass& one = kSuperellipsoidClasses[kind];
    if (kind < 2) return std::make_shared<Ellipsoid>(lengths(one.least_axis, one.largest_axis));
    return superellipsoid(one.least_axis, one.largest_axis, one.least_exponent, one.largest_exponent);
  }
  switch (kind) {
    case 7: {
      const Vector3 a = lengths(0.5, 1.5);
      const double delta = log_uniform(1.3, 5), epsilon = log_uniform(1.3, 5);
      const double taper = uniform(-0.9, 0.9) * Superovoid::max_taper(epsilon);
      return std::make_shared<Superovoid>(a, delta, epsilon, taper, taper);
    }
    case 8:
      return std::make_shared<Rounded>(superellipsoid(0.5, 1.5, 1.05, 20), scale_ * log_uniform(0.01, 0.5));
    case 9: {
      const auto first = superellipsoid(0.5, 1.5, 1.3, 8);
      return std::make_shared<MinkowskiSum>(first, std::make_shared<Ellipsoid>(lengths(0.2, 1)));
    }
    default: {
      Matrix3 matrix = Eigen::AngleAxisd(uniform(0, 3), direction()).toRotationMatrix();
      for (int i = 0; i < 9; ++i) matrix(i) += 0.3 * uniform(-1, 1);
      return std::make_shared<LinearImage>(superellipsoid(0.5, 1.5, 1.3, 8), matrix);
    }
  }
}

std::shared_ptr<const Shape> DerivativePairs::any(int kind) {
  if (kind <= kSmoothKinds) return smooth(kind);
  const Vector3 a = lengths(0.5, 1.5);
  switch (kind) {
    case 11:
      return std::make_shared<Box>(a);
    case 12:
      return std::make_shared<Capsule>(a.x(), a.z());
    case 13:
      return std::make_shared<Cylinder>(a.x(), a.z());
    case 14: {
      auto points = std::make_shared<std::vector<Vector3>>();
      const int count = whole(3, 12);
      for (int k = 0; k < count; ++k) points->push_back(a.cwiseProduct(direction()));
      // It refers to its points.
      return std::shared_ptr<const Shape>(new Polytope(*points), [points](const Shape* it) { delete it; });
    }
    default:
      return std::make_shared<Rounded>(std::make_shared<Box>(a), scale_ * log_uniform(0.01, 0.5));
  }
}

/// In the body's frame, unit.
Vector3 DerivativePairs::normal_of_face_or_edge(int kind, const Shape& shape) {
  const double angle = uniform(0, 6.28);
  const bool is_face = uniform(0, 1) < 0.5;
  switch (kind) {
    case 12:
      return {std::cos(angle), std::sin(angle), 0};
    case 13:
      return is_face ? Vector3(0, 0, 1) : Vector3(std::cos(angle), std::sin(angle), 0);
    case 14: {
      const auto points = dynamic_cast<const Polytope&>(shape).points();
      const auto any = [&] { return points[static_cast<std::size_t>(whole(0, static_cast<int>(points.size()) - 1))]; };
      for (int k = 0; k < 100; ++k) {
        const Vector3 a = any(), b = any(), c = any(), n = (b - a).cross(c - a);
        if (n.norm() < 1e-3) continue;
        const Vector3 unit = n.normalized();
        if (shape.support(unit) - unit.dot(a) < 1e-12) return unit;
      }
      return direction();
    }
    default: {
      const int axis = whole(0, 2);
      if (is_face) return Vector3::Unit(axis);
      Vector3 n = direction();
      n[axis] = 0;
      return n.normalized();
    }
  }
}

/// A random boundary point with this normal.
Vector3 DerivativePairs::witness(const Shape& shape, const Vector3& n) {
  const double h = shape.support(n);
  ActiveVertices vertices;
  shape.add_active_vertices(n, shape.point(n), vertices);
  Vector3 mean = Vector3::Zero();
  double weights = 0;
  for (int k = 0; k < vertices.size(); ++k) {
    if (h - n.dot(vertices[k]) > 1e-12) continue;
    const double weight = uniform(0.1, 1);
    mean += weight * vertices[k];
    weights += weight;
  }
  return weights > 0 ? Vector3(mean / weights) : shape.point(n);
}

DerivativePair DerivativePairs::draw_flat() {
  scale_ = log_uniform(2e-3, 7);
  const int kind1 = count_ % kKinds, kind2 = whole(0, kKinds - 1);
  DerivativePair pair{std::string(kKindNames[kind1]) + " and " + kKindNames[kind2], any(kind1), {}, {}, {}};
  const bool is_small = uniform(0, 1) < 0.5;  // a body anywhere on the side of a larger one
  if (is_small) scale_ *= log_uniform(1e-3, 1);
  pair.shape2 = any(kind2);
  const Vector3 n1 = normal_of_face_or_edge(kind1, *pair.shape1), n2 = normal_of_face_or_edge(kind2, *pair.shape2);
  pair.pose1.rotation = Eigen::AngleAxisd(uniform(0, 3.14), direction()).toRotationMatrix();
  const Vector3 n = pair.pose1.rotation * n1;
  const double tilt = uniform(0, 1) < 0.2 ? 0 : log_uniform(1e-14, 1e-3);
  const Matrix3 facing = test::rotation_between(n2, -n).toRotationMatrix(),
                about = Eigen::AngleAxisd(uniform(0, 6.28), n).toRotationMatrix(),
                tilted = Eigen::AngleAxisd(tilt, n.cross(direction()).normalized()).toRotationMatrix();
  pair.pose2.rotation = tilted * about * facing;
  const double smallest = std::min(pair.shape1->half_extents().minCoeff(), pair.shape2->half_extents().minCoeff());
  const int place = count_ / kKinds % 3;
  const double gap = smallest * (place == 0 ? uniform(0, 1) : place == 1 ? 0 : -uniform(0, 0.2));
  const Vector3 point1 = pair.pose1.rotation * witness(*pair.shape1, n1);
  const Vector3 point2 = pair.pose2.rotation * witness(*pair.shape2, -(pair.pose2.rotation.transpose() * n));
  const Vector3 aside =
      is_small ? Vector3(uniform(0, 0.4) * pair.shape1->half_extents().minCoeff() * n.cross(direction())) : Vector3(0, 0, 0);
  pair.pose2.position = point1 + gap * n - point2 + aside;
  ++count_;
  scale_ = 1;
  return pair;
}

DerivativePair DerivativePairs::draw() {
  const int kind1 = count_ % kKinds;
  // Half of the partners are of the same kind, the others of any.
  const int kind2 = (count_ / kKinds) % 2 == 0 ? kind1 : whole(0, kKinds - 1);
  DerivativePair pair{std::string(kKindNames[kind1]), any(kind1), any(kind2), {}, {}};
  const auto rotation = [this] { return Eigen::AngleAxisd(uniform(0, 3.14), direction()).toRotationMatrix(); };
  pair.pose1.rotation = rotation();
  pair.pose2.rotation = rotation();
  pair.pose1.position = lengths(0.1, 10);
  // Half of the bodies with faces are placed at the normal of a face or of an edge.
  Vector3 n = direction();
  if (kind1 > kSmoothKinds && uniform(0, 1) < 0.5) {
    n = pair.pose1.rotation * normal_of_face_or_edge(kind1, *pair.shape1);
  } else if (kind2 > kSmoothKinds && uniform(0, 1) < 0.5) {
    n = -(pair.pose2.rotation * normal_of_face_or_edge(kind2, *pair.shape2));
  } else if (kind1 > kSmoothKinds && kind2 > kSmoothKinds) {
    n = pair.pose1.rotation.col(2).cross(pair.pose2.rotation.col(2)).normalized();  // edges along z
  }
  const Vector3 half1 = pair.shape1->half_extents(), half2 = pair.shape2->half_extents();
  const double largest = std::min(half1.maxCoeff(), half2.maxCoeff()), smallest = std::min(half1.minCoeff(), half2.minCoeff());
  const int place = (count_ / (2 * kKinds)) % 4;
  const double gap = place == 0   ? largest * uniform(0, 2)
                     : place == 1 ? 1e-6 * largest * uniform(0, 1)
                                  : -smallest * uniform(0, 0.3);
  const Vector3 point1 = pair.pose1.rotation * witness(*pair.shape1, pair.pose1.rotation.transpose() * n);
  const Vector3 point2 = pair.pose2.rotation * witness(*pair.shape2, -(pair.pose2.rotation.transpose() * n));
  pair.pose2.position = pair.pose1.position + point1 + gap * n - point2;
  ++count_;
  return pair;
}

void compare(const DerivativePair& pair, const std::string& name, Tally& tally) { Comparison(pair, name, tally).run(); }

void compare_flat(const DerivativePair& pair, const std::string& name, FlatTally& tally) {
  constexpr double kStep = 1e-6;  // rad; a gradient holds within it, by DerivativeStatus
  constexpr double kWrong = 1e-2, kSame = 1e-4;
  const Shape &shape1 = *pair.shape1, &shape2 = *pair.shape2;
  const Settings settings{.tolerance = 1e-14};
  ++tally.pairs;
  const Proximity answer = find_proximity(shape1, pair.pose1, shape2, pair.pose2, settings);
  const ProximityDerivatives found = find_proximity_derivatives(shape1, pair.pose1, shape2, pair.pose2, answer);
  tally.evaluations += found.evaluations;
  if (found.status != DerivativeStatus::FreeOnFace && !found.has_gap) {
    ++tally.unanswered;
    return;
  }
  ++(found.has_gap ? tally.defined : tally.refused);
  tally.second += found.has_normal;
  const double size = std::min(shape1.half_extents().norm(), shape2.half_extents().norm());
  const Vector3 t1 = answer.normal.unitOrthogonal(), t2 = answer.normal.cross(t1);
  double off = 0, kink = 0;
  for (const double angle : {0.0, 0.8, 1.6, 2.4}) {
    const Vector3 axis = std::cos(angle) * t1 + std::sin(angle) * t2;
    const auto gap_at = [&](double step) {
      Vector3 normal = pair.pose1.rotation.transpose() * answer.normal;  // keeps to the answer's maximum
      const Pose turned{pair.pose2.position, Eigen::AngleAxisd(step, axis) * pair.pose2.rotation};
      return find_proximity(shape1, pair.pose1, shape2, turned, settings, &normal).gap;
    };
    const double ahead = (gap_at(kStep) - answer.gap) / kStep, behind = (answer.gap - gap_at(-kStep)) / kStep;
    const double claimed = found.gap_gradient.segment<3>(9).dot(axis);
    const double bend = 0.5 * kStep * axis.dot(found.gap_hessian.block<3, 3>(9, 9) * axis);  // 0 where there is no Hessian
    off = std::max({off, std::abs(claimed + bend - ahead), std::abs(claimed - bend - behind)});
    kink = std::max(kink, std::abs(ahead - behind));
  }
  if (found.has_gap && off > kWrong * size) {
    ++tally.wrong;
    std::ostringstream text;
    text << name << ' ' << pair.kind << ": off by " << off / size << " sizes, kink " << kink / size << ", status "
         << static_cast<int>(found.status) << '\n';
    tally.wrong_pairs += text.str();
  }
  if (!found.has_gap && kink < kSame * size) ++tally.needless;
}

}  // namespace supernormal::test
