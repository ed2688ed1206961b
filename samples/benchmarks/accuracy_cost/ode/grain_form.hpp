// The grains of a scene in the form of bodies of several classes.
#pragma once

#include <string>

#include "model/grain_kind.hpp"
#include "ode_geom.hpp"

namespace accuracy_cost {

enum class FormKind { Smooth, Box, Convex, Trimesh };  // Smooth is our class, the others are ODE's

struct Form {
  FormKind kind = FormKind::Smooth;
  double tolerance = 1e-9;   ///< used by Smooth
  MeshSize mesh = {24, 20};  ///< used by Convex and Trimesh, whose vertices are on the grain's boundary
  int threads = 0;           ///< threads that collide, in a batch; 0: one pair after the other

  std::string name() const;      ///< "dConvex"
  std::string accuracy() const;  ///< the tolerance, or the number of vertices; "" for a box
};

/// Makes geoms of the grain, in no space; a dBox has the half-axes of its grain.
GeomMaker grain_maker(const Form& form, const falling_particles::GrainKind& kind);

}  // namespace accuracy_cost
