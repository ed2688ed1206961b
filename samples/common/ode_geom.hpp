// Geoms that own the data to which they refer, and grains as geoms of several classes.
#pragma once

#include <ode/ode.h>

#include <array>
#include <functional>
#include <memory>
#include <string>

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

/// Makes geoms of one mesh. They share its data.
using GeomMaker = std::function<OdeGeom()>;

GeomMaker convex_maker(const Polyhedron& mesh);

/// The mesh has the face angles that the ODE collider with dConvex asserts.
GeomMaker trimesh_maker(const Polyhedron& mesh);

inline OdeGeom make_convex(const Polyhedron& mesh) { return convex_maker(mesh)(); }
inline OdeGeom make_trimesh(const Polyhedron& mesh) { return trimesh_maker(mesh)(); }

/// A superellipsoid whose edges are rounded by a sphere that rolls inside.
struct GrainBody {
  std::array<double, 3> half_axes;  ///< m, along x, y, z, rounding included
  double delta = 2;                 ///< exponent of the xy-section
  double epsilon = 2;               ///< exponent along z
  double rounding = 0;              ///< m, radius; 0: none
};

enum class FormKind { Smooth, Box, Convex, Trimesh };  // Smooth is our class; the others are classes of ODE

struct GrainForm {
  FormKind kind = FormKind::Smooth;
  double tolerance = 1e-9;   ///< for Smooth
  MeshSize mesh = {24, 20};  ///< for Convex and Trimesh, whose vertices are on the boundary of the grain
  int threads = 0;           ///< collision threads of a batch; 0: one pair after the other

  std::string name() const;      ///< "dConvex"
  std::string accuracy() const;  ///< tolerance, or number of vertices; "" for a box
};

/// Makes geoms of the grain, in no space. A dBox has the half-axes of its grain.
GeomMaker grain_maker(const GrainForm& form, const GrainBody& body);

}  // namespace common
