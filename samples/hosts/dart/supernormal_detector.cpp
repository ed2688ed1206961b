#include "supernormal_detector.hpp"

#include <stdexcept>
#include <unordered_map>

namespace supernormal::dart_host {
namespace {

using dart::collision::CollisionObject;
using dart::collision::OdeCollisionGroup;
using dart::collision::OdeCollisionObject;

/// A geom of ours, destroyed with its owner.
struct GeomDeleter {
  void operator()(dGeomID geom) const { dGeomDestroy(geom); }
};
using OwnedGeom = std::unique_ptr<dxGeom, GeomDeleter>;

OwnedGeom owned(dGeomID geom) {
  if (geom == nullptr) throw std::runtime_error(std::string("a shape was refused: ") + snLastError());
  return OwnedGeom(geom);
}

/// DART gives only derived classes access to the geom of a collision object.
struct GeomReader : OdeCollisionObject {
  static dGeomID geom_of(const CollisionObject* object) {
    return (static_cast<const OdeCollisionObject*>(object)->*&GeomReader::getOdeGeomId)();
  }
};

/// Our geom for the shape; null if DART's will do.
OwnedGeom make_geom(const dart::dynamics::Shape& shape) {
  if (shape.getType() == dart::dynamics::EllipsoidShape::getStaticType()) {
    const Eigen::Vector3d half = static_cast<const dart::dynamics::EllipsoidShape&>(shape).getRadii();
    return owned(snCreateEllipsoid(nullptr, half.x(), half.y(), half.z()));
  }
  if (shape.getType() == SuperellipsoidShape::static_type()) {
    return owned(static_cast<const SuperellipsoidShape&>(shape).create_geom());
  }
  return nullptr;
}

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

/// Mass properties from a geom, which has them exactly.
dMass mass_of(const SuperellipsoidShape& shape, double total_mass) {
  const OwnedGeom geom = owned(shape.create_geom());
  dMass mass;
  if (snMassSetTotal(&mass, total_mass, geom.get()) == 0) throw std::runtime_error(snLastError());
  return mass;
}

}  // namespace

SuperellipsoidShape::SuperellipsoidShape(const Eigen::Vector3d& half_axes, double delta, double epsilon)
    : half_axes_(half_axes), delta_(delta), epsilon_(epsilon) {
  owned(create_geom());  // refuses invalid parameters at once
}

const std::string& SuperellipsoidShape::static_type() {
  static const std::string type = "supernormal::SuperellipsoidShape";
  return type;
}

dGeomID SuperellipsoidShape::create_geom() const {
  return owned(snCreateSuperellipsoid(nullptr, half_axes_.x(), half_axes_.y(), half_axes_.z(), delta_, epsilon_)).release();
}

Eigen::Matrix3d SuperellipsoidShape::computeInertia(double mass) const {
  const dMass found = mass_of(*this, mass);
  return Eigen::Vector3d(found.I[0], found.I[5], found.I[10]).asDiagonal();
}

void SuperellipsoidShape::updateBoundingBox() const {
  mBoundingBox.setMin(-half_axes_);
  mBoundingBox.setMax(half_axes_);
  mIsBoundingBoxDirty = false;
}

void SuperellipsoidShape::updateVolume() const {
  const OwnedGeom geom = owned(create_geom());
  dMass mass;
  if (snMassSet(&mass, 1, geom.get()) == 0) throw std::runtime_error(snLastError());
  mVolume = mass.mass;
  mIsVolumeDirty = false;
}

std::shared_ptr<SupernormalDetector> SupernormalDetector::create() { return std::make_shared<SupernormalDetector>(); }

std::unique_ptr<dart::collision::CollisionGroup> SupernormalDetector::createCollisionGroup() {
  return std::make_unique<SupernormalGroup>(shared_from_this());
}

}  // namespace supernormal::dart_host
