#include "bed.hpp"

#include <supernormal/supernormal.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace look_ahead_beds {
namespace {

constexpr double kColumn = 6 * kSmallestHalfAxis;  // m; between grains of a layer: three times the longest half-axis
constexpr double kLayersPerSide = 3;               // initial layers per grain along a side
constexpr double kSpread = 0.2;                    // relative variation of the sizes

}  // namespace

std::array<std::array<double, 4>, 5> Bed::walls() const {
  return {{{0, 0, 1, 0}, {1, 0, 0, -half_width}, {-1, 0, 0, -half_width}, {0, 1, 0, -half_width}, {0, -1, 0, -half_width}}};
}

Bed make_bed(int count, double exponent, unsigned seed) {
  const int side = std::max(1, static_cast<int>(std::ceil(std::cbrt(count / kLayersPerSide))));
  Bed bed{exponent, 0.5 * kColumn * side, {}};
  std::mt19937_64 engine(seed);
  const auto uniform = [&engine] { return static_cast<double>(engine() >> 11U) * 0x1p-52 - 1; };  // in [-1, 1)
  for (int i = 0; i < count; ++i) {
    const double size = kSmallestHalfAxis * (1 + kSpread * uniform());
    Grain grain{{2 * size, 1.5 * size, size}, {}};
    const auto place = [side](int index) { return kColumn * (index + 0.5 * (1 - side)); };
    const int layer = i / (side * side);
    grain.start.position = {place(i % side), place(i / side % side), kColumn * (1 + layer)};
    double square = 0;
    for (double& q : grain.start.quaternion) square += std::pow(q = uniform(), 2);
    for (double& q : grain.start.quaternion) q /= std::sqrt(square);
    bed.grains.push_back(grain);
  }
  return bed;
}

dGeomID create_geom(dSpaceID space, const Bed& bed, const Grain& grain) {
  const auto [a, b, c] = grain.half_axes;
  const auto exponent = static_cast<dReal>(bed.exponent);
  const dGeomID geom =
      snCreateSuperellipsoid(space, static_cast<dReal>(a), static_cast<dReal>(b), static_cast<dReal>(c), exponent, exponent);
  if (geom == nullptr) throw std::runtime_error(snLastError());
  set_pose(geom, grain.start);
  return geom;
}

void set_pose(dGeomID geom, const Pose& pose) {
  dQuaternion quaternion;
  for (std::size_t k = 0; k < 4; ++k) quaternion[k] = static_cast<dReal>(pose.quaternion[k]);
  dGeomSetPosition(geom, static_cast<dReal>(pose.position[0]), static_cast<dReal>(pose.position[1]),
                   static_cast<dReal>(pose.position[2]));
  dGeomSetQuaternion(geom, quaternion);
}

Ruler::Ruler(const Bed& bed) {
  for (const Grain& grain : bed.grains) geoms_.push_back(create_geom(grains_, bed, grain));
  for (const auto& w : bed.walls()) {
    dCreatePlane(walls_, static_cast<dReal>(w[0]), static_cast<dReal>(w[1]), static_cast<dReal>(w[2]), static_cast<dReal>(w[3]));
  }
}

Ruler::~Ruler() {
  dSpaceDestroy(grains_);
  dSpaceDestroy(walls_);
}

void Ruler::measure(const std::vector<Pose>& poses) {
  for (std::size_t i = 0; i < geoms_.size(); ++i) set_pose(geoms_[i], poses[i]);
  dSpaceCollide(grains_, this, near_callback);
  const auto to_geom = [](dSpaceID space) { return reinterpret_cast<dGeomID>(space); };
  dSpaceCollide2(to_geom(grains_), to_geom(walls_), this, near_callback);
}

void Ruler::near_callback(void* self, dGeomID o1, dGeomID o2) {
  Ruler& ruler = *static_cast<Ruler*>(self);
  snProximity proximity;
  if (snGeomProximity(o1, o2, &proximity) == 0) throw std::runtime_error(snLastError());
  const double overlap = -double{proximity.gap} / kSmallestHalfAxis;
  if (!(overlap > 0)) return;
  ruler.deepest_ = std::max(ruler.deepest_, overlap);
  ruler.sum_ += overlap;
  ++ruler.overlaps_;
}

}  // namespace look_ahead_beds
