// The grains of a scene as bodies of several geometry classes.
#pragma once

#include <array>
#include <string>

#include "common/ode_geom.hpp"

namespace common {

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
