#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "input/read_data.hpp"
#include "input/table.hpp"
#include "model/empty_space.hpp"
#include "model/fit_error.hpp"
#include "model/fit_union.hpp"
#include "output/report.hpp"
#include "output/results.hpp"
#include "study/truth.hpp"
#include "support/temporary_folder.hpp"

using namespace fit;

namespace {

Body oblong(Family family = Family::Superellipsoid) {
  return {family, {3, -2, 5}, Eigen::Quaterniond(0.7, 0.3, -0.2, 0.5).normalized(), {1.5, 1.1, 0.8}, 2.5, 4, 0};
}

const Body kSphere{Family::Ellipsoid, Vector3::Zero(), Eigen::Quaterniond::Identity(), Vector3::Ones()};

/// A bent body, which no convex body fits: balls of radius 0.3 along a third of a circle of radius 1.
std::vector<Body> banana() {
  std::vector<Body> balls;
  for (int i = 0; i < 9; ++i) {
    const double angle = 2.1 * i / 8;
    balls.push_back({Family::Ellipsoid, {std::cos(angle), std::sin(angle), 0}, Eigen::Quaterniond::Identity(), {0.3, 0.3, 0.3}});
  }
  return balls;
}

/// The error of one body that is fitted to points of a banana.
FitError error_of(const Cloud& cloud, Sides sides) {
  const FittedBody fitted = fit_body(cloud, {.family = Family::Superellipsoid, .sides = sides});
  FitError error = find_error(std::vector<Body>{fitted.body}, {cloud, {}, ""});
  add_uncertainty(error, std::vector{fitted});
  return error;
}

/// An L of three cubes of side 1, as a closed mesh.
Data make_angle() {
  Data data;
  constexpr std::array<std::array<double, 2>, 6> kOutline = {{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}};
  for (const double z : {0.0, 1.0}) {
    for (const auto& [x, y] : kOutline) data.vertices.points.emplace_back(x, y, z);
  }
  constexpr std::array<Triangle, 4> kCap = {{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}};
  for (const auto& [a, b, c] : kCap) {
    data.triangles.push_back({a, c, b});
    data.triangles.push_back({a + 6, b + 6, c + 6});
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t next = (i + 1) % 6;
    data.triangles.push_back({i, next, next + 6});
    data.triangles.push_back({i, next + 6, i + 6});
  }
  return data;
}

/// Points of a square table of half side 4 below the body, with noise.
void add_table(Cloud& cloud, int count) {
  std::mt19937_64 random(5);
  for (int i = 0; i < count; ++i) {
    const double x = 8 * uniform(random) - 4, y = 8 * uniform(random) - 4, z = 0.01 * (uniform(random) - 0.5);
    cloud.points.emplace_back(3 + x, -2 + y, 3.4 + z);
  }
}

}  // namespace

TEST_CASE("a body of the families enters no empty space, with and without normals, noise or its other half") {
  for (const bool has_normals : {false, true}) {
    for (const double noise : {0.0, 0.02}) {
      Body truth = oblong();
      truth.delta = 30;
      const Cloud cloud = scatter(truth, {.points = 2000, .noise = noise, .has_normals = has_normals});
      const Extent extent = extent_of(cloud.points);
      const EmptySpace space = find_empty_space(normalized(cloud, extent));
      const Body body = moved(truth, 1 / extent.size, -extent.centre / extent.size);
      CHECK(penalty_of(body, space) < 1e-6);
      Body longer = body;
      longer.half_axes *= 1.3;
      CHECK(penalty_of(longer, space) > 1e-3);
    }
  }
}

TEST_CASE("the empty space begins at a margin from a sphere and grows with its distance, also of a moved sphere") {
  const EmptySpace space = find_empty_space(scatter(kSphere, {.points = 20000, .has_normals = true}));
  const EmptySpace larger = moved(space, 3, {1, 2, 0.5});
  double last = 0;
  for (const double radius : {0.3, 0.95, 1.01, 1.3, 1.6, 3.0}) {
    const Vector3 x = radius * Vector3(2, -1, 2).normalized();
    const EmptySpace::Excess excess = space.beyond(x), image = larger.beyond(3 * x + Vector3(1, 2, 0.5));
    CHECK(image.length == doctest::Approx(3 * excess.length));
    CHECK((excess.length > last) == (radius > 1.1));
    last = excess.length;
    for (int i = 0; i < 3; ++i) {
      const Vector3 step = 1e-6 * Vector3::Unit(i);
      const double difference = (space.beyond(x + step).length - space.beyond(x - step).length) / 2e-6;
      CHECK(excess.slope[i] == doctest::Approx(difference).epsilon(1e-4));
      CHECK(image.slope[i] == doctest::Approx(excess.slope[i]));
    }
  }
}

TEST_CASE("within a bound a body costs nothing, and beyond it as much with fine directions as with rough ones") {
  EmptySpace space = find_empty_space(scatter(kSphere, {.points = 20000, .has_normals = true}));
  space.margin = 0.2;
  const auto penalty_at = [&](double radius) { return penalty_of(moved(kSphere, radius, Vector3::Zero()), space); };
  CHECK(penalty_at(1.15) == 0);
  const double rough = penalty_at(1.3);
  // A square of a length of 0.1, to the error of the grid.
  CHECK(rough == doctest::Approx(space.weight * 0.01).epsilon(0.3));
  space.is_fine = true;
  CHECK(penalty_at(1.3) == doctest::Approx(rough).epsilon(0.02));
  space.weight *= 3;
  CHECK(penalty_at(1.3) == doctest::Approx(3 * rough).epsilon(0.02));
}

TEST_CASE("a thin body that extends beyond the data by its tips costs more than one of full width that is as large") {
  const EmptySpace space = find_empty_space(scatter(kSphere, {.points = 2000}));
  Body spike = kSphere;
  spike.half_axes = {1.5, 0.05, 0.05};
  CHECK(penalty_of(spike, space) > 0.1);
  CHECK(penalty_of(kSphere, space) == 0);
}

TEST_CASE("the openness of a surface is the missing fraction of a sphere, and what is hidden is not outside") {
  Cloud whole = scatter(kSphere, {.points = 4000, .has_normals = true}), cap;
  for (const double height : {-1.1, -0.5, 0.0}) {  // of the plane that cuts the sphere
    cap = {};
    for (std::size_t i = 0; i < whole.points.size(); ++i) {
      if (whole.points[i].z() < height) continue;
      cap.points.push_back(whole.points[i]);
      cap.normals.push_back(whole.normals[i]);
    }
    CHECK(make_surface(cap).openness == doctest::Approx(std::max(0.0, (1 + height) / 2)).epsilon(0.1).scale(0.1));
  }
  const Vector3 hidden(0, 0, -0.3), outside(0, 0, 1.2);
  CHECK_FALSE(is_outside(make_surface(cap), hidden));
  CHECK(is_outside(make_surface(cap), outside));
}

TEST_CASE("between the points of a cloud a body does not extend beyond them, but one that is larger does") {
  std::mt19937_64 random(5);
  std::normal_distribution<double> gauss;
  for (const std::size_t count : {500U, 1500U, 5000U}) {
    Cloud cloud;
    for (std::size_t i = 0; i < count; ++i)
      cloud.points.push_back(Vector3(gauss(random), gauss(random), gauss(random)).normalized());
    for (const double radius : {1.0, 1.1, 1.2}) {
      CAPTURE(count);
      CAPTURE(radius);
      const Body ball{Family::Ellipsoid, Vector3::Zero(), Eigen::Quaterniond::Identity(), Vector3::Constant(radius)};
      const FitError error = find_distances(std::vector{ball}, {cloud, {}, ""});
      CHECK(std::abs(error.reach - (radius - 1)) < 0.04);
    }
  }
}

TEST_CASE("the surface of a coin and of a needle is measured, too") {
  for (const Vector3& half_axes : {Vector3(1, 1, 1e-4), Vector3(1, 1e-4, 1e-4)}) {
    const std::vector<Body> body = {{Family::Ellipsoid, Vector3::Zero(), Eigen::Quaterniond::Identity(), half_axes}};
    const FitError error =
        find_distances(body, {{{Vector3(1, 0, 0), Vector3(-1, 0, 0), Vector3(0, half_axes.y(), 0)}, {}}, {}, ""});
    CHECK(error.rms < 1e-9);
    CHECK(error.radius > 0.9);
  }
}

TEST_CASE("winding numbers distinguish inside and outside of a concave body, also of points without normals") {
  const std::vector<Body> balls = banana();
  const std::vector<DistanceFunction> functions(balls.begin(), balls.end());
  const Surface surface = make_surface(scatter_union(balls, 400, 0, 1));
  int wrong = 0, inside = 0;
  std::mt19937_64 random(3);
  for (int i = 0; i < 1500; ++i) {
    const Vector3 x(3 * uniform(random) - 1.2, 2.4 * uniform(random) - 0.6, uniform(random) - 0.5);
    const double distance = least_distance(functions, x);
    if (std::abs(distance) < 0.1) continue;
    inside += distance < 0 ? 1 : 0;
    wrong += (winding_number(surface, x) > 0.5) != (distance < 0) ? 1 : 0;
  }
  CHECK(inside > 20);
  CHECK(wrong == 0);
}

TEST_CASE("a body ends with the data of a bent object") {
  const Cloud cloud = scatter_union(banana(), 300, 0.003, 1);
  const FitError kept = error_of(cloud, Sides::Auto), free = error_of(cloud, Sides::Some);
  CHECK(kept.reach < 0.25 * kept.radius);
  CHECK(kept.reach < 0.7 * free.reach);
  const double volume = integrate_union(banana()).solid.volume;
  CHECK(std::abs(kept.body.volume - volume) < 2 * kept.volume_error);
}

TEST_CASE("half of a body of the families is not kept from extending beyond the data") {
  const Body truth = oblong();
  const Cloud half = scatter(truth, {.points = 1000, .noise = 0.01, .is_half_missing = true});
  const FittedBody fitted = fit_body(half, {.family = truth.family});
  CHECK_FALSE(fitted.is_bounded_by_data);
  CHECK(fitted.body.half_axes.x() == doctest::Approx(1.5).epsilon(0.02));
  // The error of the volume says that the other half follows; unless it is large.
  FitError error = find_error(std::vector{fitted.body}, {half, {}, ""});
  CHECK(doubts_about(std::vector{fitted}, error).at(0).find("scan more sides") != std::string::npos);
  add_uncertainty(error, std::vector{fitted});
  CHECK(error.reach > 0.2 * error.radius);
  CHECK(doubts_about(std::vector{fitted}, error).empty());
  error.volume_error = 0.2 * error.body.volume;
  CHECK(doubts_about(std::vector{fitted}, error).size() == 1);
}

TEST_CASE("the volume of a closed mesh counts, and its error includes what is missed") {
  const Data data = make_angle();
  REQUIRE(is_closed(data));
  const Cloud points = sample_triangles(data.vertices.points, data.triangles, 2000, 1);
  FitSettings settings{.family = {}, .noise = Noise::AlongNormal, .rejects_outliers = false, .is_whole = true};
  for (const bool has_volume : {false, true}) {
    if (has_volume) settings.volume = volume_target(data);
    const FittedBody fitted = fit_body(points, settings);
    FitError error = find_error(std::vector<Body>{fitted.body}, data);
    add_uncertainty(error, std::vector{fitted});
    CHECK(error.data.volume == doctest::Approx(3));
    CHECK(std::abs(error.body.volume - 3) <= error.volume_error);
    CHECK((std::abs(error.body.volume / 3 - 1) < 0.03) == has_volume);
    CHECK_FALSE(doubts_about(std::vector{fitted}, error).empty());
  }
}

TEST_CASE("errors of volume and moments of inertia agree with the spread of repeated fits") {
  const Body truth = oblong();
  const FitError exact = find_error(std::vector<Body>{truth}, {scatter(truth, {.points = 300}), {}, ""});
  constexpr int kFits = 20;
  double square = 0;
  for (int k = 0; k < kFits; ++k) {
    const Cloud cloud = scatter(truth, {.points = 400, .noise = 0.01, .seed = static_cast<std::uint64_t>(k) + 1});
    const FittedBody fitted = refine_body(truth, cloud);
    FitError error = find_error(std::vector<Body>{fitted.body}, {cloud, {}, ""});
    error.mean = 0;  // noise moves points outwards; here the errors of the parameters are of interest
    add_uncertainty(error, std::vector{fitted});
    square += std::pow((error.body.volume - exact.body.volume) / error.volume_error, 2) / kFits;
  }
  // The mean of 20 squares is outside this range once in 10^3.
  CHECK(square > 0.3);
  CHECK(square < 2.3);
}

TEST_CASE("an eighth of outliers around a body does not change it") {
  const Body truth = oblong();
  Cloud cloud = scatter(truth, {.points = 1000, .noise = 0.005});
  std::mt19937_64 random(9);
  for (int i = 0; i < 140; ++i) {
    const double x = uniform(random) - 0.5, y = uniform(random) - 0.5, z = uniform(random) - 0.5;
    cloud.points.emplace_back(truth.position + 6 * Vector3(x, y, z));
  }
  const FittedBody fitted = fit_body(cloud, {.family = truth.family});
  Eigen::Matrix3d axes;
  const Gradient difference = deviation(aligned(fitted.body, truth, axes), truth);
  CHECK(difference.segment<3>(kLogAxes).cwiseAbs().maxCoeff() < 0.01);
  CHECK(fitted.outliers.size() > 100);
  CHECK(fitted.outliers.size() < 150);
}

TEST_CASE("the plane under an object is removed, but no face of it") {
  const Body truth = oblong();
  Data data{scatter(truth, {.points = 1000, .noise = 0.005}), {}, ""};
  Data alone = data;
  CHECK(remove_table(alone).empty());
  CHECK(alone.vertices.points.size() == 1000);
  add_table(data.vertices, 800);
  CHECK(remove_table(data) == "800 points of a plane under the object are left out (--table keep: they are not)");
  CHECK(data.vertices.points.size() == 1000);
  Data angle = make_angle();
  CHECK(remove_table(angle).empty());
  CHECK(is_closed(angle));
  // A large table under the angle: only its two triangles go.
  for (const Vector3& corner : {Vector3(-1.5, -1.5, 0), Vector3(3.5, -1.5, 0), Vector3(3.5, 3.5, 0), Vector3(-1.5, 3.5, 0)})
    angle.vertices.points.push_back(corner);
  angle.triangles.push_back({12, 13, 14});
  angle.triangles.push_back({12, 14, 15});
  CHECK(remove_table(angle).find("triangles of a plane under the object are left out") != std::string::npos);
  CHECK(angle.vertices.points.size() == 12);
}

TEST_CASE_FIXTURE(TemporaryFolder, "the objects of a file are read together or one by one") {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  const std::string path = write("two.obj", corners +
                                                "g small\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\nv 5 0 0\nv 7 0 0\nv 5 2 0\nv "
                                                "5 0 2\ng large\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 5 8 7\n");
  CHECK(read_data(path, 1).triangles.size() == 8);
  const Data large = read_data(path, 1, "large");
  CHECK(large.triangles.size() == 4);
  CHECK(volume_target(large).volume == doctest::Approx(8.0 / 6));
  CHECK_THROWS_WITH_AS(read_data(path, 1, "medium"), doctest::Contains("no group \"medium\"; allowed: "), InputError);
  const std::string off = write("one.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  CHECK(volume_target(read_data(off, 0.1)).volume == doctest::Approx(1e-3 / 6));
  const std::string points = write("points.xyz", "1 2 3\n");
  CHECK_THROWS_WITH_AS(read_data(points, 1, "large"), doctest::Contains("a .xyz has no groups"), InputError);
}

TEST_CASE_FIXTURE(TemporaryFolder, "the aligned data lie in the frame of the grain, and the JSON has the numbers of the report") {
  FittedBody fitted;
  fitted.body = oblong();
  fitted.uncertainty.is_determined.fill(true);
  fitted.uncertainty.is_determined[kLogDelta] = false;
  const Data data{scatter(fitted.body, {.points = 300}), {}, ""};
  const Data aligned = read_data(write("aligned.ply", aligned_ply(data, std::vector{fitted})), 1);
  Body in_frame = fitted.body;
  in_frame.position.setZero();
  in_frame.orientation.setIdentity();
  const DistanceFunction function(in_frame);
  for (const Vector3& x : aligned.vertices.points) CHECK(std::abs(function.find(x)->distance) < 1e-7);
  const FitError error = find_error(std::vector<Body>{fitted.body}, data);
  Provenance provenance;
  provenance.name = "stone";
  provenance.source = "a scan";
  provenance.scale = 1e-3;
  provenance.density = 2600;
  provenance.is_mesh = true;
  provenance.open.single = 12;
  const std::string text = json_text(std::vector{fitted}, error, {"a doubt"}, provenance);
  for (const char* part :
       {R"("metres_per_unit_of_file": 0.001)", R"("density": 2600.0)", R"("kind": "open mesh")", R"("edges_with_one_triangle": 12)",
        R"("lengths": "m")", R"("inertia": "m^5, for density 1)", R"("name": "stone")", R"("family": "superellipsoid")",
        R"("delta": 2.5)", R"("delta_error": null)", R"("epsilon_error": 0.0)", R"("a doubt")"}) {
    CAPTURE(part);
    CHECK(text.find(part) != std::string::npos);
  }
}
