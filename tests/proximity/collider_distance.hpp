// Closed forms of the signed distance of a point from a collider, positive outside.
#pragma once

#include <span>

#include "collider_pairs.hpp"

namespace supernormal::test {

double distance_from_box(const Vector3& half_lengths, const Vector3& x);
double distance_from_capsule(double radius, double half_length, const Vector3& x);
double distance_from_cylinder(double radius, double half_length, const Vector3& x);

/// The distance of x from the hull of one, two or three points.
double distance_from_simplex(std::span<const Vector3> vertices, const Vector3& x);

/// The distance of the point x from the part of the collider's boundary that has the outward normal n; for a box, a capsule or a
/// cylinder, only if it is outside. The vertices of a hull that are within `tolerance` of its highest along n span that part; no
/// more than three are expected.
double distance_from_extreme_part(const Collider& collider, const Vector3& n, const Vector3& x, double tolerance);

}  // namespace supernormal::test
