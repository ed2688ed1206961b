// When the gap function of two overlapping bodies may have several local maxima.
#pragma once

namespace supernormal {

/// Whether two bodies that overlap by `depth` (m) may have a better local maximum than the one found. `min_radii` (m) is the sum of
/// the bodies' smallest radii of curvature. If a ball with the radius `depth` rolls freely inside the Minkowski difference, the
/// maximum is the only one (Blaschke's rolling theorem), and the smallest radii of curvature of the bodies add. With
/// Shape::min_curvature_radius_estimate() the result is an estimate. Shape::rolling_radius() gives the proof.
bool may_have_other_maxima(double min_radii, double depth);

}  // namespace supernormal
