// dTriMesh geoms for tests: the geom, and the arrays to which ODE refers.
#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "support/ode_fixture.hpp"

namespace supernormal::test {

struct MeshArrays {
  std::vector<std::array<float, 3>> vertices;
  std::vector<std::array<dTriIndex, 3>> triangles;

  dTriIndex add(double x, double y, double z) {
    vertices.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
    return static_cast<dTriIndex>(vertices.size() - 1);
  }
};

/// A level rectangle from the origin to (x_cells, y_cells) * cell, z = 0, two triangles a cell.
inline MeshArrays floor_arrays(unsigned x_cells, unsigned y_cells, double cell) {
  MeshArrays mesh;
  for (unsigned i = 0; i <= x_cells; ++i) {
    for (unsigned j = 0; j <= y_cells; ++j) mesh.add(i * cell, j * cell, 0);
  }
  for (unsigned i = 0; i < x_cells; ++i) {
    for (unsigned j = 0; j < y_cells; ++j) {
      const dTriIndex a = i * (y_cells + 1) + j;
      const dTriIndex b = a + y_cells + 1;
      mesh.triangles.push_back({a, b, a + 1});
      mesh.triangles.push_back({b, b + 1, a + 1});
    }
  }
  return mesh;
}

/// A box of triangles that face outwards. With `inward` it is a room instead of a block.
inline MeshArrays box_arrays(double x, double y, double z, bool inward = false) {
  MeshArrays mesh;
  for (unsigned i = 0; i < 8; ++i) mesh.add((i & 1U) != 0 ? x : -x, (i & 2U) != 0 ? y : -y, (i & 4U) != 0 ? z : -z);
  const std::array<std::array<dTriIndex, 4>, 6> sides = {
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& [a, b, c, d] : sides) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  if (inward) {
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  }
  return mesh;
}

/// A mesh geom that owns everything. It cannot be moved, because ODE refers to its members.
class MeshGeom {
 public:
  explicit MeshGeom(MeshArrays arrays, dSpaceID space = nullptr) : arrays_(std::move(arrays)), data_(dGeomTriMeshDataCreate()) {
    dGeomTriMeshDataBuildSingle(data_, arrays_.vertices.data(), sizeof arrays_.vertices[0],
                                static_cast<int>(arrays_.vertices.size()), arrays_.triangles.data(),
                                static_cast<int>(3 * arrays_.triangles.size()), sizeof arrays_.triangles[0]);
    id_ = dCreateTriMesh(space, data_, nullptr, nullptr, nullptr);
  }
  ~MeshGeom() {
    dGeomDestroy(id_);
    dGeomTriMeshDataDestroy(data_);
  }
  MeshGeom(const MeshGeom&) = delete;
  MeshGeom(MeshGeom&&) = delete;
  MeshGeom& operator=(const MeshGeom&) = delete;
  MeshGeom& operator=(MeshGeom&&) = delete;
  operator dGeomID() const { return id_; }  // NOLINT(google-explicit-constructor): as ODE's own dGeom

 private:
  MeshArrays arrays_;
  dTriMeshDataID data_;
  dGeomID id_ = nullptr;
};

}  // namespace supernormal::test
