// Triangle meshes of geoms, for C programs.
#include <algorithm>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "ode/support/last_error.hpp"
#include "ode/support/require.hpp"
#include "supernormal/shapes/tessellation.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::ode {
namespace {

std::unique_ptr<dReal[]> coordinates(const std::vector<Vector3>& vectors) {
  auto numbers = std::make_unique<dReal[]>(3 * vectors.size());
  dReal* next = numbers.get();
  for (const Vector3& vector : vectors) next = std::ranges::transform(vector, next, to_real).out;
  return numbers;
}

std::unique_ptr<dTriIndex[]> corners(const Tessellation& body) {
  auto numbers = std::make_unique<dTriIndex[]>(3 * body.triangles.size());
  dTriIndex* next = numbers.get();
  for (const auto& triangle : body.triangles) next = std::ranges::copy(triangle, next).out;
  return numbers;
}

}  // namespace
}  // namespace supernormal::ode

using namespace supernormal;
using namespace supernormal::ode;

extern "C" int snGeomTessellate(dGeomID geom, dReal chord_error, snMesh* mesh) {
  return succeeds("snGeomTessellate", [&] {
    require_not_null("mesh", mesh);
    *mesh = {};
    const Tessellation body = tessellate(require_body(geom).shape(), chord_error);
    if (body.triangles.size() > static_cast<std::size_t>(std::numeric_limits<int>::max() / 3)) {
      throw std::length_error("chord_error = " + to_text(chord_error) +
                              " m makes more triangles than an int counts; allowed: more");
    }
    auto position = coordinates(body.points), normal = coordinates(body.normals);
    auto index = corners(body);
    *mesh = {static_cast<int>(body.points.size()), static_cast<int>(body.triangles.size()), position.release(), normal.release(),
             index.release()};
  });
}

extern "C" void snMeshRelease(snMesh* mesh) {
  if (mesh == nullptr) return;
  delete[] mesh->position;
  delete[] mesh->normal;
  delete[] mesh->index;
  *mesh = {};
}
