#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>

#include "common/ode_geom.hpp"
#include "method.hpp"
#include "ode/colliders.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

namespace accuracy_cost {
namespace {

using common::MeshSize;
using common::OdeGeom;
using common::Polyhedron;
using common::superellipsoid_mesh;
using supernormal::Vector3;

constexpr std::array<MeshSize, 3> kSizes = {{{10, 8}, {24, 20}, {48, 40}}};  // 160, 960, 3840 triangles

Polyhedron mesh_of(const supernormal::Shape& shape, MeshSize size) {
  const auto* const body = dynamic_cast<const supernormal::Superellipsoid*>(&shape);
  const auto [delta, epsilon] = body == nullptr ? std::pair(2.0, 2.0) : std::pair(body->delta(), body->epsilon());
  return superellipsoid_mesh(shape.half_extents(), delta, epsilon, 0, size);
}

class OdeMeshes final : public Method {
 public:
  OdeMeshes(MeshSize size, Motion motion) : Method("dTriMesh", std::to_string(size.vertices())), size_(size), motion_(motion) {}

  Answer query(const Pair& pair) const override {
    const OdePair geoms{geom(pair, pair.shape1, pair.pose1), geom(pair, pair.shape2, pair.pose2)};
    std::array<dContactGeom, kMaxContacts> contacts;
    const int count = geoms.collide(contacts);
    if (count == 0) return {Answer::Kind::Apart, 0, Vector3::UnitX(), 0};
    const dContactGeom& deepest = *std::max_element(contacts.begin(), contacts.begin() + count,
                                                    [](const auto& a, const auto& b) { return a.depth < b.depth; });
    return {Answer::Kind::Gap, -double{deepest.depth}, -Vector3(deepest.normal[0], deepest.normal[1], deepest.normal[2]), 0,
            Vector3(deepest.pos[0], deepest.pos[1], deepest.pos[2])};
  }

 private:
  /// Creates the geom once, and places it once unless the bodies move, outside the measured time: the first query of a pair is not
  /// timed.
  dGeomID geom(const Pair& pair, const std::shared_ptr<const supernormal::Shape>& shape, const supernormal::Pose& pose) const {
    const auto known = geoms_.find(shape.get());
    if (known != geoms_.end()) {
      if (motion_ == Motion::Moves) OdePair{known->second.geom.id(), nullptr}.move_body(pose);
      return known->second.geom.id();
    }
    const dGeomID id = geoms_.emplace(shape.get(), Kept{pair.shape1, pair.shape2, common::trimesh_maker(mesh_of(*shape, size_))()})
                           .first->second.geom.id();
    OdePair{id, nullptr}.move_body(pose);
    return id;
  }

  struct Kept {
    std::shared_ptr<const supernormal::Shape> shape1, shape2;  // kept alive, so that no other shape gets their addresses
    OdeGeom geom;
  };
  MeshSize size_;
  Motion motion_;
  mutable std::unordered_map<const supernormal::Shape*, Kept> geoms_;
};

}  // namespace

Methods literature_mesh_methods(Motion motion) {
  Methods methods;
  for (const MeshSize size : kSizes) methods.push_back(std::make_unique<OdeMeshes>(size, motion));
  return methods;
}

}  // namespace accuracy_cost
