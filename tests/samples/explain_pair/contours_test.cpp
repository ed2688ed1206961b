// Tests of contour lines and other elements of the maps.
#include "method/contours.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace explain_pair;

namespace {

double area_of(const std::vector<Polyline>& polygons) {
  double twice = 0;
  for (const Polyline& polygon : polygons) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vector2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
      twice += a.x() * b.y() - a.y() * b.x();
    }
  }
  return std::abs(twice) / 2;
}

/// The height of a cone over a point.
Grid cone(std::size_t columns, std::size_t rows, const Vector2& top) {
  Grid grid(columns, rows);
  grid.fill([&](double column, double row) { return -(Vector2(column, row) - top).norm(); });
  return grid;
}

}  // namespace

TEST_CASE("contours: a disc has its area, and a ring has its hole") {
  const Grid grid = cone(81, 81, {40, 40});
  CHECK(area_of(superlevel_polygons(grid, -30)) == doctest::Approx(900 * std::numbers::pi).epsilon(0.002));
  CHECK(superlevel_polygons(grid, 1).empty());
  Grid ring(81, 81);
  ring.fill([](double column, double row) { return -std::abs((Vector2(column, row) - Vector2(40, 40)).norm() - 20); });
  const std::vector<Polyline> polygons = superlevel_polygons(ring, -5);
  REQUIRE(polygons.size() == 2);
  // One runs in the other direction.
  CHECK(area_of(polygons) == doctest::Approx(std::numbers::pi * (625 - 225)).epsilon(0.005));
}

TEST_CASE("contours: an area at the border is closed along the border, and its line is open") {
  const Grid grid = cone(41, 41, {0, 20});
  const std::vector<Polyline> polygons = superlevel_polygons(grid, -10);
  REQUIRE(polygons.size() == 1);
  CHECK(area_of(polygons) == doctest::Approx(50 * std::numbers::pi).epsilon(0.01));
  const std::vector<Polyline> lines = without_border(polygons, grid);
  REQUIRE(lines.size() == 1);
  for (const Vector2& point : lines[0]) CHECK((point - Vector2(0, 20)).norm() == doctest::Approx(10).epsilon(0.01));
  CHECK(std::abs(lines[0].front().y() - lines[0].back().y()) == doctest::Approx(20).epsilon(0.01));
  CHECK(area_of(superlevel_polygons(grid, -100)) == doctest::Approx(1600));
  CHECK(without_border(superlevel_polygons(grid, -100), grid).empty());
}

TEST_CASE("contours: two opposite corners of a cell are joined if the middle is high") {
  Grid grid(2, 2);
  const auto fill = [&](double low) { grid.fill([low](double column, double row) { return column == row ? 1 : low; }); };
  fill(-0.5);
  CHECK(superlevel_polygons(grid, 0).size() == 1);
  fill(-2);
  CHECK(superlevel_polygons(grid, 0).size() == 2);
}

TEST_CASE("contours: a simplified line stays within its error") {
  Polyline line;
  for (int k = 0; k <= 1000; ++k) line.emplace_back(0.1 * k, 10 * std::sin(0.1 * k));
  const Polyline few = simplified(line, 0.2);
  CHECK(few.size() < 200);
  CHECK(few.front() == line.front());
  CHECK(few.back() == line.back());
  for (const Vector2& point : line) {
    double nearest = 1e300;
    for (std::size_t k = 0; k + 1 < few.size(); ++k) {
      const Vector2 along = few[k + 1] - few[k];
      const double share = std::clamp((point - few[k]).dot(along) / along.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (point - few[k] - share * along).norm());
    }
    CHECK(nearest <= 0.2 + 1e-12);
  }
}

TEST_CASE("contours: the levels have round steps") {
  CHECK(round_step(10, 10) == doctest::Approx(1));
  CHECK(round_step(11, 10) == doctest::Approx(2));
  CHECK(round_step(0.0034, 10) == doctest::Approx(0.0005));
  CHECK(round_step(6e5, 10) == doctest::Approx(1e5));
}
