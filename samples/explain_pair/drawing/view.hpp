// Views of a body, through its parameterization by normals.
#pragma once

#include <functional>
#include <vector>

#include "drawing/svg.hpp"
#include "method/sphere_map.hpp"
#include "pair/pair.hpp"

namespace explain_pair {

/// The frame of the picture of a pair. The common normal points to the right, so both tangent planes are seen edge on. The visible
/// area of the bodies is as large as possible.
Frame frame_of_picture(const Pair& pair, const Vector3& normal);

/// An orthographic view that fits bodies into a box of the picture.
class View {
 public:
  View(const Frame& frame, const std::vector<const PlacedBody*>& bodies, const Box& box);
  /// A view with `middle` at the centre of the box, and `scale` px per metre.
  View(const Frame& frame, const Vector3& middle, double scale, const Box& box);

  Vector2 to_px(const Vector3& point) const;  ///< m, world frame
  double scale() const { return scale_; }     ///< px per metre
  const Frame& frame() const { return frame_; }

 private:
  Frame frame_;
  Vector3 middle_;
  double scale_;
  Vector2 centre_;
};

/// The outline of a body: the boundary points whose normals are perpendicular to the view direction. Closed, of either orientation.
Polyline outline(const PlacedBody& body, const View& view);

/// The visible points whose normals are within acos(cosine) of `light` (unit, towards the viewer): a closed polygon, possibly
/// empty.
Polyline lit_part(const PlacedBody& body, const View& view, const Vector3& light, double cosine);

/// The visible boundary curves along which the normal has a constant latitude or longitude in the body's frame, every `spacing`
/// degrees.
std::vector<Polyline> graticule(const PlacedBody& body, const View& view, double spacing);

}  // namespace explain_pair
