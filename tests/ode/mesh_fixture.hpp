// dTriMesh geoms for tests: the geom, and the arrays to which ODE refers. ODE takes the vertices in single precision.
#pragma once

#include <array>
#include <vector>

#include "support/mesh_samples.hpp"
#include "support/ode_fixture.hpp"

namespace supernormal::test {

/// A mesh geom that owns everything. It cannot be moved, because ODE refers to its members.
class MeshGeom {
 public:
  explicit MeshGeom(const TriangleMesh& mesh, dSpaceID space = nullptr) : data_(dGeomTriMeshDataCreate()) {
    for (const Vector3& v : mesh.vertices) vertices_.emplace_back(v.cast<float>());
    for (const auto& [a, b, c] : mesh.triangles) triangles_.push_back({dTriIndex(a), dTriIndex(b), dTriIndex(c)});
    dGeomTriMeshDataBuildSingle(data_, vertices_.data(), sizeof vertices_[0], static_cast<int>(vertices_.size()), triangles_.data(),
                                static_cast<int>(3 * triangles_.size()), sizeof triangles_[0]);
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
  std::vector<Eigen::Vector3f> vertices_;
  std::vector<std::array<dTriIndex, 3>> triangles_;
  dTriMeshDataID data_;
  dGeomID id_ = nullptr;
};

}  // namespace supernormal::test
