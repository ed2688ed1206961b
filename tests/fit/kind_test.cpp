#include <doctest/doctest.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "kind/grain_kind.hpp"
#include "kind/kind_text.hpp"
#include "output/results.hpp"
#include "study/truth.hpp"

using namespace fit;

namespace {

/// A body of this size and shape, z being its middle axis, in a random orientation.
Body stone(double size, double b_over_a, double delta, double epsilon, std::mt19937_64& random) {
  Body body = random_superellipsoid(random);
  body.half_axes = {1, 0.5 * b_over_a, b_over_a};
  body.delta = delta;
  body.epsilon = epsilon;
  body.half_axes *= size / size_of(body);
  return body;
}

FittedBody exact(const Body& body) {
  FittedBody fitted;
  fitted.body = body;
  return fitted;
}

/// Stones whose ln sizes are ln(0.01 m) + ln(1.3) t for these t, of mean 0.
constexpr std::array kOffsets = {-1.5, -0.5, 0.0, 0.0, 0.5, 1.5};
const double kDeviationOfOffsets = 1;  // sqrt(5 / 5): of a sample

std::vector<Body> stones() {
  std::mt19937_64 random(7);
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < kOffsets.size(); ++i) {
    const double even = i % 2 == 0 ? 1 : -1;
    bodies.push_back(stone(0.01 * std::pow(1.3, kOffsets[i]), 0.8 + 0.05 * even, 2.5, 4 - 0.5 * even, random));
  }
  return bodies;
}

/// What the stones have in closed form.
void require_stones(const GrainKind& kind, double error) {
  CHECK(kind.body.family == Family::Superellipsoid);
  CHECK(kind.median == doctest::Approx(0.01).epsilon(error));
  CHECK(kind.geometric_deviation == doctest::Approx(std::pow(1.3, kDeviationOfOffsets)).epsilon(error));
  CHECK(size_of(kind.body) == doctest::Approx(kind.median).epsilon(1e-9));
  // Half of the stones are above the mean by an amount, half below: the deviation of a sample of six is sqrt(6/5) of it.
  const double sample = std::sqrt(6.0 / 5);
  CHECK(kind.b_over_a.mean == doctest::Approx(0.4).epsilon(error));
  CHECK(kind.b_over_a.deviation == doctest::Approx(0.025 * sample).epsilon(10 * error));
  CHECK(kind.c_over_a.mean == doctest::Approx(0.8).epsilon(error));
  CHECK(kind.c_over_a.deviation == doctest::Approx(0.05 * sample).epsilon(10 * error));
  CHECK(kind.delta.mean == doctest::Approx(2.5).epsilon(error));
  CHECK(kind.delta.deviation < 10 * error);
  CHECK(kind.epsilon.mean == doctest::Approx(4).epsilon(error));
  CHECK(kind.epsilon.deviation == doctest::Approx(0.5 * sample).epsilon(10 * error));
  CHECK(kind.body.half_axes.z() / kind.body.half_axes.x() == doctest::Approx(0.8).epsilon(error));
}

}  // namespace

TEST_CASE("a kind has the sizes, the mean shape and the spread of its bodies") {
  std::vector<FittedBody> fitted;
  for (const Body& body : stones()) fitted.push_back(exact(body));
  require_stones(find_kind(fitted), 1e-9);
  CHECK_THROWS_WITH_AS(find_kind(std::vector{fitted[0]}), "1 scans; a kind of grain takes at least 2", std::invalid_argument);
}

TEST_CASE("the kind of scanned bodies in any orientation is the kind of the bodies, one of them an ellipsoid") {
  std::vector<Body> bodies = stones();
  std::vector<FitsByAxis> fits;
  for (const Body& body : bodies) {
    const Cloud cloud = scatter(body, {.points = 500});
    // Begin with another axis as z: the fit of an ellipsoid has its shortest one there.
    const FittedBody first = fit_body(cloud, {.family = Family::Ellipsoid});
    REQUIRE(first.body.family == Family::Ellipsoid);
    fits.push_back(fit_each_axis(first, Family::Superellipsoid, cloud, {}));
  }
  REQUIRE(common_axis(fits) == 1);
  std::vector<FittedBody> fitted;
  fitted.reserve(fits.size());
  for (const FitsByAxis& each : fits) fitted.push_back(each[1].fitted);
  require_stones(find_kind(fitted), 1e-5);
}

TEST_CASE("ellipsoids and bodies of revolution have one frame only") {
  const Body body{Family::Ellipsoid, Vector3::Zero(), Eigen::Quaterniond::Identity(), {3, 2, 1}, 2, 2, 0};
  const Cloud cloud = scatter(body, {.points = 300});
  const FittedBody fitted = fit_body(cloud, {.family = Family::Ellipsoid});
  for (const RatedFit& each : fit_each_axis(fitted, Family::Ellipsoid, cloud, {}))
    CHECK(each.fitted.body.half_axes == fitted.body.half_axes);
  FitSettings round;
  round.family = Family::Superellipsoid;
  round.limits.has_round_section = true;
  const Body disc{Family::Superellipsoid, Vector3::Zero(), Eigen::Quaterniond::Identity(), {2, 2, 1}, 2, 4, 0};
  const Cloud points = scatter(disc, {.points = 300});
  const FittedBody revolved = fit_body(points, round);
  for (const RatedFit& each : fit_each_axis(revolved, Family::Superellipsoid, points, round))
    CHECK(each.fitted.body.half_axes == revolved.body.half_axes);
}

TEST_CASE("the taper of a kind is valid, however much the exponents differ") {
  std::vector<FittedBody> fitted;
  for (const double epsilon : {1.2, 2.0, 12.0}) {
    Body egg{Family::Superovoid, Vector3::Zero(), Eigen::Quaterniond::Identity(), {2, 2, 3}, 2, epsilon, 0};
    egg.taper = -taper_limit(epsilon);
    fitted.push_back(exact(egg));
  }
  const GrainKind kind = find_kind(fitted);
  CHECK(kind.body.taper == doctest::Approx(-taper_limit(kind.body.epsilon)));
  CHECK(size_of(kind.body) == doctest::Approx(kind.median));
}

// That falling_particles draws these sizes: grains_of_fit_test.sh.
TEST_CASE("the lines of a kind have the sizes of the scans, up to three deviations from their median") {
  std::vector<FittedBody> fitted;
  for (const Body& body : stones()) fitted.push_back(exact(body));
  const GrainKind kind = find_kind(fitted);
  FittedBody mean;
  mean.body = kind.body;
  const toml::table catalogue = toml::parse(toml_lines(std::vector{mean}, "stone", 2600, "six scans"));
  const toml::node_view stone = catalogue["stone"];
  CHECK(stone["half_axes"][0].value_or(double{NAN}) == doctest::Approx(kind.body.half_axes.x()).epsilon(1e-8));
  CHECK(stone["density"].value<double>() == 2600);
  CHECK(stone["source"].value<std::string>() == "six scans");
  const toml::table scene = toml::parse(scene_lines(kind, "stone"));
  const toml::node_view grain = scene["grain"][0];
  CHECK(grain["name"].value<std::string>() == "stone");
  CHECK(grain["count"].value<int>() == 6);
  const toml::node_view size = grain["size"];
  CHECK(size["distribution"].value<std::string>() == "lognormal");
  CHECK(size["unit"].value<std::string>() == "catalogue");
  CHECK(size["median"].value<double>() == 1);
  const double deviation = kind.geometric_deviation;
  CHECK(size["geometric_deviation"].value_or(double{NAN}) == doctest::Approx(deviation).epsilon(1e-8));
  CHECK(size["smallest"].value_or(double{NAN}) == doctest::Approx(std::pow(deviation, -3)).epsilon(1e-8));
  CHECK(size["largest"].value_or(double{NAN}) == doctest::Approx(std::pow(deviation, 3)).epsilon(1e-8));
}

TEST_CASE("scans of one size have no distribution, and scans of too many sizes a warning") {
  std::mt19937_64 random(3);
  const auto kind_of = [&](double factor) {
    return find_kind(std::vector{exact(stone(0.01, 0.8, 2.5, 4, random)), exact(stone(0.01 * factor, 0.8, 2.5, 4, random))});
  };
  CHECK(scene_lines(kind_of(1), "stone") == "[[grain]]\nname = \"stone\"\ncount = 2\n");
  CHECK(doubts_about(kind_of(1), {}).empty());
  const GrainKind wide = kind_of(6);
  CHECK(scene_lines(wide, "stone") == "[[grain]]\nname = \"stone\"\ncount = 2\n");
  REQUIRE(doubts_about(wide, {}).size() == 1);
  CHECK(doubts_about(wide, {})[0].find("geometric deviation of 3.55; allowed: up to 3.162") != std::string::npos);
}

TEST_CASE("the JSON of a kind has its units, the shape with its spread, and all scans") {
  std::vector<FittedBody> fitted;
  std::vector<KindScan> scans;
  for (const Body& body : stones()) {
    fitted.push_back(exact(body));
    scans.push_back({"stone.ply", fitted.back(), {}, {}});
  }
  scans[0].doubts = {"it is bad"};
  const GrainKind kind = find_kind(fitted);
  const std::vector<std::string> doubts = doubts_about(kind, scans);
  CHECK(doubts == std::vector<std::string>{"stone.ply: it is bad"});
  Provenance provenance;
  provenance.name = "stone";
  const std::string text = json_text(kind, scans, doubts, provenance);
  for (const char* part : {R"("lengths": "m")", R"("of": "cube root of the volume")", R"("standard_deviation")",
                           R"("fit_error": null)", R"("file": "stone.ply")", R"(stone.ply: it is bad)"}) {
    CAPTURE(part);
    CHECK(text.find(part) != std::string::npos);
  }
  CHECK(text.find("nan") == std::string::npos);
}
