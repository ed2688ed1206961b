// The paths of the solvers on a map of the sphere of normals.
#pragma once

#include "drawing/map_in_picture.hpp"
#include "drawing/svg.hpp"
#include "method/explanation.hpp"

namespace explain_pair {

/// The style of a solver.
struct PathStyle {
  const char* colour;
  const char* dashes;  ///< stroke-dasharray; "none" for a solid line
  enum class Marker { Circle, Triangle, Square, Diamond } marker;
};

PathStyle style_of(const SolverPath& path);

void draw_marker(Svg& svg, const Vector2& at, const PathStyle& style, double size);

/// Draws the mark of the result.
void draw_ring(Svg& svg, const Vector2& at);

/// Draws the evaluated normals of all solvers, the great circles between them, and the result. `size`: of the markers, px.
void draw_paths(Svg& svg, const Explanation& explanation, const MapInPicture& map, double size, bool has_numbers);

}  // namespace explain_pair
