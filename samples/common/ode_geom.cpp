#include "common/ode_geom.hpp"

#include <Eigen/Geometry>
#include <stdexcept>
#include <utility>

#include "common/measured_tables.hpp"
#include "supernormal/supernormal.h"

namespace common {

namespace {

using supernormal::Vector3;

struct ConvexData {
  std::vector<dReal> planes, points;
  std::vector<unsigned> polygons;
};

struct TrimeshData {
  std::vector<double> vertices;
  std::vector<dTriIndex> indices;
  dTriMeshDataID id = dGeomTriMeshDataCreate();

  TrimeshData() = default;
  TrimeshData(const TrimeshData&) = delete;
  TrimeshData& operator=(const TrimeshData&) = delete;
  ~TrimeshData() { dGeomTriMeshDataDestroy(id); }
};

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

OdeGeom::OdeGeom(dGeomID id, std::shared_ptr<void> data) : id_(id), data_(std::move(data)) {
  if (id == nullptr) throw std::runtime_error(std::string("a geom was refused: ") + snLastError());
}

OdeGeom::OdeGeom(OdeGeom&& other) noexcept : id_(std::exchange(other.id_, nullptr)), data_(std::move(other.data_)) {}

OdeGeom::~OdeGeom() {
  if (id_ != nullptr) dGeomDestroy(id_);
}

GeomMaker convex_maker(const Polyhedron& mesh) {
  const auto data = std::make_shared<ConvexData>();
  for (const Vector3& vertex : mesh.vertices) data->points.insert(data->points.end(), vertex.begin(), vertex.end());
  for (const auto& triangle : mesh.triangles) {
    const Vector3& corner = mesh.vertices[triangle[0]];
    const Vector3 normal = (mesh.vertices[triangle[1]] - corner).cross(mesh.vertices[triangle[2]] - corner).normalized();
    data->planes.insert(data->planes.end(), normal.begin(), normal.end());
    data->planes.push_back(normal.dot(corner));
    data->polygons.push_back(3);
    data->polygons.insert(data->polygons.end(), triangle.begin(), triangle.end());
  }
  return [data, planes = static_cast<unsigned>(mesh.triangles.size()), points = static_cast<unsigned>(mesh.vertices.size())] {
    return OdeGeom(dCreateConvex(nullptr, data->planes.data(), planes, data->points.data(), points, data->polygons.data()), data);
  };
}

GeomMaker trimesh_maker(const Polyhedron& mesh) {
  const auto data = std::make_shared<TrimeshData>();
  for (const Vector3& vertex : mesh.vertices) data->vertices.insert(data->vertices.end(), vertex.begin(), vertex.end());
  for (const auto& triangle : mesh.triangles) data->indices.insert(data->indices.end(), triangle.begin(), triangle.end());
  dGeomTriMeshDataBuildDouble(data->id, data->vertices.data(), 3 * sizeof(double), static_cast<int>(mesh.vertices.size()),
                              data->indices.data(), static_cast<int>(data->indices.size()), 3 * sizeof(dTriIndex));
  dGeomTriMeshDataPreprocess2(data->id, 1U << dTRIDATAPREPROCESS_BUILD_FACE_ANGLES, nullptr);
  return [data] { return OdeGeom(dCreateTriMesh(nullptr, data->id, nullptr, nullptr, nullptr), data); };
}

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
