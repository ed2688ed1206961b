// Triangles of a file: from polygons, oriented outwards, and their open edges.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "read_data.hpp"

namespace fit {

/// Adds a polygon, as triangles, to the vertices that are read. `corners` are indices from 0, as the file has them. Polygons with
/// fewer than three vertices have no area and are left out. Returns what is wrong with the polygon; "": nothing.
std::string append_polygon(std::span<const double> corners, Data& data);

/// The changes to a mesh.
struct Oriented {
  std::size_t removed = 0;  ///< triangles with coincident vertices, or with the vertices of an earlier triangle
  std::size_t turned = 0;   ///< triangles that faced inwards
};

/// Orients all triangles of a welded mesh outwards. Neighbours get the same orientation. Each connected part is oriented by the
/// sign of its volume. A part inside another one is a cavity and is oriented together with it. Removes triangles with coincident
/// vertices. Of two triangles with the same vertices (a two-sided mesh) it removes the second.
Oriented orient(Data& data);

/// The edges that keep oriented triangles from enclosing a volume: those that are not traversed equally often in both directions.
struct OpenEdges {
  std::size_t single = 0;  ///< with one triangle
  std::size_t other = 0;   ///< with several, such as three, or two of a Moebius strip
};
OpenEdges open_edges(std::span<const Triangle> triangles);

/// A sentence for the user, such as "the mesh is open: 12 edges have one triangle".
std::string describe(const OpenEdges& edges);

}  // namespace fit
