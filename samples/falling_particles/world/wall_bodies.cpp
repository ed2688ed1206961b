#include "wall_bodies.hpp"

#include <supernormal/supernormal.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "model/material.hpp"
#include "to_vector.hpp"

namespace falling_particles {
namespace {

void set_velocity(dBodyID body, const WallVelocity& velocity) {
  dBodySetLinearVel(body, velocity.linear.x(), velocity.linear.y(), velocity.linear.z());
  dBodySetAngularVel(body, velocity.angular.x(), velocity.angular.y(), velocity.angular.z());
}

void set_pose(dBodyID body, const WallPose& pose) {
  dBodySetPosition(body, pose.position.x(), pose.position.y(), pose.position.z());
  const dQuaternion q = {pose.rotation.w(), pose.rotation.x(), pose.rotation.y(), pose.rotation.z()};
  dBodySetQuaternion(body, q);
}

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

/// A body without automatic sleep and without damping.
dBodyID create_body(dWorldID world) {
  const dBodyID body = dBodyCreate(world);
  dBodySetAutoDisableFlag(body, 0);
  dBodySetLinearDamping(body, 0);
  dBodySetAngularDamping(body, 0);
  return body;
}

}  // namespace

WallPose WallBodies::Entry::wall_pose() const {
  WallPose moved = pose;
  if (driven != nullptr) moved.position += position * axis();
  return moved;
}

WallVelocity WallBodies::Entry::wall_velocity() const {
  WallVelocity moved = velocity;
  if (driven != nullptr) moved.linear += speed * axis() + velocity.angular.cross(position * axis());
  return moved;
}

Vector3 WallBodies::Entry::axis() const { return pose.rotation * wall->start.rotation.conjugate() * wall->drive->axis; }

WallBodies::WallBodies(dWorldID world, const std::vector<Wall>& walls, double step, unsigned long category_bits,
                       unsigned long collide_bits)
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
    entry.carrier = create_body(world);
    dBodySetKinematic(entry.carrier);
    set_pose(entry.carrier, entry.pose);
    dBodyDisable(entry.carrier);
    if (wall.drive) add_drive(entry, *wall.drive);
  }
}

WallBodies::~WallBodies() {
  for (const Entry& entry : entries_) {
    if (entry.slider != nullptr) dJointDestroy(entry.slider);
    if (entry.driven != nullptr) dBodyDestroy(entry.driven);
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

void WallBodies::add_drive(Entry& entry, const Drive& drive) {
  entry.driven = create_body(world_);
  // The joint prevents all rotation. A body with a large inertia hardly rotates by itself, and leaves less work to the solver. In
  // shear_cell.toml the final overlap of grains is 5.7 % of the smallest half-axis. With an inertia of m r^2 it is 7.0 %.
  constexpr double kHeavy = 1e3;
  const double radius = bounding_radius(entry.wall->shape);
  const double inertia = kHeavy * drive.mass * (std::isfinite(radius) ? radius * radius : 1);
  dMass mass;
  dMassSetParameters(&mass, drive.mass, 0, 0, 0, inertia, inertia, inertia, 0, 0, 0);
  dBodySetMass(entry.driven, &mass);
  set_pose(entry.driven, entry.pose);
  entry.slider = dJointCreateSlider(world_, nullptr);
  dJointAttach(entry.slider, entry.driven, entry.carrier);
  dJointSetSliderAxis(entry.slider, drive.axis.x(), drive.axis.y(), drive.axis.z());
  if (std::isfinite(drive.travel[0])) dJointSetSliderParam(entry.slider, dParamLoStop, drive.travel[0]);
  if (std::isfinite(drive.travel[1])) dJointSetSliderParam(entry.slider, dParamHiStop, drive.travel[1]);
}

void WallBodies::before_step() {
  const double now = static_cast<double>(steps_) * step_;
  const double then = static_cast<double>(steps_ + 1) * step_;
  for (Entry& entry : entries_) {
    if (entry.carrier == nullptr) continue;
    const std::span<const WallMotion> motions = entry.wall->motions;
    entry.next = pose_at(entry.wall->start, motions, then);
    entry.velocity = mean_velocity(entry.pose, entry.next, step_);
    entry.excess = falling_particles::chord_excess(entry.wall->start, entry.pose, entry.next, motions, now, then);
    WallVelocity surface = conveyor_velocity(entry.wall->start, entry.pose, motions, now, then);
    surface.linear += entry.velocity.linear;
    surface.angular += entry.velocity.angular;
    set_velocity(entry.carrier, surface);
    entry.is_moving = !surface.is_zero();
    if (entry.driven != nullptr) push(entry, now);
    entry.is_moving ? dBodyEnable(entry.carrier) : dBodyDisable(entry.carrier);
  }
}

// Damping is implicit in the velocity, so that it never reverses a velocity, whatever the step.
void WallBodies::push(Entry& entry, double now) {
  const Drive& drive = *entry.wall->drive;
  const double slack = 1e-6 * step_;  // times of steps are rounded
  entry.is_held = now + slack < drive.from;
  if (entry.is_held) return;
  entry.is_moving = true;
  dBodyEnable(entry.driven);
  const double push = now + slack < drive.until ? drive.force : 0;
  const double brake = drive.damping * entry.speed / (1 + step_ * drive.damping / drive.mass);
  const Vector3 force = (push - brake) * entry.axis();
  dBodyAddForce(entry.driven, force.x(), force.y(), force.z());
}

void WallBodies::after_step() {
  ++steps_;
  for (Entry& entry : entries_) {
    if (entry.carrier == nullptr || !(entry.is_moving || entry.driven != nullptr)) continue;
    if (entry.driven != nullptr) slide(entry);
    entry.pose = entry.next;
    put(entry);
  }
}

void WallBodies::put(const Entry& entry) {
  set_pose(entry.carrier, entry.pose);
  if (entry.driven != nullptr) {
    set_pose(entry.driven, entry.wall_pose());
    set_velocity(entry.driven, entry.wall_velocity());
  }
  place(entry);
}

// The solver's residual motion across the axis is discarded: the wall stays on its axis and does not tilt.
void WallBodies::slide(Entry& entry) {
  if (entry.is_held) return;
  const Vector3 axis = entry.axis();
  const Vector3 lever = to_vector(dBodyGetPosition(entry.driven)) - to_vector(dBodyGetPosition(entry.carrier));
  entry.position = axis.dot(lever);
  entry.speed = axis.dot(to_vector(dBodyGetLinearVel(entry.driven)) - entry.velocity.linear);
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
  const dBodyID body = entry->driven != nullptr && !entry->is_held ? entry->driven : entry->carrier;
  return {entry->material, entry->is_moving ? body : nullptr};
}

Vector3 WallBodies::chord_excess(dGeomID geom, const Vector3& centre, const Vector3& velocity) const {
  const Entry* entry = find(geom);
  if (entry == nullptr || !entry->excess) return Vector3::Zero();
  return entry->excess->at(centre - entry->pose.position, velocity);
}

// The carrier keeps the velocity of its surface until the next step, while the poses are already those after this one.
Vector3 WallBodies::surface_velocity(dGeomID geom, const Vector3& point, const Vector3& centre, const Vector3& velocity) const {
  const Entry* entry = find(geom);
  if (entry == nullptr || entry->carrier == nullptr || !entry->is_moving) return Vector3::Zero();
  const Vector3 before = entry->pose.position - step_ * entry->velocity.linear;
  const Vector3 spin = to_vector(dBodyGetAngularVel(entry->carrier));
  Vector3 surface = to_vector(dBodyGetLinearVel(entry->carrier)) + spin.cross(point - before);
  if (entry->driven != nullptr) surface += entry->speed * entry->axis();
  if (entry->excess) surface += entry->excess->at(centre - before, velocity);
  return surface;
}

WallState WallBodies::state(std::size_t index) const { return {entries_[index].wall_pose(), entries_[index].wall_velocity()}; }

WallsState WallBodies::save() const {
  WallsState state{steps_, {}};
  for (const Entry& entry : entries_) {
    if (entry.carrier != nullptr) state.walls.push_back({entry.pose, entry.velocity, entry.position, entry.speed});
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
    entry.position = saved.position;
    entry.speed = saved.speed;
    put(entry);
  }
}

}  // namespace falling_particles
