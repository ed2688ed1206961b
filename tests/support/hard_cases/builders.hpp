// Functions that build cases.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "support/hard_cases/catalogue.hpp"

namespace supernormal::samples {

/// A case with body 1 at the origin, unrotated.
HardCase pair(std::string name, std::string reason, const Body& body1, const Body& body2, const Pose& pose2,
              std::optional<double> gap = {});

/// A case in which body 2 has the orientation `rotation2`. Its tangent plane of normal -n is `gap` m above body 1's of normal n,
/// and the two boundary points lie above one another. So n is a common normal. If the bodies are apart or touch, it is the only one
/// and the gap is known.
HardCase on_normal(std::string name, std::string reason, const Body& body1, const Vector3& n, const Body& body2,
                   const Matrix3& rotation2, double gap);

/// A pose at `position`, unrotated.
inline Pose at(const Vector3& position) { return {position, Matrix3::Identity()}; }
inline Pose at(const Vector3& position, const Matrix3& rotation) { return {position, rotation}; }

/// The orientation after a rotation about an axis (of any length) by an angle in radians.
inline Matrix3 turned(const Vector3& axis, double angle) { return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix(); }

/// An orientation far from any symmetry.
inline Matrix3 askew() { return Eigen::Quaterniond(0.3, -0.7, 0.2, 0.6).normalized().toRotationMatrix(); }

inline constexpr double kQuarterTurn = 1.5707963267948966;
inline constexpr double kEighthTurn = 0.7853981633974483;

// Half-axes of bodies, m. The second body's are sums of powers of two, so that places far away are exact.
inline const Vector3 kLengths(1, 0.8, 0.5);
inline const Vector3 kDyadicLengths(1, 0.75, 0.5);

std::vector<HardCase> concentric_cases();
std::vector<HardCase> face_cases();
std::vector<HardCase> edge_and_vertex_cases();
std::vector<HardCase> exponent_cases();
std::vector<HardCase> aspect_ratio_cases();
std::vector<HardCase> size_cases();
std::vector<HardCase> containment_cases();
std::vector<HardCase> touching_cases();
std::vector<HardCase> place_cases();
std::vector<HardCase> collider_cases();
std::vector<HardCase> other_shape_cases();

}  // namespace supernormal::samples
