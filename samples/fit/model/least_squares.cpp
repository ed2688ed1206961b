#include "least_squares.hpp"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <supernormal/shapes/superellipsoid.hpp>
#include <utility>

#include "distance.hpp"

namespace fit {
namespace {

// The unknowns of Ceres for exponents and taper: ln(delta - 1), ln(epsilon - 1), and artanh(taper / limit). Every value gives a
// convex body.
const double kLeastLogExponent = std::log(supernormal::Superellipsoid::kMinExponent - 1);
constexpr double kLargestArtanh = 5;
constexpr double kLeastHalfAxis = 1e-4;

constexpr int kPositionBlock = 0, kOrientationBlock = 1, kAxesBlock = 2, kExponentsBlock = 3, kTaperBlock = 4, kBlocks = 5;
constexpr std::array kBlockSizes = {3, 4, 3, 2, 1};

/// The parameter blocks of one body.
struct Unknowns {
  std::array<double, 3> position;
  std::array<double, 4> orientation;  // x, y, z, w
  std::array<double, 3> log_axes;
  std::array<double, 2> log_exponents;
  std::array<double, 1> artanh_taper;

  Unknowns(const Body& body, const ShapeLimits& limits) {
    for (int i = 0; i < 3; ++i) {
      position[static_cast<std::size_t>(i)] = body.position[i];
      log_axes[static_cast<std::size_t>(i)] = std::log(std::max(body.half_axes[i], kLeastHalfAxis));
    }
    Eigen::Map<Eigen::Vector4d>(orientation.data()) = body.orientation.coeffs();
    if (limits.has_round_section) log_axes[0] = log_axes[1] = (log_axes[0] + log_axes[1]) / 2;
    const auto log_of = [&](double exponent) {
      return std::clamp(std::log(exponent - 1), kLeastLogExponent, std::log(limits.max_exponent - 1));
    };
    log_exponents = {log_of(limits.has_round_section ? 2 : limits.delta.value_or(body.delta)),
                     log_of(limits.epsilon.value_or(body.epsilon))};
    artanh_taper = {std::clamp(std::atanh(body.taper / taper_limit(body.epsilon)), -kLargestArtanh, kLargestArtanh)};
  }

  std::array<double*, kBlocks> blocks() {
    return {position.data(), orientation.data(), log_axes.data(), log_exponents.data(), artanh_taper.data()};
  }
};

Body body_of(Family family, const ShapeLimits& limits, const double* const* blocks) {
  Body body;
  body.family = family;
  body.position = Eigen::Map<const Vector3>(blocks[kPositionBlock]);
  body.orientation = Eigen::Map<const Eigen::Quaterniond>(blocks[kOrientationBlock]).normalized();
  body.half_axes = Eigen::Map<const Vector3>(blocks[kAxesBlock]).array().exp();
  if (limits.has_round_section) body.half_axes.y() = body.half_axes.x();
  if (family == Family::Ellipsoid) return body;
  const auto exponent = [&](int i) {
    return std::clamp(1 + std::exp(blocks[kExponentsBlock][i]), supernormal::Superellipsoid::kMinExponent, limits.max_exponent);
  };
  body.delta = exponent(0);
  body.epsilon = exponent(1);
  if (family == Family::Superovoid) body.taper = taper_limit(body.epsilon) * std::tanh(blocks[kTaperBlock][0]);
  return body;
}

/// Row i of the Jacobian in the unknowns of Ceres, from the gradient in ours.
void write_row(std::size_t i, const Body& body, const ShapeLimits& limits, const Gradient& gradient, const double* const* blocks,
               double** jacobians) {
  const auto row = [&](int block) {
    return jacobians[block] + i * static_cast<std::size_t>(kBlockSizes[static_cast<std::size_t>(block)]);
  };
  if (jacobians[kPositionBlock] != nullptr) Eigen::Map<Vector3>(row(kPositionBlock)) = gradient.segment<3>(kPosition);
  if (jacobians[kOrientationBlock] != nullptr) {
    // ceres::EigenQuaternionManifold rotates by twice its step, about the axes of the data. The columns of its derivative are
    // orthonormal, so their transpose maps the row back to the coefficients of the quaternion.
    const Vector3 step = 2 * (body.rotation() * gradient.segment<3>(kRotation));
    const Eigen::Map<const Eigen::Quaterniond> q(blocks[kOrientationBlock]);
    Eigen::Map<Eigen::Vector4d> out(row(kOrientationBlock));
    out.head<3>() = q.w() * step - q.vec().cross(step);
    out[3] = -q.vec().dot(step);
  }
  if (jacobians[kAxesBlock] != nullptr) {
    Eigen::Map<Vector3> out(row(kAxesBlock));
    out = gradient.segment<3>(kLogAxes);
    if (limits.has_round_section) out = Vector3(out.x() + out.y(), 0, out.z());
  }
  const double artanh = blocks[kTaperBlock][0];
  if (jacobians[kExponentsBlock] != nullptr) {
    double* const out = row(kExponentsBlock);
    out[0] = gradient[kLogDelta];
    // The limit of the taper depends on epsilon.
    out[1] = gradient[kLogEpsilon] + gradient[kTaper] * taper_limit_slope(body.epsilon) * std::tanh(artanh);
    const std::array<bool, kParameters> is_fixed = fixed_parameters(limits);
    for (std::size_t k = 0; k < 2; ++k) {
      if (is_fixed[kLogDelta + k]) out[k] = 0;
    }
  }
  if (jacobians[kTaperBlock] != nullptr) {
    const double cosh = std::cosh(artanh);
    *row(kTaperBlock) = gradient[kTaper] * taper_limit(body.epsilon) / (cosh * cosh);
  }
}

/// The residuals of some points.
class Distances final : public ceres::CostFunction {
 public:
  Distances(Family family, std::span<const Vector3> points, std::span<const double> offsets, const LeastSquaresSettings& settings)
      : family_(family),
        points_(points),
        offsets_(offsets),
        loss_width_(settings.loss_width),
        limits_(settings.limits),
        tolerance_(settings.distance_tolerance) {
    set_num_residuals(static_cast<int>(points.size()));
    mutable_parameter_block_sizes()->assign(kBlockSizes.begin(), kBlockSizes.end());
  }

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    const DistanceFunction function(body_of(family_, limits_, blocks), tolerance_);
    if (!update_witnesses(function, blocks)) return false;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double excess = witnesses_[i].distance - (offsets_.empty() ? 0 : offsets_[i]);
      double slope = 1;
      residuals[i] = with_loss(excess, slope);
      if (jacobians != nullptr) write_row(i, function.body(), limits_, slope * function.gradient(witnesses_[i]), blocks, jacobians);
    }
    return true;
  }

 private:
  /// Finds the witnesses unless they are cached from the last call. Ceres first requests the distances of a step and, if it takes
  /// the step, the derivatives at the same place. Only one thread at a time evaluates a residual block.
  bool update_witnesses(const DistanceFunction& function, const double* const* blocks) const {
    std::vector<double> place;
    for (std::size_t k = 0; k < kBlockSizes.size(); ++k) place.insert(place.end(), blocks[k], blocks[k] + kBlockSizes[k]);
    if (place == place_) return true;
    place_.clear();
    witnesses_.clear();
    for (const Vector3& point : points_) {
      const std::optional<Witness> witness = function.find(point);
      if (!witness) return false;
      witnesses_.push_back(*witness);
    }
    place_ = std::move(place);
    return true;
  }

  /// Huber: a distance d beyond the width w becomes sqrt(2 w d - w^2).
  double with_loss(double excess, double& slope) const {
    const double size = std::abs(excess);
    const double width = loss_width_;
    if (!(size > width)) return excess;
    const double root = std::sqrt(width * (2 * size - width));
    slope = width / root;
    return std::copysign(root, excess);
  }

  Family family_;
  std::span<const Vector3> points_;
  std::span<const double> offsets_;
  double loss_width_;
  ShapeLimits limits_;
  double tolerance_;
  mutable std::vector<double> place_;       // the unknowns of the cached witnesses
  mutable std::vector<Witness> witnesses_;  // one for each point
};

/// How far the body extends into the empty space: penalty_of() as a sum of squares, `count` times.
class Reach final : public ceres::CostFunction {
 public:
  Reach(Family family, const ShapeLimits& limits, const EmptySpace& space, double count)
      : family_(family),
        limits_(limits),
        space_(space),
        directions_(boundary_directions(space.is_fine)),
        weight_(std::sqrt(space.weight * count / static_cast<double>(directions_.size()))) {
    set_num_residuals(static_cast<int>(directions_.size()));
    mutable_parameter_block_sizes()->assign(kBlockSizes.begin(), kBlockSizes.end());
  }

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    const Body body = body_of(family_, limits_, blocks);
    const Matrix3 R = body.rotation();
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      PointDerivatives derivatives;
      const Vector3 r = boundary_point(body, directions_[i], jacobians == nullptr ? nullptr : &derivatives);
      const EmptySpace::Excess excess = space_.beyond(body.position + R * r);
      residuals[i] = weight_ * excess.length;
      if (jacobians == nullptr) continue;
      const Vector3 slope = R.transpose() * excess.slope;
      Gradient gradient = derivatives.transpose() * slope;
      gradient.segment<3>(kPosition) = excess.slope;
      gradient.segment<3>(kRotation) = r.cross(slope);
      write_row(i, body, limits_, weight_ * gradient, blocks, jacobians);
    }
    return true;
  }

 private:
  Family family_;
  ShapeLimits limits_;
  EmptySpace space_;
  const std::vector<Vector3>& directions_;
  double weight_;
};

/// The difference of the volume from its target, as a mean distance of the surfaces.
class VolumeDifference final : public ceres::CostFunction {
 public:
  VolumeDifference(Family family, const ShapeLimits& limits, const VolumeTarget& target, double weight)
      : family_(family), limits_(limits), target_(target), weight_(weight) {
    set_num_residuals(1);
    mutable_parameter_block_sizes()->assign(kBlockSizes.begin(), kBlockSizes.end());
  }

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    const double scale = weight_ / target_.area;
    const double volume = volume_of(body_of(family_, limits_, blocks));
    residuals[0] = scale * (volume - target_.volume);
    if (jacobians == nullptr) return true;
    for (const int block : {kPositionBlock, kOrientationBlock, kAxesBlock}) {
      const double slope = block == kAxesBlock ? scale * volume : 0;
      if (jacobians[block] != nullptr) std::fill_n(jacobians[block], kBlockSizes[static_cast<std::size_t>(block)], slope);
    }
    if (jacobians[kAxesBlock] != nullptr && limits_.has_round_section) {
      jacobians[kAxesBlock][0] *= 2;
      jacobians[kAxesBlock][1] = 0;
    }
    for (const int block : {kExponentsBlock, kTaperBlock}) {
      if (jacobians[block] == nullptr) continue;
      for (int i = 0; i < kBlockSizes[static_cast<std::size_t>(block)]; ++i) {
        const auto parameter = static_cast<std::size_t>(kLogDelta) + static_cast<std::size_t>(i);
        const bool is_fixed = block == kExponentsBlock && fixed_parameters(limits_)[parameter];
        jacobians[block][i] = is_fixed ? 0 : scale * slope_of(blocks, block, i);
      }
    }
    return true;
  }

 private:
  static double volume_of(const Body& body) { return make_shape(body)->mass_properties().volume; }

  /// The derivative of the volume by one unknown, from a central difference.
  double slope_of(const double* const* blocks, int block, int i) const {
    constexpr double kStep = 1e-4;
    std::array<const double*, kBlocks> varied{};
    std::copy_n(blocks, kBlocks, varied.begin());
    std::array<double, 4> values{};
    std::copy_n(blocks[block], kBlockSizes[static_cast<std::size_t>(block)], values.begin());
    varied[static_cast<std::size_t>(block)] = values.data();
    values[static_cast<std::size_t>(i)] += kStep;
    const double above = volume_of(body_of(family_, limits_, varied.data()));
    values[static_cast<std::size_t>(i)] -= 2 * kStep;
    return (above - volume_of(body_of(family_, limits_, varied.data()))) / (2 * kStep);
  }

  Family family_;
  ShapeLimits limits_;
  VolumeTarget target_;
  double weight_;
};

void set_bounds(ceres::Problem& problem, Unknowns& unknowns, const LeastSquaresSettings& settings) {
  for (int i = 0; i < 3; ++i) {
    problem.SetParameterLowerBound(unknowns.log_axes.data(), i, std::log(kLeastHalfAxis));
    if (std::isfinite(settings.largest_half_axis)) {
      double& log_axis = unknowns.log_axes[static_cast<std::size_t>(i)];
      log_axis = std::min(log_axis, std::log(settings.largest_half_axis));
      problem.SetParameterUpperBound(unknowns.log_axes.data(), i, std::log(settings.largest_half_axis));
    }
  }
  for (int i = 0; i < 2; ++i) {
    problem.SetParameterLowerBound(unknowns.log_exponents.data(), i, kLeastLogExponent);
    problem.SetParameterUpperBound(unknowns.log_exponents.data(), i, std::log(settings.limits.max_exponent - 1));
  }
  problem.SetParameterLowerBound(unknowns.artanh_taper.data(), 0, -kLargestArtanh);
  problem.SetParameterUpperBound(unknowns.artanh_taper.data(), 0, kLargestArtanh);
}

ceres::Solver::Options options_of(const LeastSquaresSettings& settings) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = settings.max_iterations;
  options.function_tolerance = settings.tolerance;
  options.gradient_tolerance = 1e-16;
  options.parameter_tolerance = 1e-13;
  options.num_threads = settings.threads;
  options.logging_type = ceres::SILENT;
  // Steps are projected onto the bounds. A line search along the projected step would cost another evaluation per step.
  options.max_num_line_search_step_size_iterations = 0;
  return options;
}

}  // namespace

LeastSquaresResult minimize_distances(const Body& start, std::span<const Vector3> points, std::span<const double> offsets,
                                      const LeastSquaresSettings& settings) {
  constexpr std::size_t kChunk = 256;  // points of a residual block, which one thread evaluates with one shape
  Unknowns unknowns(start, settings.limits);
  ceres::Problem problem;
  const auto blocks = unknowns.blocks();
  for (int i = 0; i < kBlocks; ++i)
    problem.AddParameterBlock(blocks[static_cast<std::size_t>(i)], kBlockSizes[static_cast<std::size_t>(i)]);
  problem.SetManifold(unknowns.orientation.data(), new ceres::EigenQuaternionManifold);
  set_bounds(problem, unknowns, settings);
  if (start.family == Family::Ellipsoid) problem.SetParameterBlockConstant(unknowns.log_exponents.data());
  if (start.family != Family::Superovoid) problem.SetParameterBlockConstant(unknowns.artanh_taper.data());
  const std::vector<double*> all(blocks.begin(), blocks.end());
  for (std::size_t first = 0; first < points.size(); first += kChunk) {
    const std::size_t count = std::min(kChunk, points.size() - first);
    const std::span<const double> targets = offsets.empty() ? offsets : offsets.subspan(first, count);
    problem.AddResidualBlock(new Distances(start.family, points.subspan(first, count), targets, settings), nullptr, all);
  }
  const auto count = static_cast<double>(points.size());
  if (settings.empty.grid) problem.AddResidualBlock(new Reach(start.family, settings.limits, settings.empty, count), nullptr, all);
  if (settings.volume) {
    problem.AddResidualBlock(
        new VolumeDifference(start.family, settings.limits, *settings.volume, std::sqrt(kVolumeWeight * count)), nullptr, all);
  }
  // Ceres rejects a step that it cannot evaluate. The user needs no warning of this.
  FLAGS_minloglevel = google::GLOG_FATAL;
  ceres::Solver::Summary summary;
  ceres::Solve(options_of(settings), &problem, &summary);
  LeastSquaresResult result;
  result.body = body_of(start.family, settings.limits, blocks.data());
  if (summary.IsSolutionUsable()) result.cost = summary.final_cost;
  return result;
}

}  // namespace fit
