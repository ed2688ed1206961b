// When the gap function of two overlapping bodies may have several local maxima.
#pragma once

namespace supernormal {

/// Whether two bodies that overlap by `depth` (m) may have a better local maximum than the one found. If a ball with the radius of
/// the depth rolls freely inside the difference of the bodies, the maximum is the only one (Blaschke's rolling theorem); the
/// smallest radii of curvature of the bodies add. An estimate, of Shape::min_curvature_radius_estimate(); Shape::rolling_radius()
/// gives the proof. `may_have_tips`: whether there may be corners, or vertices and edges where the radii vanish, so that the
/// estimate is of what is beside them.
bool may_have_other_maxima(double radius1, double radius2, double depth, double length_unit, bool may_have_tips);

}  // namespace supernormal
