// The walls of a container as geoms of ODE.
#pragma once

#include <ode/ode.h>

#include <deque>
#include <vector>

#include "model/container.hpp"

namespace falling_particles {

/// The geoms of a container.
class ContainerGeoms {
 public:
  /// The geoms collide with those that have a bit of `collide_bits`, and have `category_bits`. The space must outlive this
  /// object. A box has no walls across axes that are periodic.
  ContainerGeoms(dSpaceID space, const Container& container, unsigned long category_bits, unsigned long collide_bits,
                 const PeriodicAxes& periodic = {});
  ~ContainerGeoms();
  ContainerGeoms(const ContainerGeoms&) = delete;
  ContainerGeoms& operator=(const ContainerGeoms&) = delete;

  const std::vector<dGeomID>& geoms() const { return geoms_; }

  /// Whether a lid closes a hopper's outlet.
  bool has_lid() const { return lid_ != nullptr; }
  /// Takes the lid off a hopper's outlet; call it once.
  void open_outlet();

 private:
  void add_plane(double a, double b, double c, double d) { geoms_.push_back(dCreatePlane(space_, a, b, c, d)); }
  void add_sides(const Rectangle& plan, const PeriodicAxes& periodic = {});
  void add_mesh(Mesh mesh);
  void add(const Box& box);
  void add(const Hopper& hopper);
  void add(const Terrain& terrain);
  static void add(const Periodic&) {}  // it has no walls
  template <typename MadeOfWalls>
  static void add(const MadeOfWalls&) {}

  dSpaceID space_;
  PeriodicAxes periodic_;
  std::vector<dGeomID> geoms_;
  dGeomID lid_ = nullptr;                     // one of geoms_
  std::deque<Mesh> meshes_;                   // ODE refers to them
  std::vector<dTriMeshDataID> mesh_data_;     // meshes of a hopper and its dish
  dHeightfieldDataID ground_data_ = nullptr;  // samples of a terrain
};

}  // namespace falling_particles
