#include "common/ode_geom.hpp"

#include <Eigen/Geometry>
#include <stdexcept>
#include <utility>

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

}  // namespace

OdeGeom::OdeGeom(dGeomID id, std::shared_ptr<void> data) : id_(id), data_(std::move(data)) {
  if (id == nullptr) throw std::runtime_error(std::string("a geom was refused: ") + snLastError());
}

OdeGeom::OdeGeom(OdeGeom&& other) noexcept : id_(std::exchange(other.id_, nullptr)), data_(std::move(other.data_)) {}

OdeGeom::~OdeGeom() {
  if (id_ != nullptr) dGeomDestroy(id_);
}

OdeGeom make_convex(const Polyhedron& mesh) {
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
  const auto planes = static_cast<unsigned>(mesh.triangles.size()), points = static_cast<unsigned>(mesh.vertices.size());
  return OdeGeom(dCreateConvex(nullptr, data->planes.data(), planes, data->points.data(), points, data->polygons.data()), data);
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

}  // namespace common
