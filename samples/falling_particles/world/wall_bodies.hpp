// The parts of a scene in a world of ODE.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <optional>
#include <span>
#include <supernormal/effects.hpp>
#include <unordered_map>
#include <vector>

#include "model/two_sided_mesh.hpp"
#include "model/wall.hpp"

namespace falling_particles {

/// Where a part is and how it moves.
struct WallState {
  WallPose pose;
  WallVelocity velocity;  ///< mean of the last step, without that of a conveyor's surface
};

/// What time alone does not tell of the parts between two steps.
struct WallsState {
  struct OfWall {
    WallPose pose;               ///< of the carrier
    WallVelocity velocity = {};  ///< of the carrier, in the last step
    double position = 0;         ///< m, of a driven part along its axis
    double speed = 0;            ///< m/s

    template <typename Archive>
    void serialize(Archive& archive) {
      archive(pose, velocity, position, speed);
    }
  };
  long steps = 0;
  std::vector<OfWall> walls;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(steps, walls);
  }
};

/// The geoms of the parts, and bodies that give contacts their velocities. The geoms have no bodies, since ODE's planes can have
/// none: a part that moves has a kinematic body beside its geom, with the mean velocity of the step, and is set to its exact pose
/// after it. A driven part has a body with mass on a slider joint to its kinematic one.
class WallBodies {
 public:
  /// The parts must outlive this object, and the world too. The geoms collide with those that have a bit of `collide_bits`, and
  /// have `category_bits`. `step`: s. Throws std::runtime_error when the library refuses a shape.
  WallBodies(dWorldID world, const std::vector<Wall>& walls, double step, unsigned long category_bits, unsigned long collide_bits);
  ~WallBodies();
  WallBodies(const WallBodies&) = delete;
  WallBodies& operator=(const WallBodies&) = delete;

  const std::vector<dGeomID>& geoms() const { return geoms_; }  ///< in the order of the parts

  /// Gives the bodies their velocities; call it before the contacts of a step are looked for.
  void before_step();
  /// Puts the parts where they belong after the step.
  void after_step();

  /// Whether the geom is that of a part which moves, or whose surface moves, in this step.
  bool is_moving(dGeomID geom) const;
  /// The body of the part, 0 while it does not move, and its material; of any other geom its own body.
  supernormal::effects::Side side_of(dGeomID geom, supernormal::effects::Material otherwise) const;

  /// m/s; what a grain at `centre` (m) with this velocity (m/s) needs at its contacts with the part in this step besides the
  /// velocity of the part's body (ChordExcess); zero for a geom that is no part.
  Vector3 chord_excess(dGeomID geom, const Vector3& centre, const Vector3& velocity) const;

  const Wall& wall(std::size_t index) const { return *entries_[index].wall; }
  std::size_t count() const { return entries_.size(); }
  WallState state(std::size_t index) const;

  WallsState save() const;
  /// Goes on from a state of the same parts, in a world that has made no step.
  void restore(const WallsState& state);

 private:
  struct Entry {
    WallPose pose;                           // of the carrier
    WallPose next;                           // of the carrier, after the step
    WallVelocity velocity = {};              // of the carrier, in this step
    std::optional<ChordExcess> excess = {};  // in this step
    double position = 0;                     // m, of the driven body along its axis
    double speed = 0;                        // m/s
    const Wall* wall = nullptr;
    dGeomID geom = nullptr;
    dBodyID carrier = nullptr;  // kinematic; null for a part that stands
    dBodyID driven = nullptr;   // with mass; null for a part that is not driven
    dJointID slider = nullptr;
    supernormal::effects::Material material = 0;
    bool is_moving = false;
    bool is_held = true;

    WallPose wall_pose() const;          // with the way that the driven body has slid
    WallVelocity wall_velocity() const;  // with its speed; mean of the last step
    Vector3 axis() const;                // of the drive, in the world's frame
  };
  dGeomID create_geom(const WallShape& shape);
  dGeomID create_geom(const MeshShape& mesh);
  void add_drive(Entry& entry, const Drive& drive);
  void push(Entry& entry, double now);
  void slide(Entry& entry);
  static void put(const Entry& entry);
  static void place(const Entry& entry);

  dWorldID world_;
  double step_;
  long steps_ = 0;
  std::vector<Entry> entries_;
  std::vector<dGeomID> geoms_;
  std::unordered_map<dGeomID, std::size_t> index_of_;
  std::vector<dTriMeshDataID> mesh_data_;
  std::vector<std::unique_ptr<const TwoSidedMesh>> two_sided_;
};

}  // namespace falling_particles
