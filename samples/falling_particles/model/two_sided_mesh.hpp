// Sheets that hold grains on both sides.
#pragma once

#include <ode/ode.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "wall.hpp"

namespace falling_particles {

/// Triangles are of one sheet when they share an edge that no third one has. Vertices are one when they differ by rounding.
struct Sheets {
  std::vector<std::array<unsigned int, 3>> triangles;  ///< corners, as indices of vertices; anticlockwise from one side of a sheet
  std::vector<std::array<unsigned int, 3>> corners;    ///< of the triangles, as numbers that are the same for vertices that are one
  std::vector<std::array<int, 3>> neighbours;          ///< in the sheet, across the edge from each corner to the next; -1: none
  std::vector<unsigned int> sheet;                     ///< of each triangle
};

/// The sheets of a mesh, each triangle once, however it is wound. Throws std::runtime_error for a sheet that has one side only, as
/// a Möbius strip.
Sheets sheets_of(const Mesh& mesh);

/// A mesh that grains meet from the side on which their centres are.
///
/// To our bodies what is behind a triangle of a dTriMesh is solid. So ODE has each triangle in both windings, and callbacks of the
/// geom leave a grain those that it sees from the front. The side is that of the whole sheet, at its place nearest to the centre:
/// seen from the plane of each triangle alone, a grain beside a sharp ridge would be behind the other slope.
class TwoSidedMesh {
 public:
  /// The mesh must outlive this object.
  explicit TwoSidedMesh(const MeshShape& mesh);

  /// Every triangle, then every triangle the other way round. They stay where they are in memory.
  const std::vector<std::array<unsigned int, 3>>& triangles() const { return both_; }
  /// Makes a dTriMesh of these triangles meet bodies from both sides. Its data is this object, which must outlive it.
  void attach(dGeomID geom) const;

 private:
  /// The place of a sheet that is nearest to a point.
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

  std::uint64_t number_;  // of the object: no other one has it, also after its end
  const std::vector<std::array<float, 3>>& vertices_;
  Sheets sheets_;
  std::vector<std::array<unsigned int, 3>> both_;
  std::vector<std::vector<std::size_t>> of_sheet_;      // triangles
  std::vector<std::array<Vector3, 3>> vertex_normals_;  // of each triangle; not unit
  std::vector<std::array<Vector3, 3>> edge_normals_;    // the same, of the edge from each corner to the next
};

}  // namespace falling_particles
