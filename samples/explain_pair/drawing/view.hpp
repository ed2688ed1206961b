// How a body looks from a direction, through its normal parameterization.
#pragma once

#include <functional>
#include <vector>

#include "drawing/svg.hpp"
#include "method/sphere_map.hpp"
#include "pair/pair.hpp"

namespace explain_pair {

/// The frame of the picture of a pair: the common normal points to the right, so that both tangent planes are seen edge on, and
/// the bodies show as much of themselves as they can.
Frame frame_of_picture(const Pair& pair, const Vector3& normal);

/// An orthographic view that fits bodies into a box of the picture.
class View {
 public:
  View(const Frame& frame, const std::vector<const PlacedBody*>& bodies, const Box& box);
  /// A view of that point in the middle of the box, with so many px for a metre.
  View(const Frame& frame, const Vector3& middle, double scale, const Box& box);

  Vector2 to_px(const Vector3& point) const;  ///< m, world frame
  double scale() const { return scale_; }     ///< px for a metre
  const Frame& frame() const { return frame_; }

 private:
  Frame frame_;
  Vector3 middle_;
  double scale_;
  Vector2 centre_;
};

/// The outline of a body: the boundary points whose normals are across the direction of view. Closed, clockwise on the screen or
/// not.
Polyline outline(const PlacedBody& body, const View& view);

/// The points of the visible side whose normals make an angle of less than acos(cosine) with `light` (unit, towards the viewer):
/// a closed polygon, empty where there are none.
Polyline lit_part(const PlacedBody& body, const View& view, const Vector3& light, double cosine);

/// The visible parts of the boundary curves whose normals have constant latitude or longitude in the body's frame, every
/// `spacing` degrees.
std::vector<Polyline> graticule(const PlacedBody& body, const View& view, double spacing);

}  // namespace explain_pair
