// Meshes that grains meet from both sides.
#pragma once

#include <ode/ode.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/mesh.hpp"
#include "wall.hpp"

namespace falling_particles {

/// The sheets of a mesh. Two triangles belong to one sheet if they share an edge that no third triangle has. Vertices that differ
/// by rounding count as one.
struct Sheets {
  std::vector<std::array<unsigned int, 3>> triangles;  ///< indices of vertices; anticlockwise as seen from one side of a sheet
  std::vector<std::array<unsigned int, 3>> corners;    ///< vertices of the triangles, as numbers that are equal for equal vertices
  std::vector<std::array<int, 3>> neighbours;          ///< in the sheet, across the edge from each vertex to the next; -1: none
  std::vector<unsigned int> sheet;                     ///< of each triangle
};

/// The sheets of a mesh, with each triangle once, however it is wound. Throws std::runtime_error for a sheet with one side only, as
/// a Möbius strip.
Sheets sheets_of(const Mesh& mesh);

/// A mesh that grains meet from the side of their centres.
///
/// To the library's bodies the space behind a triangle of a dTriMesh is solid. So ODE gets each triangle in both windings. For each
/// grain, callbacks of the geom accept the triangles that face its centre. The nearest place of the whole sheet decides which side
/// the centre is on. The plane of a single triangle would not do: a grain beside a sharp ridge is behind the plane of the other
/// slope.
class TwoSidedMesh {
 public:
  /// The mesh must outlive this object.
  explicit TwoSidedMesh(const MeshShape& mesh);

  /// Every triangle, then every triangle flipped. They stay at the same address.
  const std::vector<std::array<unsigned int, 3>>& triangles() const { return both_; }
  /// Makes a dTriMesh of these triangles collide with bodies on both sides. Its data pointer is this object, which must outlive it.
  void attach(dGeomID geom) const;

 private:
  /// The place of a sheet nearest to a point.
  struct Foot {
    double squared;      // m^2, of the distance
    bool is_from_front;  // whether the point is in front of the sheet there
  };
  struct View;

  Vector3 vertex(std::size_t triangle, std::size_t corner) const;
  Vector3 normal(std::size_t triangle) const;
  void find_normals();
  Foot foot_on(std::size_t triangle, const Vector3& point) const;
  void look(View& view, const Vector3& centre, std::span<const int> near) const;
  bool is_in_front(View& view, const Vector3& centre, unsigned int sheet) const;
  static View& view();
  static void be_told(dGeomID mesh, dGeomID geom, const int* triangles, int count);
  static int is_wanted(dGeomID mesh, dGeomID geom, int triangle);

  std::uint64_t number_;  // identifies the object; never reused, also after its end
  const std::vector<std::array<float, 3>>& vertices_;
  Sheets sheets_;
  std::vector<std::array<unsigned int, 3>> both_;
  std::vector<std::vector<std::size_t>> of_sheet_;      // triangles
  std::vector<std::array<Vector3, 3>> vertex_normals_;  // of each triangle; not unit vectors
  std::vector<std::array<Vector3, 3>> edge_normals_;    // the same, of the edge from each vertex to the next
};

}  // namespace falling_particles
