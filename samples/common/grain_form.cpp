#include "common/grain_form.hpp"

#include <stdexcept>

#include "common/number_text.hpp"
#include "supernormal/supernormal.h"

namespace common {
namespace {

constexpr int kMostEvaluations = 1000;  // default of the library

std::array<double, 3> core_half_axes(const GrainBody& body) {
  const auto [a, b, c] = body.half_axes;
  const double r = body.rounding;
  return {a - r, b - r, c - r};
}

OdeGeom smooth_geom(const GrainBody& body, double tolerance) {
  const auto [a, b, c] = core_half_axes(body);
  OdeGeom geom(body.delta == 2 && body.epsilon == 2 ? snCreateEllipsoid(nullptr, a, b, c)
                                                    : snCreateSuperellipsoid(nullptr, a, b, c, body.delta, body.epsilon));
  if ((body.rounding > 0 && snGeomSetRounding(geom.id(), body.rounding) == 0) ||
      snGeomSetSolver(geom.id(), SN_SOLVER_HYBRID, tolerance, kMostEvaluations) == 0) {
    throw std::invalid_argument(snLastError());
  }
  return geom;
}

Polyhedron polyhedron_of(const GrainBody& body, MeshSize size) {
  const auto [a, b, c] = core_half_axes(body);
  return superellipsoid_mesh({a, b, c}, body.delta, body.epsilon, body.rounding, size);
}

}  // namespace

GeomMaker grain_maker(const GrainForm& form, const GrainBody& body) {
  switch (form.kind) {
    case FormKind::Smooth:
      return [body, tolerance = form.tolerance] { return smooth_geom(body, tolerance); };
    case FormKind::Box:
      return [s = body.half_axes] { return OdeGeom(dCreateBox(nullptr, 2 * s[0], 2 * s[1], 2 * s[2])); };
    case FormKind::Convex:
      return convex_maker(polyhedron_of(body, form.mesh));
    case FormKind::Trimesh:
      return trimesh_maker(polyhedron_of(body, form.mesh));
  }
  throw std::logic_error("no such form");
}

std::string GrainForm::name() const {
  constexpr std::array<const char*, 4> kNames = {"Supernormal", "dBox", "dConvex", "dTriMesh"};
  const std::string name = kNames[static_cast<std::size_t>(kind)];
  return threads == 0 ? name : name + " (batch; " + std::to_string(threads) + (threads == 1 ? " thread)" : " threads)");
}

std::string GrainForm::accuracy() const {
  if (kind == FormKind::Box) return "";
  if (kind != FormKind::Smooth) return std::to_string(mesh.vertices());
  return text("%.0e", tolerance);
}

}  // namespace common
