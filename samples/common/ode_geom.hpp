// Geoms that own the data to which they refer.
#pragma once

#include <ode/ode.h>

#include <functional>
#include <memory>

#include "common/polyhedron.hpp"

namespace common {

/// Owns a geom and its data.
class OdeGeom {
 public:
  /// Throws std::runtime_error if `id` is null.
  explicit OdeGeom(dGeomID id, std::shared_ptr<void> data = nullptr);
  OdeGeom(OdeGeom&& other) noexcept;
  OdeGeom& operator=(OdeGeom&&) = delete;
  OdeGeom(const OdeGeom&) = delete;
  OdeGeom& operator=(const OdeGeom&) = delete;
  ~OdeGeom();

  dGeomID id() const { return id_; }

 private:
  dGeomID id_;
  std::shared_ptr<void> data_;
};

OdeGeom make_convex(const Polyhedron& mesh);

/// Makes geoms of one mesh. They share its data.
using GeomMaker = std::function<OdeGeom()>;

/// The mesh has the face angles that the ODE collider with dConvex asserts.
GeomMaker trimesh_maker(const Polyhedron& mesh);
inline OdeGeom make_trimesh(const Polyhedron& mesh) { return trimesh_maker(mesh)(); }

}  // namespace common
