#include "drop.hpp"

#include <supernormal/supernormal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
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

constexpr dReal kDensity = 1000;  // kg/m^3

using HalfAxes = std::array<dReal, 3>;

/// m.
HalfAxes half_axes_of(const BodyKind& kind, double half_height) {
  HalfAxes a;
  std::ranges::transform(kind.half_axes, a.begin(), [&](double length) { return static_cast<dReal>(half_height * length); });
  return a;
}

/// m; half of the straight length. A pillow, whose section alone has the exponent, is straight along y.
dReal length_of(const BodyKind& kind, const HalfAxes& a) { return kind.has_delta ? a[1] : a[2]; }

/// A user-defined box and cylinder. Their functions get the half-axes as user data.
dReal box_support(const void* user, const dReal n[3]) {
  const auto& a = *static_cast<const HalfAxes*>(user);
  return a[0] * std::abs(n[0]) + a[1] * std::abs(n[1]) + a[2] * std::abs(n[2]);
}

void box_point(const void* user, const dReal n[3], dReal point[3]) {
  const auto& a = *static_cast<const HalfAxes*>(user);
  for (std::size_t k = 0; k < 3; ++k) point[k] = std::copysign(a[k], n[k]);
}

dReal cylinder_support(const void* user, const dReal n[3]) {
  const auto& a = *static_cast<const HalfAxes*>(user);
  return a[0] * std::hypot(n[0], n[1]) + a[2] * std::abs(n[2]);
}

void cylinder_point(const void* user, const dReal n[3], dReal point[3]) {
  const auto& a = *static_cast<const HalfAxes*>(user);
  const dReal across = std::hypot(n[0], n[1]);
  for (std::size_t k = 0; k < 2; ++k) point[k] = across > 0 ? a[0] * n[k] / across : 0;
  point[2] = std::copysign(a[2], n[2]);
}

void release_half_axes(void* user) { delete static_cast<HalfAxes*>(user); }

dGeomID create_user_shape(dSpaceID space, bool is_box, const HalfAxes& a) {
  const snShape shape{is_box ? box_support : cylinder_support, is_box ? box_point : cylinder_point, nullptr, new HalfAxes(a),
                      release_half_axes};
  return snCreateConvex(space, &shape);
}

dGeomID create_geom(dSpaceID space, const BodyKind& kind, double exponent, double half_height) {
  const HalfAxes a = half_axes_of(kind, half_height);
  if (!kind.has_exponent()) return create_user_shape(space, kind.is_box, a);
  const auto delta = static_cast<dReal>(kind.has_delta ? exponent : 2),
             epsilon = static_cast<dReal>(kind.has_epsilon ? exponent : 2);
  const auto taper = static_cast<dReal>(kind.taper), r = static_cast<dReal>(kind.rounding * half_height);
  if (taper != 0) return snCreateSuperovoid(space, a[0], a[1], a[2], delta, epsilon, taper, taper);
  const dGeomID geom = snCreateSuperellipsoid(space, a[0] - r, a[1] - r, a[2] - r, delta, epsilon);
  return geom != nullptr && r > 0 && snGeomSetRounding(geom, r) == 0 ? nullptr : geom;
}

void set_mass_of_counterpart(const BodyKind& kind, double half_height, dMass& mass) {
  const HalfAxes a = half_axes_of(kind, half_height);
  if (kind.is_box) {
    dMassSetBox(&mass, kDensity, 2 * a[0], 2 * a[1], 2 * a[2]);
  } else {
    dMassSetCylinder(&mass, kDensity, 3, a[0], 2 * length_of(kind, a));
  }
}

/// Makes a geom of Supernormal with its mass. `exponent` applies if the kind has one.
dGeomID create_body(dSpaceID space, const BodyKind& kind, double exponent, double half_height, dMass& mass) {
  const dGeomID geom = create_geom(space, kind, exponent, half_height);
  // The integrals over the normals miss the volume behind sharp faces, and the centre of mass of a cone is not at its origin.
  const bool is_counterparts = !kind.has_exponent() || kind.taper != 0;
  if (is_counterparts) set_mass_of_counterpart(kind, half_height, mass);
  if (geom == nullptr || (!is_counterparts && snMassSet(&mass, kDensity, geom) == 0)) throw std::runtime_error(snLastError());
  return geom;
}

/// Makes the dBox or dCylinder of the same size, with its mass.
dGeomID create_counterpart(dSpaceID space, const BodyKind& kind, double half_height, dMass& mass) {
  const HalfAxes a = half_axes_of(kind, half_height);
  set_mass_of_counterpart(kind, half_height, mass);
  return kind.is_box ? dCreateBox(space, 2 * a[0], 2 * a[1], 2 * a[2]) : dCreateCylinder(space, a[0], 2 * length_of(kind, a));
}

/// The height of the lowest point of a geom, m.
double lowest_point(dGeomID geom) {
  if (dGeomGetClass(geom) != snGeomClass()) {
    dReal aabb[6];
    dGeomGetAABB(geom, aabb);
    return double{aabb[4]};
  }
  const dVector3 down = {0, 0, -1};
  dVector3 point;
  if (snGeomSupport(geom, down, point) == 0) throw std::runtime_error(snLastError());
  return double{point[2]};
}

}  // namespace

const std::vector<BodyKind>& body_kinds() {
  static const std::vector<BodyKind> kinds = {
      {"brick", true, {2, 1.4, 1}, true, true},
      {"rounded_brick", true, {2, 1.4, 1}, true, true, 0.25},
      {"coin", false, {2, 2, 1}, false, true},
      {"can", false, {1, 1, 5}, false, true},
      {"short_can", false, {1, 1, 1}, false, true},
      {"pillow", false, {1, 3, 1}, true, false},
      {"rounded_can", false, {1, 1, 3}, false, true, 0.25},
      {"cone", false, {1, 1, 3}, false, true, 0, 0.3},
      {"user_brick", true, {2, 1.4, 1}},
      {"user_cylinder", false, {1, 1, 3}},
  };
  return kinds;
}

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
