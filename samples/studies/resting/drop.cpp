#include "drop.hpp"

#include <supernormal/supernormal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/ode_world.hpp"

namespace resting {
namespace {

constexpr double kLongest = 10;       // s
constexpr double kFloorSize = 40;     // half-heights, from the middle to the border
constexpr double kLeastTilt = 1;      // degrees
constexpr double kGoldenAngle = 2.4;  // rad; no two drops have the same axis of tilt
constexpr int kSamples = 9;           // samples of the heightfield along each side

constexpr double kGravity = 9.81;  // m/s^2
constexpr int kMostRoom = 8;       // contacts

/// A world set up as in a first program with ODE: its defaults, gravity along -z, auto-disable, and Coulomb friction of 0.5 between
/// all surfaces.
class World {
 public:
  /// `space` is destroyed with the world. `step`: s. `room`: max_contacts, 1 to 8. With `looks_ahead` the bodies of Supernormal
  /// have contacts before they overlap.
  World(dSpaceID space, double step, int room, bool looks_ahead)
      : world_(space), step_(step), room_(room), looks_ahead_(looks_ahead) {
    dWorldSetGravity(id(), 0, 0, static_cast<dReal>(-kGravity));
    dWorldSetAutoDisableFlag(id(), 1);
  }

  dWorldID id() const { return world_.id(); }
  dSpaceID space() const { return world_.space(); }

  /// Adds a body of this mass with the geom, which must be in the space.
  dBodyID add(dGeomID geom, const dMass& mass) {
    const dBodyID body = world_.add(geom, mass);
    if (looks_ahead_ && dGeomGetClass(geom) == snGeomClass()) snGeomSetLookAhead(geom, static_cast<dReal>(step_));
    return body;
  }

  /// Makes a step. `number` seeds quickstep's order of rows, so a run repeats.
  void step(int number) {
    world_.collide([this](dGeomID o1, dGeomID o2) { add_contacts(o1, o2); });
    dRandSetSeed(static_cast<unsigned long>(number));
    world_.step(step_);
  }

 private:
  void add_contacts(dGeomID o1, dGeomID o2) {
    std::array<dContact, kMostRoom> found;
    const int count = dCollide(o1, o2, room_, &found[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      dContact& contact = found[static_cast<std::size_t>(i)];
      contact.surface.mode = dContactApprox1;
      contact.surface.mu = static_cast<dReal>(0.5);
      snContactLookAhead(&contact, static_cast<dReal>(step_));
      world_.join(contact);
    }
  }

  common::OdeWorld world_;
  double step_;
  int room_;
  bool looks_ahead_;
};

/// The floor with its top at z = 0. ODE refers to the arrays of a mesh or a heightfield as long as the geom lives.
class Floor {
 public:
  Floor() = default;
  ~Floor() {
    if (mesh_ != nullptr) dGeomTriMeshDataDestroy(mesh_);
    if (field_ != nullptr) dGeomHeightfieldDataDestroy(field_);
  }
  Floor(const Floor&) = delete;
  Floor& operator=(const Floor&) = delete;

  /// `size` is the distance from the middle to the border, m.
  void lay(FloorKind kind, dSpaceID space, double size) {
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

}  // namespace

Rest drop(const Row& row, const Orientations& orientations, int number) {
  Floor floor;  // must outlive the geom that refers to it
  World world(dSimpleSpaceCreate(nullptr), row.step, row.room, row.looks_ahead);
  floor.lay(row.floor, world.space(), kFloorSize * row.half_height);
  if (row.correcting_velocity > 0) dWorldSetContactMaxCorrectingVel(world.id(), static_cast<dReal>(row.correcting_velocity));
  dMass mass;
  const dGeomID geom = row.exponent > 0 ? create_body(world.space(), row.kind, row.exponent, row.half_height, mass)
                                        : create_counterpart(world.space(), row.kind, row.half_height, mass);
  const dBodyID body = world.add(geom, mass);
  dBodySetPosition(body, 0, 0, static_cast<dReal>(3 * row.half_height));
  const double direction = kGoldenAngle * (number + kDrops * orientations.draw);
  const double tilt = kLeastTilt + (orientations.largest_tilt - kLeastTilt) * number / (kDrops - 1);
  dQuaternion tilted;
  dQuaternion on_its_side;
  dQuaternion orientation;
  dQFromAxisAndAngle(tilted, static_cast<dReal>(std::cos(direction)), static_cast<dReal>(std::sin(direction)), 0,
                     static_cast<dReal>(tilt * std::numbers::pi / 180));
  dQFromAxisAndAngle(on_its_side, 0, 1, 0, row.kind.lies_on_its_side() ? static_cast<dReal>(M_PI_2) : 0);
  dQMultiply0(orientation, tilted, on_its_side);
  dBodySetQuaternion(body, orientation);
  // A long body far from level would start in the floor, which would throw it beyond its border.
  const double above_floor = 3 * row.half_height - std::min(0.0, lowest_point(geom));
  dBodySetPosition(body, 0, 0, static_cast<dReal>(above_floor));
  int step = 0;
  while (step * row.step < kLongest && dBodyIsEnabled(body) != 0) world.step(++step);
  return {dBodyIsEnabled(body) == 0, step * row.step, double{dBodyGetPosition(body)[2]} / row.half_height,
          lowest_point(geom) / row.half_height};
}

}  // namespace resting
