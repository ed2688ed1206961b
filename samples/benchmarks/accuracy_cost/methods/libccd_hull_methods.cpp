#include <unordered_map>

#include "hull.hpp"
#include "libccd_query.hpp"

namespace accuracy_cost {
namespace {

using common::MeshSize;
using supernormal::Vector3;

constexpr double kTolerance = 1e-6;  // m

/// A hull in its pose, for the callbacks of libccd.
struct PlacedHull {
  const Hull& hull;
  const supernormal::Pose& pose;
  mutable unsigned nearest = 0;  // vertex of the last direction, the start of the next search
};

void copy(const Vector3& from, ccd_vec3_t* to) { ccdVec3Set(to, from.x(), from.y(), from.z()); }

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  const auto& body = *static_cast<const PlacedHull*>(object);
  const Vector3 n = body.pose.rotation.transpose() * Vector3(direction->v[0], direction->v[1], direction->v[2]);
  body.nearest = body.hull.support(n, body.nearest);
  copy(body.pose.rotation * body.hull.vertex(body.nearest) + body.pose.position, point);
}

void centre(const void* object, ccd_vec3_t* point) { copy(static_cast<const PlacedHull*>(object)->pose.position, point); }

class CcdHull final : public Method {
 public:
  explicit CcdHull(MeshSize size)
      : Method("libccd GJK+EPA on hulls", std::to_string(size.vertices())),
        size_(size),
        settings_(ccd_settings(support, centre, kTolerance)) {}

  Answer query(const Pair& pair) const override {
    const PlacedHull hull1{hull(pair.shape1), pair.pose1};
    const PlacedHull hull2{hull(pair.shape2), pair.pose2};
    return ask_libccd(ccdGJKPenetration, settings_, &hull1, &hull2);
  }

 private:
  /// Creates the hull once, outside the measured time, because the first query of a pair is not timed.
  const Hull& hull(const std::shared_ptr<const supernormal::Shape>& shape) const {
    const auto known = hulls_.find(shape.get());
    if (known != hulls_.end()) return known->second.hull;
    return hulls_.emplace(shape.get(), Kept{shape, Hull(mesh_of(*shape, size_))}).first->second.hull;
  }

  struct Kept {
    std::shared_ptr<const supernormal::Shape> shape;  // kept alive, so that no other shape gets its address
    Hull hull;
  };
  MeshSize size_;
  ccd_t settings_;
  mutable std::unordered_map<const supernormal::Shape*, Kept> hulls_;
};

}  // namespace

std::unique_ptr<Method> ccd_hull(MeshSize size) { return std::make_unique<CcdHull>(size); }

}  // namespace accuracy_cost
