// The triangles of a dTriMesh near a body.
#pragma once

#include <ode/ode.h>

#include <span>
#include <vector>

#include "supernormal/contact/body_box.hpp"
#include "supernormal/contact/mesh_contacts.hpp"
#include "supernormal/proximity/pose.hpp"

namespace supernormal::ode {

/// Searches ODE's own tree of bounding volumes, with a dBox and a callback that writes down the triangles that it is called for:
/// the callbacks of the mesh are replaced for that time and put back. Like everything with a dTriMesh, it is not for several
/// threads at once. A mesh without such a tree (GIMPACT) is searched from end to end. Keeps its memory and its dBox from one
/// query to the next, also when ODE is closed and initialised again in between.
class MeshCandidates {
 public:
  MeshCandidates();
  ~MeshCandidates();
  MeshCandidates(const MeshCandidates&) = delete;
  MeshCandidates(MeshCandidates&&) = delete;
  MeshCandidates& operator=(const MeshCandidates&) = delete;
  MeshCandidates& operator=(MeshCandidates&&) = delete;

  /// All triangles of the mesh that touch the box, and perhaps some more, in ODE's order; world frame. Valid until the next call.
  /// When the program has set a dTriCallback, only those are listed that it accepts for the body `geom`; a dTriArrayCallback gets
  /// all of them first if `is_collision`.
  std::span<const MeshTriangle> find(dGeomID mesh, dGeomID geom, const BodyBox& box, const Pose& pose, bool is_collision);

 private:
  void ask_tree(dGeomID mesh, const BodyBox& box, const Pose& pose);
  void search_all(dGeomID mesh, const BodyBox& box, const Pose& pose);
  void read_triangles(dGeomID mesh);

  dGeomID query_box_;  // a dBox
  std::vector<int> indices_;
  std::vector<MeshTriangle> triangles_;
};

}  // namespace supernormal::ode
