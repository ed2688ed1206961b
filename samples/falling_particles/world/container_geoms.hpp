// The geoms of a container, in ODE.
#pragma once

#include <ode/ode.h>

#include <deque>
#include <vector>

#include "model/container.hpp"

namespace falling_particles {

/// The ODE geoms of a container: box, hopper or terrain. Other containers have none (model/container_walls.hpp).
class ContainerGeoms {
 public:
  /// The geoms have `category_bits` and collide with geoms that have a bit of `collide_bits`. The space must outlive this object. A
  /// box has no geoms across periodic axes.
  ContainerGeoms(dSpaceID space, const Container& container, unsigned long category_bits, unsigned long collide_bits,
                 const PeriodicAxes& periodic = {});
  ~ContainerGeoms();
  ContainerGeoms(const ContainerGeoms&) = delete;
  ContainerGeoms& operator=(const ContainerGeoms&) = delete;

  const std::vector<dGeomID>& geoms() const { return geoms_; }

  /// Whether a lid closes a hopper's outlet.
  bool has_lid() const { return lid_ != nullptr; }
  /// Removes the lid of a hopper's outlet. Call it once.
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
  std::deque<Mesh> meshes_;                   // ODE keeps pointers to them
  std::vector<dTriMeshDataID> mesh_data_;     // of the meshes of a hopper and its dish
  dHeightfieldDataID ground_data_ = nullptr;  // samples of a terrain
};

}  // namespace falling_particles
