// DART with real ellipsoids and superellipsoids. Its ODE detector replaces unknown shapes by spheres of 1 cm.
#pragma once

#include <supernormal/supernormal.h>

#include <dart/collision/ode/ode.hpp>
#include <dart/dynamics/dynamics.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace supernormal::dart_host {

using dart::collision::CollisionObject;
using dart::collision::OdeCollisionGroup;
using dart::collision::OdeCollisionObject;

/// A geom of ours, destroyed with its owner.
struct GeomDeleter {
  void operator()(dGeomID geom) const { dGeomDestroy(geom); }
};
using OwnedGeom = std::unique_ptr<dxGeom, GeomDeleter>;

/// Throws std::runtime_error with the library's message if the geom is null.
inline OwnedGeom owned(dGeomID geom) {
  if (geom == nullptr) throw std::runtime_error(std::string("a shape was refused: ") + snLastError());
  return OwnedGeom(geom);
}

/// A shape that DART does not have; half-axes in m, exponents as in snCreateSuperellipsoid. DART takes its inertia from
/// computeInertia().
class SuperellipsoidShape : public dart::dynamics::Shape {
 public:
  SuperellipsoidShape(const Eigen::Vector3d& half_axes, double delta, double epsilon)
      : half_axes_(half_axes), delta_(delta), epsilon_(epsilon) {
    create_geom();  // refuses invalid parameters at once
  }

  static const std::string& static_type() {
    static const std::string type = "supernormal::SuperellipsoidShape";
    return type;
  }
  const std::string& getType() const override { return static_type(); }

  Eigen::Matrix3d computeInertia(double mass) const override {
    dMass found;
    if (snMassSetTotal(&found, mass, create_geom().get()) == 0) throw std::runtime_error(snLastError());
    return Eigen::Vector3d(found.I[0], found.I[5], found.I[10]).asDiagonal();
  }

  /// A geom of this shape, in no space. Throws std::runtime_error with the library's message if the library refuses the parameters.
  OwnedGeom create_geom() const {
    return owned(snCreateSuperellipsoid(nullptr, half_axes_.x(), half_axes_.y(), half_axes_.z(), delta_, epsilon_));
  }

 protected:
  void updateBoundingBox() const override {
    mBoundingBox.setMin(-half_axes_);
    mBoundingBox.setMax(half_axes_);
    mIsBoundingBoxDirty = false;
  }

  void updateVolume() const override {
    dMass mass;
    if (snMassSet(&mass, 1, create_geom().get()) == 0) throw std::runtime_error(snLastError());
    mVolume = mass.mass;
    mIsVolumeDirty = false;
  }

 private:
  Eigen::Vector3d half_axes_;
  double delta_, epsilon_;
};

/// DART gives only derived classes access to the geom of a collision object.
struct GeomReader : OdeCollisionObject {
  static dGeomID geom_of(const CollisionObject* object) {
    return (static_cast<const OdeCollisionObject*>(object)->*&GeomReader::getOdeGeomId)();
  }
};

/// Our geom for the shape; null if DART's will do.
inline OwnedGeom make_geom(const dart::dynamics::Shape& shape) {
  if (shape.getType() == dart::dynamics::EllipsoidShape::getStaticType()) {
    const Eigen::Vector3d half = static_cast<const dart::dynamics::EllipsoidShape&>(shape).getRadii();
    return owned(snCreateEllipsoid(nullptr, half.x(), half.y(), half.z()));
  }
  if (shape.getType() == SuperellipsoidShape::static_type()) {
    return static_cast<const SuperellipsoidShape&>(shape).create_geom();
  }
  return nullptr;
}

/// A group in which our geoms take the place of DART's.
class SupernormalGroup : public OdeCollisionGroup {
 public:
  using OdeCollisionGroup::OdeCollisionGroup;

 protected:
  void addCollisionObjectToEngine(CollisionObject* object) override {
    OdeCollisionGroup::addCollisionObjectToEngine(object);
    OwnedGeom ours = make_geom(*object->getShape());
    if (ours == nullptr) return;
    // DART's own geom stays where DART expects it, but takes no part in collisions. The data of a geom is its collision object.
    dGeomID theirs = GeomReader::geom_of(object);
    dGeomDisable(theirs);
    dGeomSetBody(ours.get(), dGeomGetBody(theirs));
    dGeomSetData(ours.get(), object);
    dSpaceAdd(getOdeSpaceId(), ours.get());
    geoms_[object] = std::move(ours);
  }

  void addCollisionObjectsToEngine(const std::vector<CollisionObject*>& objects) override {
    for (CollisionObject* object : objects) addCollisionObjectToEngine(object);
  }

  void removeCollisionObjectFromEngine(CollisionObject* object) override {
    geoms_.erase(object);
    OdeCollisionGroup::removeCollisionObjectFromEngine(object);
  }

  void removeAllCollisionObjectsFromEngine() override {
    geoms_.clear();
    OdeCollisionGroup::removeAllCollisionObjectsFromEngine();
  }

 private:
  std::unordered_map<const CollisionObject*, OwnedGeom> geoms_;
};

/// DART's ODE detector, except for EllipsoidShape and SuperellipsoidShape. Their geoms are replaced by ours, on the same body, in
/// the same space. Use it like DART's own: world->getConstraintSolver()->setCollisionDetector(SupernormalDetector::create()).
class SupernormalDetector : public dart::collision::OdeCollisionDetector {
 public:
  static std::shared_ptr<SupernormalDetector> create() { return std::make_shared<SupernormalDetector>(); }
  std::unique_ptr<dart::collision::CollisionGroup> createCollisionGroup() override {
    return std::make_unique<SupernormalGroup>(shared_from_this());
  }
  std::shared_ptr<dart::collision::CollisionDetector> cloneWithoutCollisionObjects() const override { return create(); }
};

}  // namespace supernormal::dart_host
