// Simbody behind a plain interface: its headers do not compile as C++20, our language.
#pragma once

#include <array>
#include <memory>

namespace accuracy_cost {

struct SimbodyPose {
  std::array<double, 9> rotation;  ///< row-major
  std::array<double, 3> position;  ///< m
};

struct SimbodyContact {
  bool is_apart = false;
  bool has_converged = false;
  double gap = 0;                   ///< m
  std::array<double, 3> normal{};   ///< unit, from body 1 to body 2, world frame
  std::array<double, 3> contact{};  ///< m, world frame
};

class SimbodyEllipsoid {
 public:
  explicit SimbodyEllipsoid(const std::array<double, 3>& half_axes);

  /// The method of its tracker for convex implicit surfaces: MPR for a start, then Newton's method for the two points.
  SimbodyContact meet(const SimbodyPose& pose, const SimbodyEllipsoid& other, const SimbodyPose& other_pose, double accuracy) const;

 private:
  struct Geometry;
  std::shared_ptr<const Geometry> geometry_;
};

}  // namespace accuracy_cost
