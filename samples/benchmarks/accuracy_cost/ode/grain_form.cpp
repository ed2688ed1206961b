#include "grain_form.hpp"

#include <array>
#include <stdexcept>

#include "methods/method.hpp"
#include "supernormal/supernormal.h"
#include "world/world.hpp"

namespace accuracy_cost {
namespace {

using falling_particles::GrainKind;

constexpr int kMostEvaluations = 1000;  // default of the library

Mesh grain_mesh(const GrainKind& kind, MeshSize size) {
  const auto [a, b, c] = kind.half_axes;
  const double r = kind.rounding;
  return superellipsoid_mesh({a - r, b - r, c - r}, kind.delta, kind.epsilon, r, size);
}

}  // namespace

GeomMaker grain_maker(const Form& form, const GrainKind& kind) {
  switch (form.kind) {
    case FormKind::Smooth:
      return [kind, tolerance = form.tolerance] {
        OdeGeom geom(falling_particles::create_geom(nullptr, kind.all_components().front().body));
        if (snGeomSetSolver(geom.id(), SN_SOLVER_HYBRID, tolerance, kMostEvaluations) == 0)
          throw std::invalid_argument(snLastError());
        return geom;
      };
    case FormKind::Box:
      return [s = kind.half_axes] { return OdeGeom(dCreateBox(nullptr, 2 * s[0], 2 * s[1], 2 * s[2])); };
    case FormKind::Convex:
      return convex_maker(grain_mesh(kind, form.mesh));
    case FormKind::Trimesh:
      return trimesh_maker(grain_mesh(kind, form.mesh));
  }
  throw std::logic_error("no such form");
}

std::string Form::name() const {
  constexpr std::array<const char*, 4> kNames = {"Supernormal", "dBox", "dConvex", "dTriMesh"};
  const std::string name = kNames[static_cast<std::size_t>(kind)];
  return threads == 0 ? name : name + " (batch; " + std::to_string(threads) + (threads == 1 ? " thread)" : " threads)");
}

std::string Form::accuracy() const {
  if (kind == FormKind::Box) return "";
  if (kind != FormKind::Smooth) return std::to_string(mesh.vertices());
  return power_of_ten(tolerance);
}

}  // namespace accuracy_cost
