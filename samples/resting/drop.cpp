#include "drop.hpp"

#include <supernormal/supernormal.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace resting {
namespace {

constexpr double kDensity = 1000;     // kg/m^3
constexpr double kGravity = 9.81;     // m/s^2
constexpr double kLongest = 10;       // s
constexpr double kFloorSize = 40;     // half-heights, from the middle to the border
constexpr int kMostRoom = 8;          // contacts
constexpr double kLeastTilt = 1;      // degrees
constexpr double kGoldenAngle = 2.4;  // rad; no two drops turn about the same axis
constexpr int kSamples = 9;           // of the heightfield, along each side

/// The floor with its top at z = 0; ODE refers to the arrays of a mesh or a heightfield for as long as the geom lives.
class Floor {
 public:
  Floor(FloorKind kind, dSpaceID space, double size) {
    const auto s = static_cast<dReal>(size);
    switch (kind) {
      case FloorKind::Plane:
        dCreatePlane(space, 0, 0, 1, 0);
        break;
      case FloorKind::Box:
        dGeomSetPosition(dCreateBox(space, 2 * s, 2 * s, s), 0, 0, s / -2);
        break;
      case FloorKind::Mesh:
        add_mesh(space, size);
        break;
      case FloorKind::Heightfield:
        add_heightfield(space, s);
        break;
      case FloorKind::Superellipsoid:
        dGeomSetPosition(snCreateSuperellipsoid(space, s, s, s / 2, 60, 60), 0, 0, s / -2);
        break;
    }
  }
  ~Floor() {
    if (mesh_ != nullptr) dGeomTriMeshDataDestroy(mesh_);
    if (field_ != nullptr) dGeomHeightfieldDataDestroy(field_);
  }
  Floor(const Floor&) = delete;
  Floor(Floor&&) = delete;
  Floor& operator=(const Floor&) = delete;
  Floor& operator=(Floor&&) = delete;

 private:
  void add_mesh(dSpaceID space, double size) {
    const auto s = static_cast<float>(size);
    vertices_ = {-s, -s, 0, s, -s, 0, s, s, 0, -s, s, 0};
    triangles_ = {0, 1, 2, 0, 2, 3};
    mesh_ = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildSingle(mesh_, vertices_.data(), 3 * sizeof(float), 4, triangles_.data(), 6, 3 * sizeof(dTriIndex));
    dCreateTriMesh(space, mesh_, nullptr, nullptr, nullptr);
  }

  void add_heightfield(dSpaceID space, dReal size) {
    heights_.assign(std::size_t{kSamples} * kSamples, 0);
    field_ = dGeomHeightfieldDataCreate();
    dGeomHeightfieldDataBuildDouble(field_, heights_.data(), 0, 2 * size, 2 * size, kSamples, kSamples, 1, 0, size, 0);
    const dGeomID geom = dCreateHeightfield(space, field_, 1);
    dMatrix3 upright;  // a heightfield's up is y
    dRFromAxisAndAngle(upright, 1, 0, 0, static_cast<dReal>(M_PI_2));
    dGeomSetRotation(geom, upright);
  }

  std::vector<float> vertices_;
  std::vector<dTriIndex> triangles_;
  std::vector<double> heights_;
  dTriMeshDataID mesh_ = nullptr;
  dHeightfieldDataID field_ = nullptr;
};

/// Everything of one drop, in the order in which it has to be destroyed.
class Scene {
 public:
  explicit Scene(const Row& row) : row_(row), floor_(row.floor, space_, kFloorSize * row.half_height) {
    dWorldSetGravity(world_, 0, 0, static_cast<dReal>(-kGravity));
    dWorldSetAutoDisableFlag(world_, 1);
    if (row.correcting_velocity > 0) dWorldSetContactMaxCorrectingVel(world_, static_cast<dReal>(row.correcting_velocity));
    const auto c = static_cast<dReal>(row.half_height);
    dMass mass;
    dGeomID geom = nullptr;
    if (row.exponent > 0) {
      geom =
          snCreateSuperellipsoid(space_, 2 * c, c * 14 / 10, c, static_cast<dReal>(row.exponent), static_cast<dReal>(row.exponent));
      if (geom == nullptr || snMassSet(&mass, static_cast<dReal>(kDensity), geom) == 0) throw std::runtime_error(snLastError());
    } else {
      geom = dCreateBox(space_, 4 * c, c * 28 / 10, 2 * c);
      dMassSetBox(&mass, static_cast<dReal>(kDensity), 4 * c, c * 28 / 10, 2 * c);
    }
    body_ = dBodyCreate(world_);
    dBodySetMass(body_, &mass);
    dGeomSetBody(geom, body_);
  }
  ~Scene() {
    dJointGroupDestroy(joints_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }
  Scene(const Scene&) = delete;
  Scene(Scene&&) = delete;
  Scene& operator=(const Scene&) = delete;
  Scene& operator=(Scene&&) = delete;

  dBodyID body() const { return body_; }

  void step(int number) {
    dSpaceCollide(space_, this, near_callback);
    dRandSetSeed(static_cast<unsigned long>(number));
    dWorldQuickStep(world_, static_cast<dReal>(row_.step));
    dJointGroupEmpty(joints_);
  }

 private:
  static void near_callback(void* self, dGeomID o1, dGeomID o2) {
    const Scene& scene = *static_cast<Scene*>(self);
    std::array<dContact, kMostRoom> found;
    const int count = dCollide(o1, o2, scene.row_.room, &found[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      dContact& contact = found[static_cast<std::size_t>(i)];
      contact.surface.mode = dContactApprox1;
      contact.surface.mu = static_cast<dReal>(0.5);
      dJointAttach(dJointCreateContact(scene.world_, scene.joints_, &contact), dGeomGetBody(o1), dGeomGetBody(o2));
    }
  }

  Row row_;
  dWorldID world_ = dWorldCreate();
  dSpaceID space_ = dSimpleSpaceCreate(nullptr);
  dJointGroupID joints_ = dJointGroupCreate(0);
  Floor floor_;
  dBodyID body_ = nullptr;
};

}  // namespace

Rest drop(const Row& row, const Attitudes& attitudes, int number) {
  Scene scene(row);
  const dBodyID body = scene.body();
  dBodySetPosition(body, 0, 0, static_cast<dReal>(3 * row.half_height));
  const double direction = kGoldenAngle * (number + kDrops * attitudes.draw);
  const double tilt = kLeastTilt + (attitudes.largest_tilt - kLeastTilt) * number / (kDrops - 1);
  dMatrix3 attitude;
  dRFromAxisAndAngle(attitude, static_cast<dReal>(std::cos(direction)), static_cast<dReal>(std::sin(direction)), 0,
                     static_cast<dReal>(tilt * M_PI / 180));
  dBodySetRotation(body, attitude);
  int step = 0;
  while (step * row.step < kLongest && dBodyIsEnabled(body) != 0) scene.step(++step);
  return {dBodyIsEnabled(body) == 0, step * row.step, double{dBodyGetPosition(body)[2]} / row.half_height};
}

}  // namespace resting
