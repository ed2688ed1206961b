#include "container_geoms.hpp"

#include <cstddef>
#include <numbers>
#include <utility>
#include <variant>
#include <vector>

namespace falling_particles {
namespace {

static_assert(sizeof(unsigned int) == sizeof(dTriIndex));

/// Reorders the samples for ODE, whose heightfields extend along x and z with y upwards. Rotated by 90 degrees about x, y points
/// upwards in the world too, but z points along the world's -y.
std::vector<double> rows_along_z(const Terrain& terrain) {
  const std::size_t n = terrain.samples_per_side();
  std::vector<double> heights;
  heights.reserve(n * n);
  for (std::size_t j = n; j-- > 0;) {
    for (std::size_t i = 0; i < n; ++i) heights.push_back(terrain.sample(i, j));
  }
  return heights;
}

}  // namespace

ContainerGeoms::ContainerGeoms(dSpaceID space, const Container& container, unsigned long category_bits, unsigned long collide_bits,
                               const PeriodicAxes& periodic)
    : space_(space), periodic_(periodic) {
  std::visit([this](const auto& kind) { this->add(kind); }, container);
  for (dGeomID geom : geoms_) {
    dGeomSetCategoryBits(geom, category_bits);
    dGeomSetCollideBits(geom, collide_bits);
  }
}

ContainerGeoms::~ContainerGeoms() {
  for (dGeomID geom : geoms_) dGeomDestroy(geom);
  for (dTriMeshDataID data : mesh_data_) dGeomTriMeshDataDestroy(data);
  if (ground_data_ != nullptr) dGeomHeightfieldDataDestroy(ground_data_);
}

void ContainerGeoms::open_outlet() {
  std::erase(geoms_, lid_);
  dGeomDestroy(lid_);
  lid_ = nullptr;
}

void ContainerGeoms::add_sides(const Rectangle& plan, const PeriodicAxes& periodic) {
  // A plane is solid on the side opposite to its normal: a x + b y + c z < d.
  if (!periodic[0]) {
    add_plane(1, 0, 0, plan.corner[0]);
    add_plane(-1, 0, 0, -(plan.corner[0] + plan.width[0]));
  }
  if (!periodic[1]) {
    add_plane(0, 1, 0, plan.corner[1]);
    add_plane(0, -1, 0, -(plan.corner[1] + plan.width[1]));
  }
}

void ContainerGeoms::add_mesh(Mesh mesh) {
  const Mesh& kept = meshes_.emplace_back(std::move(mesh));
  dTriMeshDataID data = mesh_data_.emplace_back(dGeomTriMeshDataCreate());
  dGeomTriMeshDataBuildSingle(data, kept.vertices.data(), sizeof(kept.vertices[0]), static_cast<int>(kept.vertices.size()),
                              kept.triangles.data(), static_cast<int>(3 * kept.triangles.size()), sizeof(kept.triangles[0]));
  geoms_.push_back(dCreateTriMesh(space_, data, nullptr, nullptr, nullptr));
}

void ContainerGeoms::add(const Box& box) {
  add_plane(0, 0, 1, 0);
  add_sides(box.plan(), periodic_);
}

void ContainerGeoms::add(const Hopper& hopper) {
  add_plane(0, 0, 1, 0);
  add_sides({{-hopper.tray_width / 2, -hopper.tray_width / 2}, {hopper.tray_width, hopper.tray_width}});
  add_plane(0, 0, 1, hopper.clearance);
  lid_ = geoms_.back();
  add_mesh(make_mesh(hopper));
  if (hopper.dish) add_mesh(make_mesh(*hopper.dish, hopper.segments));
}

void ContainerGeoms::add(const Terrain& terrain) {
  const Rectangle plan = terrain.plan();
  add_sides(plan);
  const int samples = static_cast<int>(terrain.samples_per_side());
  const auto [dx, dy] = terrain.spacing();
  constexpr int kCopy = 1;
  constexpr int kNoWrap = 0;
  constexpr double kThickness = 0;  // m, below the lowest sample
  ground_data_ = dGeomHeightfieldDataCreate();
  dGeomHeightfieldDataBuildDouble(ground_data_, rows_along_z(terrain).data(), kCopy, (samples - 1) * dx, (samples - 1) * dy,
                                  samples, samples, 1, 0, kThickness, kNoWrap);
  dGeomID ground = dCreateHeightfield(space_, ground_data_, 1);
  dMatrix3 upright;
  dRFromAxisAndAngle(upright, 1, 0, 0, std::numbers::pi / 2);
  dGeomSetRotation(ground, upright);
  dGeomSetPosition(ground, plan.corner[0] + plan.width[0] / 2, plan.corner[1] + plan.width[1] / 2, 0);
  geoms_.push_back(ground);
}

}  // namespace falling_particles
