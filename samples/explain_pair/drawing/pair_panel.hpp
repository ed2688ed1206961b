// The pair as it is seen across the common normal.
#pragma once

#include "drawing/svg.hpp"
#include "method/explanation.hpp"
#include "method/sphere_map.hpp"

namespace explain_pair {

/// Draws both bodies, the tangent planes, the witness points, the contact and the gap.
void draw_pair(Svg& svg, const Box& box, const Explanation& explanation, const Frame& frame);

/// Draws a mark of a contact point.
void draw_contact(Svg& svg, const Vector2& at);

/// Draws the directions of the world's axes.
void draw_axes(Svg& svg, const Vector2& at, const Frame& frame);

/// Draws the contact points of a flat contact, seen along the normal.
void draw_manifold(Svg& svg, const Box& box, const Explanation& explanation, const Frame& frame);

}  // namespace explain_pair
