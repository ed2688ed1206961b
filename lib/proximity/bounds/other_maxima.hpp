// When the gap function of two overlapping bodies may have several local maxima.
#pragma once

namespace supernormal {

/// `min_radii`: m; the sum of the bodies' smallest radii of curvature.
/// Whether two bodies that overlap by `depth` (m) may have a better local maximum than the one found. If a ball with the radius of
/// the depth rolls freely inside the difference of the bodies, the maximum is the only one (Blaschke's rolling theorem); the
/// smallest radii of curvature of the bodies add. An estimate where these radii are (Shape::min_curvature_radius_estimate());
/// Shape::rolling_radius() gives the proof.
bool may_have_other_maxima(double min_radii, double depth);

}  // namespace supernormal
