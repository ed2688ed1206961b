// Tests of the properties of a dHeightfield that are found through ODE's geoms: the positions of its samples, and its triangles.
#include "ode/colliders/heightfield/heightfield_grid.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <limits>
#include <string>

#include "ode/colliders/heightfield/heightfield_patch.hpp"
#include "ode/terrain.hpp"
#include "support/relative.hpp"

using namespace supernormal;
using namespace supernormal::ode;
using namespace supernormal::test;

namespace {

struct Landscape {
  std::string name;
  Terrain::Height height;
};

std::vector<Landscape> landscapes() {
  return {{"rough", rough(1, 2)},
          {"hills", hills(1, 0.4)},
          {"faint", rough(2, 1e-6)},
          {"steep", rough(3, 1000)},
          {"one peak", [](int i, int j) { return i == 5 && j == 4 ? 1.0 : 0.0; }},
          {"one pit", [](int i, int j) { return i == 5 && j == 4 ? -1.0 : 0.0; }},
          {"gable", [](int i, int /*j*/) { return 4.0 - std::abs(i - 5); }},
          {"gable the other way", [](int /*i*/, int j) { return 4.0 - std::abs(j - 4); }},
          {"steps", [](int i, int j) { return std::floor(i / 2.0) + std::floor(j / 3.0); }},
          {"flat beside rough", [](int i, int j) { return i > 4 ? rough(4, 1)(i, j) : 0.0; }},
          {"pyramid", [](int i, int j) { return -static_cast<double>(std::max(std::abs(i - 5), std::abs(j - 4))); }}};
}

// A facet near the cell (5, 4), for any border.
Facet facet_near(HeightfieldProbe& probe, const Terrain& terrain, double u, double v) {
  const Vec corner = terrain.vertex(5, 4);
  Facet facet;
  REQUIRE(probe.find_facet(corner[0] + (u - 0.5) * terrain.spacing_x(), corner[2] + (v - 0.5) * terrain.spacing_z(), 0.1, facet));
  return facet;
}

void check_axis(const SampleAxis& axis, double spacing, double half, int count, bool repeats) {
  if (!repeats) {
    CHECK(std::abs(axis.spacing - spacing) <= within_rounding(0) * spacing);
    CHECK(std::abs(axis.half - half) <= within_rounding(0) * half);
    CHECK(axis.count == count);
    return;
  }
  CHECK(axis.spacing == relative(spacing).epsilon(within_rounding(1e-13)));
  CHECK(axis.count == 0);
  const double shift = (axis.half - half) / spacing;
  CHECK(std::abs(shift - std::round(shift)) < within_rounding(1e-12) * (1 + std::abs(shift)));
}

// Checks that every triangle's vertices are samples, and that every cell of the region has both triangles.
void check_triangles(std::span<const MeshTriangle> triangles, const Terrain& terrain, const Region& region) {
  std::size_t expected = 0;
  for (int i = -60; i < 60; ++i) {
    for (int j = -60; j < 60; ++j) {
      const bool exists =
          terrain.layout().repeats || (i >= 0 && j >= 0 && i < terrain.layout().columns - 1 && j < terrain.layout().rows - 1);
      if (!exists) continue;
      const double x = static_cast<double>(i) * terrain.spacing_x() - terrain.layout().width / 2;
      const double z = static_cast<double>(j) * terrain.spacing_z() - terrain.layout().depth / 2;
      if (x + terrain.spacing_x() <= region.x_low || x > region.x_high) continue;
      if (z + terrain.spacing_z() <= region.z_low || z > region.z_high) continue;
      expected += 2;
    }
  }
  CHECK(triangles.size() == expected);
  double worst = 0;
  double largest = 1;
  for (const MeshTriangle& triangle : triangles) {
    const Vector3 up = (triangle.vertices[1] - triangle.vertices[0]).cross(triangle.vertices[2] - triangle.vertices[0]);
    CHECK(up.y() > 0);
    for (const Vector3& v : triangle.vertices) {
      const auto i = std::llround((v.x() + terrain.layout().width / 2) / terrain.spacing_x());
      const auto j = std::llround((v.z() + terrain.layout().depth / 2) / terrain.spacing_z());
      const Vec sample = terrain.vertex(i, j);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        worst = std::max(worst, std::abs(v[static_cast<int>(axis)] - sample[axis]));
        largest = std::max(largest, std::abs(sample[axis]));
      }
    }
  }
  CHECK(worst <= within_rounding(1e-14) * largest);
}

}  // namespace

TEST_CASE_FIXTURE(OdeSession, "the grid of every landscape is found at any place, finite or infinite") {
  Random random(31);
  for (const Landscape& landscape : landscapes()) {
    CAPTURE(landscape.name);
    for (const bool repeats : {false, true}) {
      CAPTURE(repeats);
      for (int k = 0; k < 20; ++k) {
        CAPTURE(k);
        const Terrain::Layout layout{11 + k % 7, 10 + k % 5, random.uniform(0.5, 50), random.uniform(0.5, 50), repeats};
        const Terrain terrain(layout, landscape.height);
        const Geom geom(terrain.create());
        HeightfieldProbe& probe = HeightfieldProbe::looking_at(geom);
        const Facet spot = facet_near(probe, terrain, random.uniform(-1, 2), random.uniform(-1, 2));
        bool is_plane = false;
        // The reach is for bodies from a hundredth of a cell to four cells.
        const double reach = terrain.spacing_x() * std::pow(10, random.uniform(-2, 0.6));
        std::optional<FoundGrid> found = find_grid(probe, spot, reach, is_plane);
        if (!found) {
          // The whole neighbourhood is a plane, which shows no samples.
          REQUIRE(is_plane);
          found = find_grid(probe, spot, 6 * std::max(terrain.spacing_x(), terrain.spacing_z()), is_plane);
        }
        REQUIRE(found);
        check_axis(found->grid.x, layout.width / (layout.columns - 1), layout.width / 2, layout.columns, repeats);
        check_axis(found->grid.z, layout.depth / (layout.rows - 1), layout.depth / 2, layout.rows, repeats);
      }
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "small grids and long cells are found") {
  for (const std::pair<int, int>& size : {std::pair(2, 2), std::pair(2, 3), std::pair(3, 2), std::pair(3, 3), std::pair(2, 40)}) {
    const int columns = size.first;
    const int rows = size.second;
    CAPTURE(columns);
    CAPTURE(rows);
    for (unsigned seed = 0; seed < 20; ++seed) {
      CAPTURE(seed);
      const Terrain terrain({columns, rows, 3, 5}, rough(seed, 1));
      const Geom geom(terrain.create());
      HeightfieldPatch patch;
      const Region region{-1, 0.7, -2, 2};
      check_triangles(patch.read(HeightfieldProbe::looking_at(geom), region), terrain, region);
    }
  }
  const Terrain terrain({21, 21, 1, 60}, rough(3, 1));
  const Geom geom(terrain.create());
  HeightfieldPatch patch;
  const Region region{-0.21, 0.11, -4, 4};
  check_triangles(patch.read(HeightfieldProbe::looking_at(geom), region), terrain, region);
}

TEST_CASE_FIXTURE(OdeSession, "the vertices of the triangles are the samples, from every source") {
  Random random(32);
  for (const Source source : {Source::Callback, Source::Byte, Source::Short, Source::Single, Source::Double}) {
    CAPTURE(static_cast<int>(source));
    for (const bool repeats : {false, true}) {
      CAPTURE(repeats);
      const Terrain terrain({17, 12, 6.1, 7.3, repeats, source, 0.013, 0.7}, rough(5, 100));
      const Geom geom(terrain.create());
      HeightfieldPatch patch;
      patch.read(HeightfieldProbe::looking_at(geom), {-1, 1, -1, 1});  // before that, a small region is part of one plane
      for (int k = 0; k < 50; ++k) {
        CAPTURE(k);
        const double limit = repeats ? 12 : 3;
        const double x = random.uniform(-limit, limit);
        const double z = random.uniform(-limit, limit);
        const double size = std::pow(10, random.uniform(-2, 0.5));
        const Region region{x - size, x + size, z - size, z + size};
        check_triangles(patch.read(HeightfieldProbe::looking_at(geom), region), terrain, region);
      }
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "a query sees the changes of the program") {
  Terrain terrain({9, 9, 8, 8}, rough(6, 1));
  const Geom geom(terrain.create());
  HeightfieldPatch patch;
  const Region region{-1.5, 2, -2, 1.2};
  check_triangles(patch.read(HeightfieldProbe::looking_at(geom), region), terrain, region);
  terrain.set(5, 4, 0.5);
  terrain.set(4, 4, 0.25);
  check_triangles(patch.read(HeightfieldProbe::looking_at(geom), region), terrain, region);
  // The changes: the same extent with another number of samples, another extent, and an infinite field.
  terrain.build({14, 11, 8, 8}, rough(7, 1));
  check_triangles(patch.read(HeightfieldProbe::looking_at(geom), region), terrain, region);
  terrain.build({14, 11, 7, 9}, rough(8, 1));
  check_triangles(patch.read(HeightfieldProbe::looking_at(geom), region), terrain, region);
  terrain.build({14, 11, 7, 9, true}, rough(9, 1));
  check_triangles(patch.read(HeightfieldProbe::looking_at(geom), region), terrain, region);
}

TEST_CASE_FIXTURE(OdeSession, "a heightfield built anew, or another one at its address, is read again") {
  Random random(33);
  const std::vector<Landscape> all = landscapes();
  constexpr std::array<int, 10> kCounts = {3, 4, 5, 6, 7, 9, 11, 13, 17, 33};  // some are finer than others by a whole factor
  const auto any_of = [&](const auto& list) {
    return list[static_cast<std::size_t>(random.uniform(0, static_cast<double>(list.size())))];
  };
  Terrain terrain({5, 5, 8, 8}, all[0].height);
  const Geom geom(terrain.create());
  HeightfieldPatch patch;
  int wrong = 0;
  for (int k = 0; k < 3000; ++k) {
    if (k % 10 == 0) {
      const Landscape landscape = any_of(all);
      terrain.build({any_of(kCounts), any_of(kCounts), 8, 8, k % 30 == 0}, landscape.height);
    }
    const double x = random.uniform(-3.5, 3.5);
    const double z = random.uniform(-3.5, 3.5);
    const double size = std::pow(10, random.uniform(-1.5, 0));
    double worst = 0;
    for (const MeshTriangle& triangle : patch.read(HeightfieldProbe::looking_at(geom), {x - size, x + size, z - size, z + size})) {
      const Vector3 middle = (triangle.vertices[0] + triangle.vertices[1] + triangle.vertices[2]) / 3;
      worst = std::max(worst, std::abs(middle.y() - terrain.surface(middle.x(), middle.z())) / (1 + std::abs(middle.y())));
    }
    if (worst > within_rounding(1e-12)) ++wrong;
  }
  // In single precision the grid of one field in 240 is not found. Such a field is read at points of its surface.
  CHECK(wrong <= (kIsSinglePrecision ? 3000 / 240 : 0));
}

TEST_CASE_FIXTURE(OdeSession, "the grid of an infinite heightfield is valid far from the origin") {
  const Terrain terrain({7, 9, 2.3, 3.1, true}, rough(11, 0.3));
  const Geom geom(terrain.create());
  for (const double far : {-1e3, 1e4, -1e5}) {
    CAPTURE(far);
    HeightfieldPatch patch;  // finds the grid at this place
    const Region region{far, far + 0.9, 0.5 * far, 0.5 * far + 1.1};
    for (const MeshTriangle& triangle : patch.read(HeightfieldProbe::looking_at(geom), region)) {
      for (const Vector3& v : triangle.vertices) {
        const auto i = std::llround((v.x() + 1.15) / terrain.spacing_x());
        const auto j = std::llround((v.z() + 1.55) / terrain.spacing_z());
        const Vec sample = terrain.vertex(i, j);
        CHECK(std::abs(v.x() - sample[0]) < within_rounding(1e-15) * std::abs(far));
        CHECK(std::abs(v.z() - sample[2]) < within_rounding(1e-15) * std::abs(far));
        CHECK(std::abs(v.y() - sample[1]) < within_rounding(4e-15) * std::abs(far));
      }
    }
    // The grid is found near the origin and used far away.
    HeightfieldPatch other;
    other.read(HeightfieldProbe::looking_at(geom), {-0.4, 0.5, -0.4, 0.5});
    CHECK(!other.read(HeightfieldProbe::looking_at(geom), region).empty());
  }
  HeightfieldPatch patch;
  CHECK_THROWS_AS(patch.read(HeightfieldProbe::looking_at(geom), {1e12, 1e12 + 1, 0, 1}), std::domain_error);
}

TEST_CASE_FIXTURE(OdeSession, "a plane heightfield shows no grid and is read as a plane") {
  const auto slope = [](int i, int j) { return 0.5 * i - 0.25 * j; };
  for (const Terrain::Height& height : {Terrain::Height([](int, int) { return 0.3; }), Terrain::Height(slope)}) {
    const Terrain terrain({17, 17, 16, 16}, height);
    const Geom geom(terrain.create());
    HeightfieldPatch patch;
    const std::span<const MeshTriangle> triangles = patch.read(HeightfieldProbe::looking_at(geom), {-1.2, 0.4, 2, 3.7});
    REQUIRE(triangles.size() >= 2);
    for (const MeshTriangle& triangle : triangles) {
      for (const Vector3& v : triangle.vertices) CHECK(std::abs(v.y() - terrain.surface(v.x(), v.z())) < within_rounding(1e-14));
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "samples that are NaN are holes") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  Terrain terrain({9, 9, 8, 8}, rough(12, 1));
  terrain.set(4, 4, kNan);
  terrain.set(1, 7, kNan);
  const Geom geom(terrain.create());
  HeightfieldPatch patch;
  const Region all{-4, 4, -4, 4};
  const std::span<const MeshTriangle> triangles = patch.read(HeightfieldProbe::looking_at(geom), all);
  CHECK(triangles.size() == 2 * 64 - 2 * 6);
  for (const MeshTriangle& triangle : triangles) {
    for (const Vector3& v : triangle.vertices) CHECK(v.allFinite());
  }
  terrain.build({9, 9, 8, 8}, [](int, int) { return kNan; });
  CHECK(patch.read(HeightfieldProbe::looking_at(geom), all).empty());
}

TEST_CASE_FIXTURE(OdeSession, "a region with too many cells is read at points of the surface") {
  const Terrain terrain({1201, 1201, 12, 12}, hills(0.1, 0.02));
  const Geom geom(terrain.create());
  HeightfieldPatch patch;
  const std::span<const MeshTriangle> triangles = patch.read(HeightfieldProbe::looking_at(geom), {-6, 6, -6, 6});
  CHECK(triangles.size() == 2 * 512 * 512);
  for (std::size_t k = 0; k < triangles.size(); k += 97) {
    const Vector3& v = triangles[k].vertices[0];
    if (std::abs(v.x()) < 5.99 && std::abs(v.z()) < 5.99)
      CHECK(std::abs(v.y() - terrain.surface(v.x(), v.z())) < within_rounding(1e-13));
  }
}
