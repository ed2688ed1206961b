// The pair, viewed perpendicular to the common normal.
#pragma once

#include "drawing/svg.hpp"
#include "method/explanation.hpp"
#include "method/sphere_map.hpp"

namespace explain_pair {

/// Draws both bodies, the tangent planes, the witness points, the contact and the gap.
void draw_pair(Svg& svg, const Box& box, const Explanation& explanation, const Frame& frame);

/// Draws the mark of a contact point.
void draw_contact(Svg& svg, const Vector2& at);

/// Draws the directions of the world axes.
void draw_axes(Svg& svg, const Vector2& at, const Frame& frame);

/// Draws the points of a contact manifold, viewed along the normal.
void draw_manifold(Svg& svg, const Box& box, const Explanation& explanation, const Frame& frame);

}  // namespace explain_pair
