// The gap function on the sphere of normals, with the paths of the solvers.
#pragma once

#include "drawing/svg.hpp"
#include "method/explanation.hpp"
#include "method/sphere_map.hpp"

namespace explain_pair {

/// Style of the border of the normals that separate the bodies.
inline constexpr const char* kZeroStyle = R"(stroke="#234" stroke-width="1.8")";

/// The whole sphere on Hammer's map, with a colour bar below. `close_up`: the half angle, rad, for draw_close_up().
void draw_sphere(Svg& svg, const Box& box, const Explanation& explanation, const Frame& frame, double close_up);

/// The surroundings of the result on Lambert's map.
void draw_close_up(Svg& svg, const Box& box, const Explanation& explanation, const Frame& frame, double half_angle);

/// The half angle, rad, that shows the steps of the solvers after their first ones.
double close_up_angle(const Explanation& explanation);

}  // namespace explain_pair
