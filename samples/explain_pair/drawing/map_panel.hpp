// The gap function on the sphere of normals, with the paths of the solvers.
#pragma once

#include "drawing/svg.hpp"
#include "method/explanation.hpp"
#include "method/sphere_map.hpp"

namespace explain_pair {

/// How the border of the normals that separate the bodies is drawn.
inline constexpr const char* kZeroStyle = R"(stroke="#234" stroke-width="1.8")";

/// The whole sphere on Hammer's map, with a bar of colours below. `close_up`: half of the angle, rad, that draw_close_up() shows.
void draw_sphere(Svg& svg, const Box& box, const Explanation& explanation, const Frame& frame, double close_up);

/// The surroundings of the answer on Lambert's map.
void draw_close_up(Svg& svg, const Box& box, const Explanation& explanation, const Frame& frame, double half_angle);

/// The half angle, rad, that shows what the solvers do after their first steps.
double close_up_angle(const Explanation& explanation);

}  // namespace explain_pair
