// The walls of a scene in an ODE world.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <optional>
#include <span>
#include <supernormal/effects.hpp>
#include <supernormal/stepper.hpp>
#include <unordered_map>
#include <utility>
#include <vector>

#include "driven_body.hpp"
#include "model/two_sided_mesh.hpp"
#include "model/wall.hpp"

namespace falling_particles {

/// The pose and velocity of a wall.
struct WallState {
  WallPose pose;
  WallVelocity velocity;  ///< mean of the last step, or of its last part, without the motion of a conveyor's surface
};

/// The state of the moving walls between two steps, as far as it is no function of time.
struct WallsState {
  struct OfWall {
    WallPose pose;               ///< of the carrier, or of a free wall
    WallVelocity velocity = {};  ///< of the carrier in the last step
    DrivenState driven = {};     ///< of a driven wall
    FlightState flight = {};     ///< of a free wall

    void serialize(auto& archive) { archive(pose, velocity, driven, flight); }
  };
  long steps = 0;
  std::vector<OfWall> walls;  ///< that move, in their order

  void serialize(auto& archive) { archive(steps, walls); }
};

/// The geoms of all walls of a scene, and the bodies that give contacts their velocities. The geoms have no bodies, since ODE's
/// planes can have none. They are in no space. A moving wall has a kinematic body beside its geom, with the mean velocity of the
/// step. After the step the geom and this body are set to the exact pose. A driven wall has a second body with mass, on a joint to
/// the kinematic body. A free wall has a second body without a joint, whose pose the kinematic body takes.
class WallBodies {
 public:
  /// The walls and the world must outlive this object. The geoms have `category_bits` and collide with geoms that have a bit of
  /// `collide_bits`. `step`: s. `stepper` gets the bodies; null for quickstep. Throws std::runtime_error when the library refuses a
  /// shape.
  WallBodies(dWorldID world, const std::vector<Wall>& walls, double step, unsigned long category_bits, unsigned long collide_bits,
             supernormal::ode::Stepper* stepper = nullptr);
  ~WallBodies();
  WallBodies(const WallBodies&) = delete;
  WallBodies& operator=(const WallBodies&) = delete;

  const std::vector<dGeomID>& geoms() const { return geoms_; }  ///< of the present walls, in their order
  /// The wall with this geom, also if it was removed; null if there is none.
  const Wall* wall_of(dGeomID geom) const;

  /// Whether a lid closes a hopper's outlet.
  bool has_lid() const;
  /// Removes the lid of a hopper's outlet, if there is one. Its geom stays valid for the contacts of the last step.
  void remove_lid();

  /// Sets the velocities of the bodies. Call it before the collision of a step, or of the rest of a step of which `done` (s) are
  /// over.
  void before_step(double done = 0);
  /// Moves the walls to their poses when `done` (s) of the step are over. Call it after the step, or after a part of it.
  void after_step(double done);

  /// Whether the geom belongs to a wall that moves, or whose surface moves, in this step.
  bool is_moving(dGeomID geom) const;
  /// The body and material of the wall with this geom. The body is null while the wall does not move. A mesh that is no wall has
  /// its own body, and the material that walls share.
  supernormal::effects::Side side_of(dGeomID geom) const;

  /// m/s; what a grain at `centre` (m) with `velocity` (m/s) needs at its contacts in this step besides the velocity of the wall's
  /// body (ChordExcess). Zero if the geom belongs to no wall.
  Vector3 chord_excess(dGeomID geom, const Vector3& centre, const Vector3& velocity) const;

  /// m/s, of the wall's surface at a contact of the last step, the motion of a conveyor included. `point` (m) is the contact;
  /// `centre` (m) and `velocity` (m/s) are of the grain, before and after the step. Zero if the geom belongs to no wall that moves.
  Vector3 surface_velocity(dGeomID geom, const Vector3& point, const Vector3& centre, const Vector3& velocity) const;

  const Wall& wall(std::size_t index) const { return *entries_[index].wall; }
  std::size_t count() const { return entries_.size(); }
  WallState state(std::size_t index) const;
  /// The pairs of a free wall, unless it is held in this step, and another wall, whose bounding boxes meet. Each pair is named
  /// once.
  std::vector<std::pair<dGeomID, dGeomID>> pairs_of_free() const;
  /// Null for a wall without a drive.
  const DrivenState* driven(std::size_t index) const;
  /// Of the solver in a step: of the joints of driven walls.
  int rows() const;
  /// Null for a wall that is not free.
  const FlightState* flying(std::size_t index) const;
  /// Pa, of the grains on a servo in the last step; empty for a wall that is none or was held.
  std::optional<double> servo_stress(std::size_t index) const;
  /// Of two walls that face each other. Throws std::runtime_error if they have met.
  FacingFaces faces_between(const FacingWalls& pair) const;

  WallsState save() const;
  /// Restores a state of the same walls in a world that has made no step.
  void restore(const WallsState& state);

 private:
  struct Entry {
    WallPose pose;                           // of the carrier
    WallPose next;                           // of the carrier at the end of the step
    WallVelocity velocity = {};              // of the carrier in this step
    std::optional<ChordExcess> excess = {};  // in this step
    Vector3 lever_base = Vector3::Zero();    // m, from which the levers of `excess` lead
    const Wall* wall = nullptr;
    dGeomID geom = nullptr;
    dBodyID carrier = nullptr;                     // kinematic; null for a wall that stands
    std::unique_ptr<DrivenBody> driven = nullptr;  // null for a wall that is not driven
    std::unique_ptr<FlyingBody> flying = nullptr;  // null for a wall that is not free
    double area = 0;                               // m^2, of a servo in this step
    supernormal::effects::Material material = 0;
    bool is_present = true;  // false for a removed lid
    bool is_moving = false;

    bool flies() const { return flying != nullptr && !flying->is_held(); }
    WallPose wall_pose() const;          // with the displacement of the driven body
    WallVelocity wall_velocity() const;  // with the speed of the driven body; mean of the last step
  };
  const Entry* find(dGeomID geom) const;
  dGeomID create_geom(const WallShape& shape);
  dGeomID create_geom(const MeshShape& mesh);
  dGeomID create_geom(const GroundShape& ground);
  const Entry& named(const std::string& name) const;
  double area_of(const Entry& entry) const;
  void find_excess(Entry& entry, double now, double then) const;
  void prepare_flight(Entry& entry, double now, double then) const;
  static void fly(Entry& entry, double time);
  static void put(const Entry& entry);
  static void place(const Entry& entry);

  dWorldID world_;
  double step_;
  double done_ = 0;  // s, of a step that has ended early
  long steps_ = 0;
  std::vector<Entry> entries_;
  std::vector<dGeomID> geoms_;
  std::unordered_map<dGeomID, std::size_t> index_of_;
  std::vector<dTriMeshDataID> mesh_data_;
  std::vector<dHeightfieldDataID> ground_data_;
  std::vector<std::unique_ptr<const TwoSidedMesh>> two_sided_;
};

}  // namespace falling_particles
