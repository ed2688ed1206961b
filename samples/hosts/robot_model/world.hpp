// A scene in ODE.
#pragma once

#include <cstddef>
#include <vector>

#include "common/ode_world.hpp"
#include "scene.hpp"

namespace robot_model {

/// ODE as long as there is a world.
struct Ode {
  Ode() { dInitODE2(0); }
  ~Ode() {
    snClose();
    dCloseODE();
  }
  Ode(const Ode&) = delete;
  Ode& operator=(const Ode&) = delete;
};

/// Links that fixed joints connect are one body. So a fixed joint holds exactly, and a link without mass can be a frame.
class World {
 public:
  /// `density` in kg/m^3 is for links without <inertial>. Throws std::runtime_error with the file, the link or joint, the value and
  /// the valid range.
  World(const Scene& scene, double density);

  /// Steps until `seconds` in [0, 1e6] have passed, to the nearest step. Throws std::runtime_error otherwise, and if a body is 1e12
  /// m away or as fast.
  void simulate(double seconds);

  /// The present pose of a link in the world.
  Eigen::Isometry3d pose(std::size_t link) const;
  /// How far the origin of a link is above the first plane of the file, m; above z = 0 without a plane.
  double height(std::size_t link) const;
  /// The body of a link: its origin is the centre of mass, its axes are the world's at the start. 0 for a fixed link.
  dBodyID body(std::size_t link) const { return bodies_[group_[link]]; }
  /// The joints between bodies, in the order of Scene::joints.
  const std::vector<dJointID>& joints() const { return joints_; }

 private:
  void check_joints() const;
  void weld();
  void make_bodies(double density);
  void place_geoms();
  void lift();
  void connect();
  void collide(dGeomID geom1, dGeomID geom2);
  void check_motion(double time) const;

  struct Piece {
    dGeomID geom;
    const Collision* collision;
    std::size_t group;
  };

  Scene scene_;
  Ode library_;
  common::OdeWorld ode_{dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ)};  // a hash space ends the program at a geom 3e8 m away
  std::vector<std::size_t> group_;                                           // of a link; the last group is the world
  std::vector<dBodyID> bodies_;  // of a group; 0 for the world and for groups without links
  std::vector<Eigen::Vector3d> centres_;
  std::vector<Piece> pieces_;
  std::vector<dJointID> joints_;
  Eigen::Vector4d plane_{0, 0, 1, 0};  // normal and distance from the origin
  double lift_ = 0;
};

}  // namespace robot_model
