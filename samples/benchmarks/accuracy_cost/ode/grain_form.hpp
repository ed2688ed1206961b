// The grains of a scene as bodies of several geometry classes.
#pragma once

#include <string>

#include "model/grain_kind.hpp"
#include "ode_geom.hpp"

namespace accuracy_cost {

enum class FormKind { Smooth, Box, Convex, Trimesh };  // Smooth is our class; the others are classes of ODE

struct Form {
  FormKind kind = FormKind::Smooth;
  double tolerance = 1e-9;   ///< for Smooth
  MeshSize mesh = {24, 20};  ///< for Convex and Trimesh, whose vertices are on the boundary of the grain
  int threads = 0;           ///< collision threads of a batch; 0: one pair after the other

  std::string name() const;      ///< "dConvex"
  std::string accuracy() const;  ///< tolerance, or number of vertices; "" for a box
};

/// Makes geoms of the grain, in no space. A dBox has the half-axes of its grain.
GeomMaker grain_maker(const Form& form, const falling_particles::GrainKind& kind);

}  // namespace accuracy_cost
