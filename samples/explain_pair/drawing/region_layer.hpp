// The region of the sphere of normals that the supporting half-spaces (cuts) do not exclude.
#pragma once

#include "drawing/map_in_picture.hpp"
#include "drawing/svg.hpp"
#include "method/explanation.hpp"

namespace explain_pair {

/// Style of the borders.
inline constexpr const char* kRegionStyle = R"(stroke="#000" stroke-width="1.1" stroke-dasharray="5 2.5")";

/// Draws the number of evaluations that left a region.
void draw_number(Svg& svg, const Vector2& at, const std::string& number);

/// Draws the regions that remain after some numbers of evaluations, unless they are small. Darkens what the last of them excludes.
/// `occupied`: positions to keep free of numbers.
void draw_regions(Svg& svg, const Explanation& explanation, const MapInPicture& map, Polyline occupied);

}  // namespace explain_pair
