// The triangles of a dTriMesh near a body.
#pragma once

#include <ode/ode.h>

#include <span>
#include <vector>

#include "supernormal/contact/body_box.hpp"
#include "supernormal/contact/mesh_contacts.hpp"
#include "supernormal/proximity/pose.hpp"

namespace supernormal::ode {

/// Searches the tree of bounding volumes of ODE with a dBox and a callback that collects triangles. The callbacks of the mesh are
/// replaced during the search and then restored. Like every use of a dTriMesh, it is not thread-safe. A mesh without such a tree
/// (GIMPACT) is searched linearly. Keep an instance to reuse its memory and its dBox. It survives dCloseODE and dInitODE.
class MeshCandidates {
 public:
  MeshCandidates();
  ~MeshCandidates();
  MeshCandidates(const MeshCandidates&) = delete;
  MeshCandidates(MeshCandidates&&) = delete;
  MeshCandidates& operator=(const MeshCandidates&) = delete;
  MeshCandidates& operator=(MeshCandidates&&) = delete;

  /// All triangles of the mesh that touch the box, and perhaps some more, in the order of ODE. Frame: world. Valid until the next
  /// call. A dTriCallback of the program filters the triangles for the body `geom`. If `is_collision`, a dTriArrayCallback gets all
  /// of them first.
  std::span<const MeshTriangle> find(dGeomID mesh, dGeomID geom, const BodyBox& box, const Pose& pose, bool is_collision);

 private:
  void search_tree(dGeomID mesh, const BodyBox& box, const Pose& pose);
  void search_all(dGeomID mesh, const BodyBox& box, const Pose& pose);
  void read_triangles(dGeomID mesh);

  dGeomID query_box_;  // a dBox
  std::vector<int> indices_;
  std::vector<MeshTriangle> triangles_;
};

}  // namespace supernormal::ode
