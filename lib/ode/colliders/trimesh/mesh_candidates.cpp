#include "ode/colliders/trimesh/mesh_candidates.hpp"

#include <algorithm>
#include <limits>

#include "ode/geom/convert.hpp"
#include "ode/support/private_geom.hpp"

namespace supernormal::ode {
namespace {

// Relative margin: the tree is searched in float, which loses this fraction of the coordinates.
constexpr double kFloatMargin = 4e-6;

std::array<Vector3, 3> vertices_of(dGeomID mesh, int index) {
  dVector3 v[3];
  dGeomTriMeshGetTriangle(mesh, index, &v[0], &v[1], &v[2]);
  return {to_vector(v[0]), to_vector(v[1]), to_vector(v[2])};
}

// The vector has its capacity before ODE calls: no exception may pass through ODE.
int collect_index(dGeomID /*mesh*/, dGeomID box, int index) {
  static_cast<std::vector<int>*>(dGeomGetData(box))->push_back(index);
  return 0;  // no contacts from ODE
}

/// Replaces the callbacks of a mesh while it lives. It also disables the mesh's temporal coherence cache for boxes, which would
/// hold our query box.
class Interception {
 public:
  explicit Interception(dGeomID mesh)
      : mesh_(mesh),
        callback_(dGeomTriMeshGetCallback(mesh)),
        array_callback_(dGeomTriMeshGetArrayCallback(mesh)),
        caches_boxes_(dGeomTriMeshIsTCEnabled(mesh, dBoxClass)) {
    dGeomTriMeshSetCallback(mesh, collect_index);
    dGeomTriMeshSetArrayCallback(mesh, nullptr);
    if (caches_boxes_ != 0) dGeomTriMeshEnableTC(mesh, dBoxClass, 0);
  }
  ~Interception() {
    dGeomTriMeshSetCallback(mesh_, callback_);
    dGeomTriMeshSetArrayCallback(mesh_, array_callback_);
    if (caches_boxes_ != 0) dGeomTriMeshEnableTC(mesh_, dBoxClass, caches_boxes_);
  }
  Interception(const Interception&) = delete;
  Interception(Interception&&) = delete;
  Interception& operator=(const Interception&) = delete;
  Interception& operator=(Interception&&) = delete;

 private:
  dGeomID mesh_;
  dTriCallback* callback_;
  dTriArrayCallback* array_callback_;
  int caches_boxes_;
};

}  // namespace

MeshCandidates::MeshCandidates() : query_box_(dCreateBox(nullptr, 1, 1, 1)) { dGeomSetData(query_box_, &indices_); }

MeshCandidates::~MeshCandidates() { destroy_private_geom(query_box_); }

std::span<const MeshTriangle> MeshCandidates::find(dGeomID mesh, dGeomID geom, const BodyBox& box, const Pose& pose,
                                                   bool is_collision) {
  static const bool has_tree = dCheckConfiguration("ODE_EXT_opcode") != 0;
  indices_.clear();
  indices_.reserve(static_cast<std::size_t>(std::max(dGeomTriMeshGetTriangleCount(mesh), 0)));
  const double reach =
      box.half_lengths.sum() + box.centre.lpNorm<1>() + (pose.position - to_vector(dGeomGetPosition(mesh))).lpNorm<1>();
  const BodyBox searched = box.widened(kFloatMargin * reach);
  if (has_tree) {
    search_tree(mesh, searched, pose);
  } else {
    search_all(mesh, searched, pose);
  }
  dTriArrayCallback* const tell = dGeomTriMeshGetArrayCallback(mesh);
  if (is_collision && tell != nullptr && !indices_.empty()) tell(mesh, geom, indices_.data(), static_cast<int>(indices_.size()));
  if (dTriCallback* const is_wanted = dGeomTriMeshGetCallback(mesh); is_wanted != nullptr) {
    std::erase_if(indices_, [&](int index) { return is_wanted(mesh, geom, index) == 0; });
  }
  read_triangles(mesh);
  return triangles_;
}

void MeshCandidates::search_tree(dGeomID mesh, const BodyBox& box, const Pose& pose) {
  const Vector3 sides = 2 * box.half_lengths;
  const Vector3 centre = pose.position + pose.rotation * box.centre;
  dMatrix3 rotation{};
  for (int row = 0; row < 3; ++row) from_vector(pose.rotation.row(row).transpose(), rotation + std::ptrdiff_t{4} * row);
  dGeomBoxSetLengths(query_box_, to_real(sides.x()), to_real(sides.y()), to_real(sides.z()));
  dGeomSetPosition(query_box_, to_real(centre.x()), to_real(centre.y()), to_real(centre.z()));
  dGeomSetRotation(query_box_, rotation);
  const Interception interception(mesh);
  dContactGeom unused;
  dCollide(mesh, query_box_, 1, &unused, sizeof unused);
}

void MeshCandidates::search_all(dGeomID mesh, const BodyBox& box, const Pose& pose) {
  const int count = dGeomTriMeshGetTriangleCount(mesh);
  for (int index = 0; index < count; ++index) {
    if (box.touches(pose, vertices_of(mesh, index))) indices_.push_back(index);
  }
}

void MeshCandidates::read_triangles(dGeomID mesh) {
  triangles_.clear();
  const Vector3 origin = to_vector(dGeomGetPosition(mesh));
  for (const int index : indices_) {
    const std::array<Vector3, 3> vertices = vertices_of(mesh, index);
    double farthest = 0;
    for (const Vector3& vertex : vertices) farthest = std::max(farthest, (vertex - origin).norm());
    // ODE hands out vertices in float, relative to the origin of the mesh, also those that a program gave in double.
    triangles_.push_back({vertices, index, kFloatRounding * farthest + std::numeric_limits<dReal>::epsilon() * vertices[0].norm()});
  }
}

}  // namespace supernormal::ode
