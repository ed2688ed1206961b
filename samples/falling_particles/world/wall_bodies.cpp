#include "wall_bodies.hpp"

#include <supernormal/supernormal.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "common/interval.hpp"
#include "driven_body.hpp"
#include "grain.hpp"
#include "model/wall.hpp"

namespace falling_particles {
namespace {

static_assert(sizeof(unsigned int) == sizeof(dTriIndex));

/// The rotation of a ground into the frame of ODE's heightfields, which extend along x and z with y upwards. Then z points along
/// the -y of the wall.
Eigen::Quaterniond upright() { return Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3::UnitX())); }

/// The heights in the order of ODE, from the highest y on.
std::vector<double> rows_along_z(const GroundShape& ground) {
  std::vector<double> heights;
  heights.reserve(ground.heights.size());
  for (std::size_t row = ground.samples; row-- > 0;) {
    const auto first = ground.heights.begin() + static_cast<std::ptrdiff_t>(row * ground.samples);
    heights.insert(heights.end(), first, first + static_cast<std::ptrdiff_t>(ground.samples));
  }
  return heights;
}

}  // namespace

WallPose WallBodies::Entry::wall_pose() const { return driven == nullptr ? pose : driven->pose_on(pose); }

WallVelocity WallBodies::Entry::wall_velocity() const { return driven == nullptr ? velocity : driven->velocity_on(pose, velocity); }

WallBodies::WallBodies(dWorldID world, const std::vector<Wall>& walls, double step, unsigned long category_bits,
                       unsigned long collide_bits, supernormal::ode::Stepper* stepper)
    : world_(world), step_(step) {
  entries_.reserve(walls.size());
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const Wall& wall = walls[i];
    Entry& entry = entries_.emplace_back();
    entry.pose = entry.next = wall.start;
    entry.wall = &wall;
    entry.geom = create_geom(wall.shape);
    entry.material = material_of_wall(walls, i);
    dGeomSetCategoryBits(entry.geom, category_bits);
    dGeomSetCollideBits(entry.geom, collide_bits);
    geoms_.push_back(entry.geom);
    index_of_[entry.geom] = i;
    place(entry);
    if (!wall.moves()) continue;
    entry.carrier = create_wall_body(world);
    dBodySetKinematic(entry.carrier);
    set_pose(entry.carrier, entry.pose);
    dBodyDisable(entry.carrier);
    if (stepper != nullptr) stepper->add_body(entry.carrier);
    if (wall.drive) entry.driven = std::make_unique<DrivenBody>(world, entry.carrier, wall, step);
    if (!wall.flight) continue;
    entry.flying = std::make_unique<FlyingBody>(world, wall, step, stepper != nullptr);
    if (stepper != nullptr) stepper->add_body(entry.flying->id());
    if (wall.flight->from == 0) entry.velocity = mean_velocity(entry.pose, entry.flying->next(entry.pose, step), step);
  }
}

WallBodies::~WallBodies() {
  for (Entry& entry : entries_) {
    entry.driven.reset();
    entry.flying.reset();
    if (entry.carrier != nullptr) dBodyDestroy(entry.carrier);
    dGeomDestroy(entry.geom);
  }
  for (const dTriMeshDataID data : mesh_data_) dGeomTriMeshDataDestroy(data);
  for (const dHeightfieldDataID data : ground_data_) dGeomHeightfieldDataDestroy(data);
}

const WallBodies::Entry* WallBodies::find(dGeomID geom) const {
  const auto found = index_of_.find(geom);
  return found == index_of_.end() ? nullptr : &entries_[found->second];
}

const Wall* WallBodies::wall_of(dGeomID geom) const {
  const Entry* entry = find(geom);
  return entry == nullptr ? nullptr : entry->wall;
}

bool WallBodies::has_lid() const {
  return std::ranges::any_of(entries_, [](const Entry& entry) { return entry.wall->role == WallRole::Lid && entry.is_present; });
}

void WallBodies::remove_lid() {
  for (Entry& entry : entries_) {
    if (entry.wall->role != WallRole::Lid) continue;
    std::erase(geoms_, entry.geom);
    entry.is_present = false;
  }
}

dGeomID WallBodies::create_geom(const WallShape& shape) {
  if (std::holds_alternative<PlaneShape>(shape)) return dCreatePlane(nullptr, 0, 0, 1, 0);
  if (const auto* box = std::get_if<BoxShape>(&shape)) return dCreateBox(nullptr, box->size.x(), box->size.y(), box->size.z());
  if (const auto* cylinder = std::get_if<CylinderShape>(&shape))
    return dCreateCylinder(nullptr, cylinder->radius, cylinder->length);
  if (const auto* smooth = std::get_if<SmoothShape>(&shape)) {
    const Vector3& a = smooth->half_axes;
    const dGeomID geom =
        snCreateSuperovoid(nullptr, a.x(), a.y(), a.z(), smooth->delta, smooth->epsilon, smooth->taper_x, smooth->taper_y);
    if (geom == nullptr) throw std::runtime_error(snLastError());
    return geom;
  }
  if (const auto* ground = std::get_if<GroundShape>(&shape)) return create_geom(*ground);
  return create_geom(std::get<MeshShape>(shape));
}

dGeomID WallBodies::create_geom(const GroundShape& ground) {
  constexpr int kCopy = 1;
  constexpr int kNoWrap = 0;
  constexpr double kThickness = 0;  // m, below the lowest sample
  const int samples = static_cast<int>(ground.samples);
  const auto [dx, dy] = ground.spacing;
  const dHeightfieldDataID data = ground_data_.emplace_back(dGeomHeightfieldDataCreate());
  dGeomHeightfieldDataBuildDouble(data, rows_along_z(ground).data(), kCopy, (samples - 1) * dx, (samples - 1) * dy, samples,
                                  samples, 1, 0, kThickness, kNoWrap);
  return dCreateHeightfield(nullptr, data, 1);
}

dGeomID WallBodies::create_geom(const MeshShape& mesh) {
  const TwoSidedMesh* const sheets =
      mesh.two_sided ? two_sided_.emplace_back(std::make_unique<const TwoSidedMesh>(mesh)).get() : nullptr;
  const auto& triangles = sheets == nullptr ? mesh.triangles : sheets->triangles();
  const dTriMeshDataID data = mesh_data_.emplace_back(dGeomTriMeshDataCreate());
  dGeomTriMeshDataBuildSingle(data, mesh.vertices.data(), sizeof(mesh.vertices[0]), static_cast<int>(mesh.vertices.size()),
                              triangles.data(), static_cast<int>(3 * triangles.size()), sizeof(triangles[0]));
  const dGeomID geom = dCreateTriMesh(nullptr, data, nullptr, nullptr, nullptr);
  if (sheets != nullptr) sheets->attach(geom);
  return geom;
}

const WallBodies::Entry& WallBodies::named(const std::string& name) const {
  return *std::ranges::find(entries_, name, [](const Entry& entry) { return entry.wall->name; });
}

FacingFaces WallBodies::faces_between(const FacingWalls& pair) const {
  const Entry& first = named(pair[0]);
  const Entry& second = named(pair[1]);
  const auto faces = facing_faces(first.wall->shape, first.wall_pose(), second.wall->shape, second.wall_pose());
  if (faces && faces->distance() > 0) return *faces;
  throw std::runtime_error("walls \"" + pair[0] + "\" and \"" + pair[1] +
                           R"(", which a key "between" names, no longer face each other, or have met, after )" +
                           rounded(static_cast<double>(steps_) * step_) +
                           " s; travel of a drive or until of a motion would keep them apart");
}

double WallBodies::area_of(const Entry& entry) const {
  if (!entry.wall->drive->servo) return 0;
  const Servo& servo = *entry.wall->drive->servo;
  double area = servo.between.empty() ? servo.area : 1;
  for (const FacingWalls& pair : servo.between) area *= faces_between(pair).distance();
  return area;
}

void WallBodies::before_step(double done) {
  done_ = done;
  const double now = static_cast<double>(steps_) * step_ + done;
  const double then = static_cast<double>(steps_ + 1) * step_;
  for (Entry& entry : entries_) {
    if (entry.carrier == nullptr) continue;
    if (entry.flying != nullptr) {
      prepare_flight(entry, now, then);
      continue;
    }
    const std::span<const WallMotion> motions = entry.wall->motions;
    entry.next = pose_at(entry.wall->start, motions, then);
    entry.velocity = mean_velocity(entry.pose, entry.next, step_ - done);
    find_excess(entry, now, then);
    WallVelocity surface = conveyor_velocity(entry.wall->start, entry.pose, motions, now, then);
    surface.linear += entry.velocity.linear;
    surface.angular += entry.velocity.angular;
    set_velocity(entry.carrier, surface);
    entry.is_moving = !surface.is_zero();
    if (entry.driven != nullptr) {
      entry.area = area_of(entry);
      entry.driven->push(entry.pose, now, entry.area);
      entry.is_moving = entry.is_moving || !entry.driven->is_held();
    }
    entry.is_moving ? dBodyEnable(entry.carrier) : dBodyDisable(entry.carrier);
  }
}

// The end of the step is unknown, as that of a driven turn below.
void WallBodies::prepare_flight(Entry& entry, double now, double then) const {
  FlyingBody& body = *entry.flying;
  body.before_step(now);
  entry.is_moving = !body.is_held();
  if (!entry.is_moving) return;
  const WallPose from = body.centred(entry.pose);
  entry.lever_base = from.position;
  entry.excess =
      falling_particles::chord_excess(entry.wall->start, from, body.centred(body.next(entry.pose, step_ - done_)), {}, now, then);
}

void WallBodies::fly(Entry& entry, double time) {
  const WallPose next = entry.flying->read(entry.pose);
  entry.velocity = mean_velocity(entry.pose, next, time);
  set_velocity(entry.carrier, entry.velocity);
  entry.pose = next;
}

// The end of a driven turn is unknown before the step. With the speed of the step before, the excess is exact to first order.
void WallBodies::find_excess(Entry& entry, double now, double then) const {
  const bool turns = entry.driven != nullptr && entry.wall->drive->turns();
  const WallPose from = turns ? entry.driven->pose_on(entry.pose) : entry.pose;
  const WallPose to = turns ? entry.driven->next_on(entry.next) : entry.next;
  entry.lever_base = from.position;
  entry.excess = falling_particles::chord_excess(entry.wall->start, from, to, entry.wall->motions, now, then);
}

void WallBodies::after_step(double done) {
  const bool is_over = done == step_;
  const double now = static_cast<double>(steps_) * step_ + done;
  if (is_over) ++steps_;
  for (Entry& entry : entries_) {
    if (entry.carrier == nullptr || !(entry.is_moving || entry.driven != nullptr)) continue;
    if (entry.flying != nullptr) {
      fly(entry, done - done_);
    } else {
      if (entry.driven != nullptr) entry.driven->read(entry.pose, entry.velocity);
      entry.pose = is_over ? entry.next : pose_at(entry.wall->start, entry.wall->motions, now);
    }
    put(entry);
  }
}

void WallBodies::put(const Entry& entry) {
  set_pose(entry.carrier, entry.pose);
  if (entry.driven != nullptr) entry.driven->put(entry.pose, entry.velocity);
  if (entry.flying != nullptr) entry.flying->put(entry.pose);
  place(entry);
}

void WallBodies::place(const Entry& entry) {
  WallPose pose = entry.wall_pose();
  if (const auto* plane = std::get_if<PlaneShape>(&entry.wall->shape)) {
    const Vector3 normal = pose.rotation * plane->normal;
    dGeomPlaneSetParams(entry.geom, normal.x(), normal.y(), normal.z(), normal.dot(pose.position));
    return;
  }
  if (std::holds_alternative<GroundShape>(entry.wall->shape)) pose.rotation = pose.rotation * upright();
  dGeomSetPosition(entry.geom, pose.position.x(), pose.position.y(), pose.position.z());
  const dQuaternion q = {pose.rotation.w(), pose.rotation.x(), pose.rotation.y(), pose.rotation.z()};
  dGeomSetQuaternion(entry.geom, q);
}

bool WallBodies::is_moving(dGeomID geom) const {
  const Entry* entry = find(geom);
  return entry != nullptr && entry->is_moving;
}

supernormal::effects::Side WallBodies::side_of(dGeomID geom) const {
  const Entry* entry = find(geom);
  if (entry == nullptr) return {kWallMaterial, dGeomGetBody(geom)};
  dBodyID body = entry->carrier;
  if (entry->driven != nullptr && !entry->driven->is_held()) body = entry->driven->id();
  if (entry->flies()) body = entry->flying->id();
  return {entry->material, entry->is_moving ? body : nullptr};
}

Vector3 WallBodies::chord_excess(dGeomID geom, const Vector3& centre, const Vector3& velocity) const {
  const Entry* entry = find(geom);
  if (entry == nullptr || !entry->excess) return Vector3::Zero();
  return entry->excess->at(centre - entry->lever_base, velocity);
}

// The carrier keeps the velocity of its surface until the next step, while the poses are already those after this one.
Vector3 WallBodies::surface_velocity(dGeomID geom, const Vector3& point, const Vector3& centre, const Vector3& velocity) const {
  const Entry* entry = find(geom);
  if (entry == nullptr || entry->carrier == nullptr || !entry->is_moving) return Vector3::Zero();
  const WallPose before{entry->pose.position - step_ * entry->velocity.linear, entry->pose.rotation};
  Vector3 surface =
      to_vector(dBodyGetLinearVel(entry->carrier)) + to_vector(dBodyGetAngularVel(entry->carrier)).cross(point - before.position);
  if (entry->driven != nullptr) {
    const WallVelocity drive = entry->driven->velocity_on(before, {});
    surface += drive.linear + drive.angular.cross(point - entry->driven->pose_on(before).position);
  }
  return surface + chord_excess(geom, centre, velocity);
}

WallState WallBodies::state(std::size_t index) const { return {entries_[index].wall_pose(), entries_[index].wall_velocity()}; }

const DrivenState* WallBodies::driven(std::size_t index) const {
  return entries_[index].driven == nullptr ? nullptr : &entries_[index].driven->state();
}

int WallBodies::rows() const {
  int rows = 0;
  for (const Entry& entry : entries_) rows += entry.driven == nullptr ? 0 : entry.driven->rows();
  return rows;
}

const FlightState* WallBodies::flying(std::size_t index) const {
  return entries_[index].flying == nullptr ? nullptr : &entries_[index].flying->state();
}

std::vector<std::pair<dGeomID, dGeomID>> WallBodies::pairs_of_free() const {
  std::vector<std::pair<dGeomID, dGeomID>> pairs;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (!entries_[i].flies()) continue;
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      const Entry& other = entries_[k];
      const bool is_named = other.flies() && k <= i;
      if (!is_named && other.is_present && meet(aabb_of(entries_[i].geom), aabb_of(other.geom)))
        pairs.emplace_back(entries_[i].geom, other.geom);
    }
  }
  return pairs;
}

std::optional<double> WallBodies::servo_stress(std::size_t index) const {
  const Entry& entry = entries_[index];
  if (entry.driven == nullptr || !entry.wall->drive->servo || entry.driven->is_held()) return std::nullopt;
  return entry.driven->state().load / entry.area;
}

WallsState WallBodies::save() const {
  WallsState state{steps_, {}};
  for (const Entry& entry : entries_) {
    if (entry.carrier == nullptr) continue;
    WallsState::OfWall& saved = state.walls.emplace_back(WallsState::OfWall{entry.pose, entry.velocity});
    if (entry.driven != nullptr) saved.driven = entry.driven->state();
    if (entry.flying != nullptr) saved.flight = entry.flying->state();
  }
  return state;
}

void WallBodies::restore(const WallsState& state) {
  steps_ = state.steps;
  auto next = state.walls.begin();
  for (Entry& entry : entries_) {
    if (entry.carrier == nullptr) continue;
    const WallsState::OfWall& saved = *next++;
    entry.pose = saved.pose;
    entry.velocity = saved.velocity;
    if (entry.driven != nullptr) entry.driven->restore(saved.driven);
    if (entry.flying != nullptr) entry.flying->restore(saved.flight);
    put(entry);
  }
}

}  // namespace falling_particles
