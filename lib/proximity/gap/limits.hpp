// Limits that the scalar search and the lanes share, so that both decide alike. It includes nothing: the files of wide lanes may
// not (shapes/lanes/real.hpp).
#pragma once

namespace supernormal::limits {

// Rounding error of s in units of the last place of its terms. Each support function is accurate to a few units, and the sum adds a
// few. The rotation and the normal are rounded too, which moves body 2's boundary point in proportion to its distance from the
// origin.
inline constexpr double kRoundingUnits = 8;

// In rounding errors of s. A bound is the length of a vector, less s. The vector's three components have the rounding of s each, so
// the bound cannot fall below about three rounding errors.
inline constexpr double kFloor = 4;

// The first guess. Relative to the size of the bodies: nearer centres have no direction from one to the other. Relative to the cube
// of the trace: a smaller determinant counts as zero.
inline constexpr double kConcentric = 1e-12;
inline constexpr double kSingularGuess = 1e-150;

// A Hessian. Relative to its trace: a smaller pivot is only rounding error, or nearly. In units of the pair's length: the trace of
// two vertices, whose radii of curvature vanish. The inverse of a smaller trace might overflow.
inline constexpr double kSingularHessian = 1e-12;
inline constexpr double kNothing = 1e-30;

// In units of the pair's length: beyond this, a radius of curvature belongs to a flat face, and a step in the normal is only
// rounding error.
inline constexpr double kFlattest = 1e8;

// The inverse of this length: larger curvatures of both bodies together are those of a vertex, and their inverse is nothing.
inline constexpr double kLargestCurvature = 1e30;

// Of the tolerance: a meeting halfway that gains less is on faces so flat that rounding moves the points. The proof takes tilts.
inline constexpr double kLeastGain = 0.01;

// Two tilts find the other sides of the line where a triangle meets it. One more repairs what rounding leaves.
inline constexpr int kMostTilts = 3;

// Cosine: a normal this nearly perpendicular to another has no useful gnomonic coordinates.
inline constexpr double kGrazing = 1e-6;

// The place of a contact. In units of the pair's length: beyond this, a radius of curvature drowns the radii across it, unless the
// basis is aligned with it. In these units, or the tolerance if that is larger: this near to a body a contact counts as a point of
// it.
inline constexpr double kFlatContact = 1e4;
inline constexpr double kNear = 1e-7;

// Curvatures, in smallest half-extents. Edges have no smaller radius, and a larger radius counts as flat.
inline constexpr double kSharpest = 1e-9;
inline constexpr double kFlat = 1e12;

}  // namespace supernormal::limits
