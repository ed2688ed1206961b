// Tests of meshes of bodies: vertices on the boundary, closed, oriented, within the chord error.
#include "supernormal/shapes/tessellation.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <supernormal/shapes/box.hpp>
#include <supernormal/shapes/capsule.hpp>
#include <supernormal/shapes/cylinder.hpp>
#include <supernormal/shapes/ellipsoid.hpp>
#include <supernormal/shapes/rounded.hpp>
#include <supernormal/shapes/superellipsoid.hpp>
#include <supernormal/shapes/superovoid.hpp>
#include <utility>
#include <vector>

#include "support/draw.hpp"

using namespace supernormal;

namespace {

/// Every edge belongs to two triangles, which run along it in opposite directions.
void check_closed(const Tessellation& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++directed[{triangle[k], triangle[(k + 1) % 3]}];
  }
  const auto is_shared = [&](const auto& edge) {
    return edge.second == 1 && directed.count({edge.first.second, edge.first.first}) == 1;
  };
  CHECK(std::all_of(directed.begin(), directed.end(), is_shared));
  // Euler: a sphere.
  CHECK(mesh.points.size() + mesh.triangles.size() == directed.size() / 2 + 2);
}

double volume(const Tessellation& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) sum += mesh.points[a].dot(mesh.points[b].cross(mesh.points[c])) / 6;
  return sum;
}

/// m; how far the boundary is beyond the mesh: along any normal, no vertex reaches as far as the body by more than this.
double farthest_beyond(const Shape& shape, const Tessellation& mesh) {
  test::Draw draw(5);
  double farthest = 0;
  for (int k = 0; k < test::draws(3000); ++k) {
    const Vector3 n = draw.direction();
    double reach = -1e300;
    for (const Vector3& point : mesh.points) reach = std::max(reach, n.dot(point));
    farthest = std::max(farthest, shape.support(n) - reach);
  }
  return farthest;
}

/// Closed, with its vertices on the boundary and its chords within the error, a fraction of the smallest half-extent.
void check_meshes(double chord_error) {
  CAPTURE(chord_error);
  for (const double exponent : test::some_of(std::vector{1.05, 1.5, 2.0, 3.0, 8.0, 30.0, 100.0})) {
    CAPTURE(exponent);
    for (const double other : {1.05, 2.0, 100.0}) {
      CAPTURE(other);
      for (const Vector3& axes : {Vector3(1, 1, 1), Vector3(1, 0.6, 0.3), Vector3(1, 1, 0.01)}) {
        CAPTURE(axes.z());
        const Superellipsoid body(axes, exponent, other);
        const Tessellation mesh = tessellate(body, chord_error * axes.minCoeff());
        CHECK(mesh.normals.size() == mesh.points.size());
        double farthest = 0;  // of a vertex from the boundary
        for (std::size_t k = 0; k < mesh.points.size(); ++k) {
          farthest = std::max(farthest, std::abs(mesh.normals[k].dot(mesh.points[k]) - body.support(mesh.normals[k])));
        }
        CHECK(farthest <= 1e-12);
        check_closed(mesh);
        const double exact = body.mass_properties().volume;
        CHECK(volume(mesh) <= exact * (1 + 1e-9));
        CHECK(volume(mesh) >= exact * (1 - 6 * chord_error));
        CHECK(farthest_beyond(body, mesh) <= chord_error * axes.minCoeff());
      }
    }
  }
}

}  // namespace

TEST_CASE("a flat face takes few triangles") {
  // A die whose faces are flat to a thousandth, and a sphere of the same size.
  const std::size_t die = tessellate(Superellipsoid(Vector3(1, 1, 1), 100, 100), 0.01).triangles.size();
  const std::size_t sphere = tessellate(Ellipsoid(Vector3(1, 1, 1)), 0.01).triangles.size();
  CHECK(die < sphere);
}

TEST_CASE("a rounded body's mesh is closed, too") {
  const auto core = std::make_shared<Superellipsoid>(Vector3(0.9, 0.8, 0.7), 20, 20);
  const Rounded body(core, 0.1);
  const Tessellation mesh = tessellate(body, 0.005);
  check_closed(mesh);
  CHECK(farthest_beyond(body, mesh) <= 0.005);
}

TEST_CASE("a mesh of a body is closed, has its vertices on the boundary and its chords within the error") { check_meshes(0.05); }
TEST_CASE("a fine mesh of a body, too") { check_meshes(0.01); }

TEST_CASE("bodies with faces, edges and vertices: closed, and within the chord error") {
  const std::vector<std::shared_ptr<Shape>> bodies = {std::make_shared<Box>(Vector3(1, 0.7, 0.2)),
                                                      std::make_shared<Capsule>(0.3, 1), std::make_shared<Cylinder>(0.5, 0.4),
                                                      std::make_shared<Superovoid>(Vector3(0.5, 0.5, 1), 2, 2, 0.4, 0.4)};
  for (const auto& body : bodies) {
    const Tessellation mesh = tessellate(*body, 0.01);
    check_closed(mesh);
    CHECK(farthest_beyond(*body, mesh) <= 0.01);
  }
}

TEST_CASE("a chord error out of range is refused") {
  const Ellipsoid body(Vector3(2, 1, 1));
  for (const double wrong : {0.0, -1.0, 1e-6, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    CHECK_THROWS_WITH_AS(tessellate(body, wrong), doctest::Contains("chord_error ="), std::invalid_argument);
  }
}

TEST_CASE(
    "a shape that delivers points that are not finite, or beyond its bounding radius, is refused and not halved without end") {
  class Broken final : public Shape {
   public:
    explicit Broken(double x) : x_(x) {}
    void evaluate(const Vector3& n, Order /*order*/, Jet& jet) const override {
      jet.h = 1;
      jet.r = n;
      if (n.minCoeff() > 0.4) jet.r.x() = x_;
    }

   private:
    double x_;
  };
  for (const double x : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300, -5.0}) {
    CHECK_THROWS_WITH_AS(tessellate(Broken(x), 0.01), doctest::Contains("must be within its bounding radius"), std::domain_error);
  }
}
