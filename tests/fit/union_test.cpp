#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "input/sampling.hpp"
#include "model/empty_space.hpp"
#include "model/fit_error.hpp"
#include "model/fit_union.hpp"
#include "study/truth.hpp"

using namespace fit;

namespace {

Body ellipsoid(const Vector3& position, const Vector3& half_axes) {
  return {Family::Ellipsoid, position, Eigen::Quaterniond::Identity(), half_axes};
}

}  // namespace

TEST_CASE("a dumbbell is fitted by two bodies") {
  const std::vector<Body> truth = make_compound("dumbbell");
  const Cloud cloud = scatter_union(truth, 700, 3e-4, 1);
  const std::vector<FittedBody> fitted = fit_union(cloud, 3, {.family = Family::Superellipsoid});
  REQUIRE(fitted.size() == 3);
  for (const Body& part : truth) {
    const auto nearest =
        std::ranges::min_element(fitted, {}, [&](const FittedBody& each) { return (each.body.position - part.position).norm(); });
    CHECK((nearest->body.position - part.position).norm() < 1e-3);
    CHECK((nearest->body.half_axes - part.half_axes).cwiseAbs().maxCoeff() < 1e-3);
    CHECK(std::abs(nearest->body.epsilon / part.epsilon - 1) < 0.1);
  }
}

TEST_CASE("two ellipsoids that overlap are fitted by two, and one by one") {
  const std::vector<Body> truth = {ellipsoid({-0.004, 0, 0}, {0.009, 0.007, 0.006}),
                                   ellipsoid({0.01, 0, 0}, {0.006, 0.005, 0.004})};
  const FitSettings settings{.family = Family::Ellipsoid};
  const std::vector<FittedBody> fitted = fit_union(scatter_union(truth, 250, 0, 1), 2, settings);
  REQUIRE(fitted.size() == 2);
  const std::size_t left = fitted[0].body.position.x() < fitted[1].body.position.x() ? 0 : 1;
  CHECK((fitted[left].body.position - truth[0].position).norm() < 1e-4);
  CHECK((fitted[1 - left].body.position - truth[1].position).norm() < 1e-4);
  CHECK(fit_union(scatter_union({truth[0]}, 250, 0, 1), 2, settings).size() == 1);
}

TEST_CASE("a union whose points hide a quarter of it is the whole union") {
  const std::vector<Body> truth = {ellipsoid({-4, 0, 0}, {9, 7, 6}), ellipsoid({8, 1, 0}, {6, 5, 4})};
  Cloud seen;
  for (const Vector3& x : scatter_union(truth, 500, 0.04, 1).points) {
    if (x.dot(Vector3(0.5, 0.3, 0.81)) < 2) seen.points.push_back(x);
  }
  const std::vector<FittedBody> fitted = fit_union(seen, 2, {.family = Family::Ellipsoid});
  REQUIRE(fitted.size() == 2);
  CHECK_FALSE(fitted[0].is_bounded_by_data);
  FitError error = find_error(bodies_of(fitted), {seen, {}, ""});
  add_uncertainty(error, fitted);
  CHECK(error.volume_error < 0.05 * error.body.volume);
  CHECK(std::abs(error.body.volume - integrate_union(truth).solid.volume) < 3 * error.volume_error);
}

TEST_CASE("the six bodies of an animal end with its points") {
  std::vector<Body> truth = {ellipsoid({0, 0, 0}, {1, 0.4, 0.45}), ellipsoid({1.2, 0, 0.3}, {0.35, 0.2, 0.25})};
  for (const double x : {-0.7, 0.7}) {
    for (const double y : {-0.25, 0.25}) truth.push_back(ellipsoid({x, y, -0.6}, {0.12, 0.1, 0.5}));
  }
  const Data data{scatter_union(truth, 500, 2e-3, 1), {}, ""};
  const std::vector<FittedBody> fitted = fit_union(data.vertices, 6, {.family = Family::Ellipsoid});
  const std::vector<Body> bodies = bodies_of(fitted);
  FitError error = find_error(bodies, data);
  add_uncertainty(error, fitted);
  CHECK(bodies.size() == 6);
  // The reach of the truth is the spacing of the points.
  CHECK(error.reach < 1.1 * find_error(truth, data).reach);
  CHECK(error.rms < 0.02 * error.radius);
  CHECK(std::abs(error.body.volume - integrate_union(truth).solid.volume) < 2 * error.volume_error);
}

TEST_CASE("the bound keeps a ball within the largest reach beyond a rounded cube") {
  // |x|^3 + |y|^3 + |z|^3 = 1 as a mesh. A ball of radius r about its centre reaches r - 1 beyond it, on the axes.
  constexpr std::uint32_t kSteps = 40;
  Data mesh;
  for (int face = 0; face < 6; ++face) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.points.size());
    for (std::uint32_t i = 0; i <= kSteps; ++i) {
      for (std::uint32_t j = 0; j <= kSteps; ++j) {
        const double up = face % 2 == 0 ? 1 : -1;
        Vector3 x;
        x[face / 2] = up;
        x[(face / 2 + 1) % 3] = up * (2.0 * i / kSteps - 1);  // the triangles face outwards
        x[(face / 2 + 2) % 3] = 2.0 * j / kSteps - 1;
        mesh.vertices.points.emplace_back(x / x.lpNorm<3>());
        const std::uint32_t k = first + i * (kSteps + 1) + j;
        if (i == kSteps || j == kSteps) continue;
        mesh.triangles.push_back({k, k + kSteps + 1, k + 1});
        mesh.triangles.push_back({k + 1, k + kSteps + 1, k + kSteps + 2});
      }
    }
  }
  const Cloud surface = sample_triangles(mesh.vertices.points, mesh.triangles, 20000, 1), cloud = thinned(surface, 3000);
  const Extent extent = extent_of(surface.points);
  FitSettings settings{.family = Family::Ellipsoid, .noise = Noise::AlongNormal, .rejects_outliers = false, .mesh = mesh};
  const FittedBody ball = refine_body(ellipsoid(Vector3::Zero(), Vector3::Ones()), cloud, settings);
  const double before = find_distances(std::vector{ball.body}, mesh).reach;
  settings.empty = moved(find_empty_space(normalized(surface, extent)), extent.size, extent.centre);
  const Union fitted = bounded({ball}, cloud, settings);
  REQUIRE(fitted.bodies.size() == 1);
  const FitError after = find_distances(std::vector{fitted.bodies[0].body}, mesh);
  const double most = std::max(kMostReach * after.radius, settings.empty.margin * extent.size);
  CHECK(before > 1.5 * most);
  CHECK(after.reach < 1.02 * most);
  CHECK(fitted.bodies[0].body.half_axes.isApproxToConstant(1 + most, 0.01));
  CHECK(fitted.bodies[0].is_bounded_by_data);
  const Body cube{Family::Superellipsoid, Vector3::Zero(), Eigen::Quaterniond::Identity(), Vector3::Ones(), 3, 3};
  CHECK_FALSE(refine_body(cube, cloud, settings).is_bounded_by_data);
}

TEST_CASE("a cube is fitted by one body, with and without noise") {
  // The edges are sharper than any body's, so two bodies fit slightly better than one.
  for (const double noise : {0.0, 0.01}) {
    Cloud cloud;
    for (int i = 0; i < 600; ++i) {
      const auto fraction = [&](double step) { return 2 * std::fmod(i * step, 1.0) - 1; };
      const int axis = i % 3;
      // Evenly distributed over a face, by the plastic number.
      Vector3 x(fraction(0.7548776662466927), fraction(0.5698402909980532), fraction(0.4301597090019468));
      x[axis] = (i % 2 == 0 ? 1 : -1) + noise * std::sin(37.0 * i * i);
      cloud.points.push_back(x);
    }
    const std::vector<FittedBody> fitted =
        fit_union(cloud, 2, {.family = {}, .noise = Noise::AlongNormal, .rejects_outliers = false, .is_whole = true});
    REQUIRE(fitted.size() == 1);
    CHECK(fitted[0].body.half_axes.isApproxToConstant(1, 5e-3));
  }
}
