#include "two_sided_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace falling_particles {
namespace {

using Triangle = std::array<unsigned int, 3>;

constexpr double kSeam = 1e-6;  // of the longest side: vertices closer than this are one, since they are in single precision

constexpr std::size_t next(std::size_t corner) { return (corner + 1) % 3; }

Vector3 to_vector(const std::array<float, 3>& vertex) { return {vertex[0], vertex[1], vertex[2]}; }

Vector3 to_vector(const dReal* v) { return {v[0], v[1], v[2]}; }

double longest_side(const Mesh& mesh) {
  double longest = 0;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      longest = std::max(longest, (to_vector(mesh.vertices[t[next(k)]]) - to_vector(mesh.vertices[t[k]])).norm());
    }
  }
  return longest;
}

/// For each vertex, the index of the first vertex within the tolerance.
std::vector<unsigned int> weld(const Mesh& mesh) {
  const double seam = std::max(kSeam * longest_side(mesh), std::numeric_limits<double>::min());
  std::map<std::array<double, 3>, std::vector<unsigned int>> cells;
  std::vector<unsigned int> first(mesh.vertices.size());
  for (unsigned int i = 0; i < first.size(); ++i) {
    const Vector3 place = to_vector(mesh.vertices[i]);
    const Vector3 cell = (place / seam).array().floor();
    first[i] = i;
    for (int neighbour = 0; neighbour < 27 && first[i] == i; ++neighbour) {
      const std::array<int, 3> step = {neighbour % 3 - 1, neighbour / 3 % 3 - 1, neighbour / 9 - 1};
      const Vector3 other = cell + Vector3(step[0], step[1], step[2]);
      const auto found = cells.find({other.x(), other.y(), other.z()});
      if (found == cells.end()) continue;
      for (const unsigned int earlier : found->second) {
        if ((to_vector(mesh.vertices[earlier]) - place).norm() <= seam) first[i] = earlier;
      }
    }
    if (first[i] == i) cells[{cell.x(), cell.y(), cell.z()}].push_back(i);
  }
  return first;
}

/// Each triangle once, with its welded vertices. Degenerate triangles are left out.
Sheets distinct_triangles(const Mesh& mesh) {
  const std::vector<unsigned int> first = weld(mesh);
  Sheets sheets;
  std::set<Triangle> seen;
  for (const Triangle& triangle : mesh.triangles) {
    const Triangle corners = {first[triangle[0]], first[triangle[1]], first[triangle[2]]};
    Triangle sorted = corners;
    std::ranges::sort(sorted);
    if (sorted[0] == sorted[1] || sorted[1] == sorted[2] || !seen.insert(sorted).second) continue;
    sheets.triangles.push_back(triangle);
    sheets.corners.push_back(corners);
  }
  return sheets;
}

void find_neighbours(Sheets& sheets) {
  std::map<std::pair<unsigned int, unsigned int>, std::vector<std::pair<std::size_t, std::size_t>>> uses;
  for (std::size_t t = 0; t < sheets.corners.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) uses[std::minmax(sheets.corners[t][k], sheets.corners[t][next(k)])].emplace_back(t, k);
  }
  sheets.neighbours.assign(sheets.corners.size(), {-1, -1, -1});
  for (const auto& [edge, of] : uses) {
    if (of.size() != 2) continue;
    sheets.neighbours[of[0].first][of[0].second] = static_cast<int>(of[1].first);
    sheets.neighbours[of[1].first][of[1].second] = static_cast<int>(of[0].first);
  }
}

/// Whether two neighbours run along their common edge, from `corner` to the next, in opposite directions. Triangles with the same
/// orientation do.
bool agree(const Sheets& sheets, std::size_t triangle, std::size_t corner, std::size_t neighbour) {
  const Triangle& other = sheets.corners[neighbour];
  for (std::size_t k = 0; k < 3; ++k) {
    if (other[k] == sheets.corners[triangle][corner]) return other[next(k)] != sheets.corners[triangle][next(corner)];
  }
  return false;
}

void turn_around(Sheets& sheets, std::size_t triangle) {
  std::swap(sheets.triangles[triangle][1], sheets.triangles[triangle][2]);
  std::swap(sheets.corners[triangle][1], sheets.corners[triangle][2]);
  std::swap(sheets.neighbours[triangle][0], sheets.neighbours[triangle][2]);
}

/// Visits each sheet triangle by triangle and flips the triangles with the opposite orientation.
void orient(Sheets& sheets) {
  constexpr auto kNone = std::numeric_limits<unsigned int>::max();
  sheets.sheet.assign(sheets.triangles.size(), kNone);
  unsigned int count = 0;
  for (std::size_t seed = 0; seed < sheets.triangles.size(); ++seed) {
    if (sheets.sheet[seed] != kNone) continue;
    sheets.sheet[seed] = count;
    for (std::vector<std::size_t> to_visit = {seed}; !to_visit.empty();) {
      const std::size_t t = to_visit.back();
      to_visit.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        if (sheets.neighbours[t][k] < 0) continue;
        const auto other = static_cast<std::size_t>(sheets.neighbours[t][k]);
        const bool is_new = sheets.sheet[other] == kNone;
        if (!agree(sheets, t, k, other)) {
          if (!is_new) throw std::runtime_error("has a sheet with one side only, as a Möbius strip has");
          turn_around(sheets, other);
        }
        if (!is_new) continue;
        sheets.sheet[other] = count;
        to_visit.push_back(other);
      }
    }
    ++count;
  }
}

std::uint64_t next_number() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

/// The centre of the geom in the frame of the mesh.
Vector3 centre_of(dGeomID geom, dGeomID mesh) {
  const Vector3 lever = to_vector(dGeomGetPosition(geom)) - to_vector(dGeomGetPosition(mesh));
  const dReal* const rotation = dGeomGetRotation(mesh);  // three rows of four numbers
  return to_vector(rotation) * lever.x() + to_vector(rotation + 4) * lever.y() + to_vector(rotation + 8) * lever.z();
}

const TwoSidedMesh& mesh_of(dGeomID geom) { return *static_cast<const TwoSidedMesh*>(dGeomGetData(geom)); }

}  // namespace

Sheets sheets_of(const Mesh& mesh) {
  Sheets sheets = distinct_triangles(mesh);
  find_neighbours(sheets);
  orient(sheets);
  return sheets;
}

/// The cached results for one mesh and one point.
struct TwoSidedMesh::View {
  std::uint64_t mesh = 0;  // number_ of the mesh
  Vector3 centre = Vector3::Zero();
  std::vector<std::pair<unsigned int, Foot>> feet;  // the nearest place of each sheet
};

TwoSidedMesh::TwoSidedMesh(const MeshShape& mesh)
    : number_(next_number()), vertices_(mesh.vertices), sheets_(sheets_of(mesh)), both_(sheets_.triangles) {
  for (const auto& [a, b, c] : sheets_.triangles) both_.push_back({a, c, b});
  for (std::size_t t = 0; t < sheets_.sheet.size(); ++t) {
    if (sheets_.sheet[t] == of_sheet_.size()) of_sheet_.emplace_back();
    of_sheet_[sheets_.sheet[t]].push_back(t);
  }
  find_normals();
}

Vector3 TwoSidedMesh::vertex(std::size_t triangle, std::size_t corner) const {
  return to_vector(vertices_[sheets_.triangles[triangle][corner]]);
}

Vector3 TwoSidedMesh::normal(std::size_t triangle) const {
  const Vector3 a = vertex(triangle, 0);
  return (vertex(triangle, 1) - a).cross(vertex(triangle, 2) - a).normalized();
}

// Pseudonormals (Baerentzen and Aanaes, 2005): a point is in front of a surface if it is in front of the pseudonormal at the
// nearest place. At a vertex, the pseudonormal is the sum of the normals of the adjacent triangles, each times its angle.
void TwoSidedMesh::find_normals() {
  const std::size_t count = sheets_.triangles.size();
  std::map<std::pair<unsigned int, unsigned int>, Vector3> at_vertices;  // by sheet and number of the vertex
  const auto key = [&](std::size_t t, std::size_t k) { return std::pair(sheets_.sheet[t], sheets_.corners[t][k]); };
  edge_normals_.resize(count);
  vertex_normals_.resize(count);
  for (std::size_t t = 0; t < count; ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int other = sheets_.neighbours[t][k];
      edge_normals_[t][k] = normal(t) + (other < 0 ? Vector3(Vector3::Zero()) : normal(static_cast<std::size_t>(other)));
      const Vector3 side1 = vertex(t, next(k)) - vertex(t, k);
      const Vector3 side2 = vertex(t, next(next(k))) - vertex(t, k);
      const double angle = std::atan2(side1.cross(side2).norm(), side1.dot(side2));
      at_vertices.try_emplace(key(t, k), Vector3::Zero()).first->second += angle * normal(t);
    }
  }
  for (std::size_t t = 0; t < count; ++t) {
    for (std::size_t k = 0; k < 3; ++k) vertex_normals_[t][k] = at_vertices.at(key(t, k));
  }
}

TwoSidedMesh::Foot TwoSidedMesh::foot_on(std::size_t triangle, const Vector3& point) const {
  const auto foot = [&](const Vector3& place, const Vector3& normal) {
    return Foot{(point - place).squaredNorm(), normal.dot(point - place) >= 0};
  };
  std::array<Vector3, 3> sides;   // from each corner to the next
  std::array<double, 3> along{};  // of the projected point, from each corner to the next; within [0, 1] it is on the side
  for (std::size_t k = 0; k < 3; ++k) {
    sides[k] = vertex(triangle, next(k)) - vertex(triangle, k);
    along[k] = sides[k].dot(point - vertex(triangle, k)) / sides[k].squaredNorm();
  }
  const Vector3 face = normal(triangle);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t before = next(next(k));
    if (along[k] <= 0 && along[before] >= 1) return foot(vertex(triangle, k), vertex_normals_[triangle][k]);
    const Vector3 start = vertex(triangle, k);
    const bool is_outside = sides[k].cross(face).dot(point - start) >= 0;
    if (is_outside && along[k] > 0 && along[k] < 1) return foot(start + along[k] * sides[k], edge_normals_[triangle][k]);
  }
  return foot(point - face.dot(point - vertex(triangle, 0)) * face, face);
}

/// Finds the nearest place on each sheet among the triangles `near`.
void TwoSidedMesh::look(View& view, const Vector3& centre, std::span<const int> near) const {
  view.mesh = number_;
  view.centre = centre;
  view.feet.clear();
  for (const int index : near) {
    const auto triangle = static_cast<std::size_t>(index);
    if (triangle >= sheets_.triangles.size()) continue;  // a flipped copy
    const Foot foot = foot_on(triangle, centre);
    const unsigned int sheet = sheets_.sheet[triangle];
    const auto known = std::ranges::find(view.feet, sheet, &std::pair<unsigned int, Foot>::first);
    if (known == view.feet.end()) {
      view.feet.emplace_back(sheet, foot);
    } else if (foot.squared < known->second.squared) {
      known->second = foot;
    }
  }
}

bool TwoSidedMesh::is_in_front(View& view, const Vector3& centre, unsigned int sheet) const {
  if (view.mesh != number_ || view.centre != centre) look(view, centre, {});
  const auto known = std::ranges::find(view.feet, sheet, &std::pair<unsigned int, Foot>::first);
  if (known != view.feet.end()) return known->second.is_from_front;
  Foot nearest{std::numeric_limits<double>::infinity(), true};
  for (const std::size_t triangle : of_sheet_[sheet]) {
    const Foot foot = foot_on(triangle, centre);
    if (foot.squared < nearest.squared) nearest = foot;
  }
  view.feet.emplace_back(sheet, nearest);
  return nearest.is_from_front;
}

TwoSidedMesh::View& TwoSidedMesh::view() {
  thread_local View last;
  return last;
}

void TwoSidedMesh::be_told(dGeomID mesh, dGeomID geom, const int* triangles, int count) {
  mesh_of(mesh).look(view(), centre_of(geom, mesh), {triangles, static_cast<std::size_t>(count)});
}

int TwoSidedMesh::is_wanted(dGeomID mesh, dGeomID geom, int triangle) {
  const TwoSidedMesh& sheets = mesh_of(mesh);
  const std::size_t count = sheets.sheets_.triangles.size();
  const auto index = static_cast<std::size_t>(triangle);
  const bool is_in_front = sheets.is_in_front(view(), centre_of(geom, mesh), sheets.sheets_.sheet[index % count]);
  return is_in_front == (index < count) ? 1 : 0;
}

void TwoSidedMesh::attach(dGeomID geom) const {
  dGeomSetData(geom, const_cast<TwoSidedMesh*>(this));  // ODE's data pointer is not const
  dGeomTriMeshSetArrayCallback(geom, be_told);
  dGeomTriMeshSetCallback(geom, is_wanted);
}

}  // namespace falling_particles
