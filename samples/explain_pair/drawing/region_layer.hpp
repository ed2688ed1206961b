// What the cuts leave of the sphere of normals.
#pragma once

#include "drawing/map_in_picture.hpp"
#include "drawing/svg.hpp"
#include "method/explanation.hpp"

namespace explain_pair {

/// How the borders are drawn.
inline constexpr const char* kRegionStyle = R"(stroke="#000" stroke-width="1.1" stroke-dasharray="5 2.5")";

/// Draws the number of evaluations that left a region.
void draw_number(Svg& svg, const Vector2& at, const std::string& number);

/// Draws what the cuts leave after some numbers of evaluations, as long as it is not small, and darkens what the last of these
/// excludes. `occupied`: places that keep free of numbers.
void draw_regions(Svg& svg, const Explanation& explanation, const MapInPicture& map, Polyline occupied);

}  // namespace explain_pair
