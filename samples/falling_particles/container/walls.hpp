#pragma once

#include <ode/ode.h>

#include <deque>
#include <vector>

#include "container/container.hpp"

namespace falling_particles {

/// ODE's geoms of a container.
class Walls {
 public:
  /// They collide with what has a bit of `collide_bits`, and have `category_bits`. The space must outlive this object.
  Walls(dSpaceID space, const Container& container, unsigned long category_bits, unsigned long collide_bits);
  ~Walls();
  Walls(const Walls&) = delete;
  Walls& operator=(const Walls&) = delete;

  const std::vector<dGeomID>& geoms() const { return geoms_; }

  /// Takes the lid off a hopper's outlet; once.
  void open_outlet();

 private:
  void add_plane(double a, double b, double c, double d) { geoms_.push_back(dCreatePlane(space_, a, b, c, d)); }
  void add_sides(const Rectangle& plan);
  void add_mesh(Mesh mesh);
  void add(const Box& box);
  void add(const Hopper& hopper);
  void add(const Terrain& terrain);
  static void add(const Periodic&) {}  // has none

  dSpaceID space_;
  std::vector<dGeomID> geoms_;
  dGeomID lid_ = nullptr;                     // of geoms_
  std::deque<Mesh> meshes_;                   // ODE refers to them
  std::vector<dTriMeshDataID> mesh_data_;     // of a hopper and its dish
  dHeightfieldDataID ground_data_ = nullptr;  // of a terrain
};

}  // namespace falling_particles
