// The gap function on the sphere of normals, with the paths of the solvers.
#pragma once

#include <string>

#include "drawing/svg.hpp"
#include "method/explanation.hpp"
#include "method/sphere_map.hpp"

namespace explain_pair {

/// How a solver is drawn.
struct PathStyle {
  const char* name;
  const char* colour;
  const char* dashes;  ///< stroke-dasharray; "none" for a solid line
  enum class Marker { Circle, Triangle, Square } marker;
};

const PathStyle& style_of(supernormal::Solver solver);

void draw_marker(Svg& svg, const Vector2& at, const PathStyle& style, double size);

/// How the borders of what the cuts leave are drawn, and those of the normals that separate the bodies.
inline constexpr const char* kRegionStyle = R"(stroke="#000" stroke-width="1.1" stroke-dasharray="5 2.5")";
inline constexpr const char* kZeroStyle = R"(stroke="#234" stroke-width="1.8")";

void draw_ring(Svg& svg, const Vector2& at);
void draw_number(Svg& svg, const Vector2& at, const std::string& number);

/// The whole sphere on Hammer's map, with a bar of colours below. `close_up`: half of the angle, rad, that draw_close_up() shows.
void draw_sphere(Svg& svg, const Box& box, const Explanation& explanation, const Frame& frame, double close_up);

/// The surroundings of the answer on Lambert's map.
void draw_close_up(Svg& svg, const Box& box, const Explanation& explanation, const Frame& frame, double half_angle);

/// The half angle, rad, that shows what the solvers do after their first steps.
double close_up_angle(const Explanation& explanation);

}  // namespace explain_pair
