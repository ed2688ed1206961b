// Sizes of grains: their distributions against closed forms, and what they make of a scene.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "common/random.hpp"
#include "observe/energy.hpp"
#include "observe/measurement.hpp"
#include "scenes.hpp"
#include "support/relative.hpp"
#include "world/placement.hpp"
#include "world/stepper.hpp"
#include "world/world.hpp"

using namespace falling_particles;
using supernormal::test::relative;

namespace {

using By = SizeDistribution::By;

constexpr double kTableError = 1e-6;  // what SizeDistribution::quantile() promises

/// The share of a standard normal distribution below z.
double normal_below(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }
double normal_density(double z) { return std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi); }

/// Checks that the quantiles are those of the share below a size, `below`, of a distribution without bounds.
void check_quantiles(const SizeDistribution& distribution, const auto& below) {
  const double first = below(distribution.smallest());
  const double whole = below(distribution.largest()) - first;
  for (const double p : {0.0, 0.001, 0.1, 0.25, 0.5, 0.75, 0.9, 0.999, 1.0}) {
    CAPTURE(p);
    CHECK(std::abs((below(distribution.quantile(p)) - first) / whole - p) < kTableError);
  }
}

/// The mean and the standard deviation by number.
std::array<double, 2> moments_of(const SizeDistribution& distribution) {
  constexpr int kParts = 20000;
  double mean = 0;
  double square = 0;
  for (int i = 0; i < kParts; ++i) {
    const double size = distribution.quantile((i + 0.5) / kParts);
    mean += size / kParts;
    square += size * size / kParts;
  }
  return {mean, std::sqrt(square - mean * mean)};
}

std::string scene_with_size(const std::string& size) {
  return replaced(kSceneText, "name = \"pea\"\ncount = 5", "name = \"pea\"\ncount = 5\nsize = " + size);
}

std::vector<Placement> placements_of(const Scene& scene) {
  Random random(scene.seed);
  return place(scene, random);
}

}  // namespace

TEST_CASE("sizes: a uniform distribution by number and by mass") {
  const SizeDistribution by_number = SizeDistribution::uniform({2, 6}, By::Number);
  for (const double p : {0.0, 0.2, 0.7, 1.0}) CHECK(by_number.quantile(p) == relative(2 + 4 * p).epsilon(1e-12));
  const auto [mean, deviation] = moments_of(by_number);
  CHECK(mean == relative(4).epsilon(1e-9));
  CHECK(deviation == relative(4 / std::sqrt(12)).epsilon(1e-6));
  // The number of grains in a mass of size x goes with x^-3.
  check_quantiles(SizeDistribution::uniform({2, 6}, By::Mass), [](double x) { return -1 / (x * x); });
}

TEST_CASE("sizes: a truncated normal distribution has its quantiles and moments") {
  constexpr double kMean = 5, kDeviation = 1.5, kSmallest = 3, kLargest = 9;
  const SizeDistribution distribution = SizeDistribution::normal(kMean, kDeviation, {kSmallest, kLargest}, By::Number);
  check_quantiles(distribution, [](double x) { return normal_below((x - kMean) / kDeviation); });
  const double a = (kSmallest - kMean) / kDeviation;
  const double b = (kLargest - kMean) / kDeviation;
  const double whole = normal_below(b) - normal_below(a);
  const double shift = (normal_density(a) - normal_density(b)) / whole;
  const double variance = 1 + (a * normal_density(a) - b * normal_density(b)) / whole - shift * shift;
  const auto [mean, deviation] = moments_of(distribution);
  CHECK(mean == relative(kMean + kDeviation * shift).epsilon(1e-6));
  CHECK(deviation == relative(kDeviation * std::sqrt(variance)).epsilon(1e-5));
  // Far in a tail nothing vanishes.
  const SizeDistribution tail = SizeDistribution::normal(1, 0.01, {2, 3}, By::Number);
  CHECK(tail.quantile(0.5) > 2);
  CHECK(tail.quantile(0.999) < 2.01);
}

TEST_CASE("sizes: a lognormal distribution by mass is one by number with a smaller median") {
  constexpr double kMedian = 4;
  const double spread = std::log(1.4);
  check_quantiles(SizeDistribution::lognormal(kMedian, 1.4, {1, 20}, By::Number),
                  [&](double x) { return normal_below(std::log(x / kMedian) / spread); });
  // Hatch and Choate 1929: the logarithm of the median falls by three variances.
  const double median = kMedian * std::exp(-3 * spread * spread);
  check_quantiles(SizeDistribution::lognormal(kMedian, 1.4, {1, 20}, By::Mass),
                  [&](double x) { return normal_below(std::log(x / median) / spread); });
}

TEST_CASE("sizes: drawn grains pass sieves by mass as their curve says") {
  const std::vector<double> openings = {1, 2, 2.5, 4, 8};
  const std::vector<double> passing = {0, 0.1, 0.1, 0.7, 1};
  const SizeDistribution distribution = SizeDistribution::sieve(openings, passing, By::Mass);
  const std::vector<double> sizes = draw_sizes(distribution, 20000, 5);
  double all = 0;
  for (const double size : sizes) all += size * size * size;
  for (std::size_t i = 0; i < openings.size(); ++i) {
    CAPTURE(i);
    double passed = 0;
    for (const double size : sizes) passed += size < openings[i] ? size * size * size : 0;
    CHECK(std::abs(passed / all - passing[i]) < 1e-3);
  }
  CHECK(std::ranges::none_of(sizes, [](double size) { return size > 2.0001 && size < 2.4999; }));
}

TEST_CASE("sizes: draws follow the distribution as closely as their number can, in random order, the same from a seed") {
  const SizeDistribution distribution = SizeDistribution::lognormal(3, 1.5, {1, 9}, By::Number);
  constexpr int kGrains = 50;
  const std::vector<double> sizes = draw_sizes(distribution, kGrains, 7);
  CHECK(sizes == draw_sizes(distribution, kGrains, 7));
  CHECK(sizes != draw_sizes(distribution, kGrains, 8));
  CHECK_FALSE(std::ranges::is_sorted(sizes));
  std::vector<double> sorted = sizes;
  std::ranges::sort(sorted);
  for (int i = 0; i < kGrains; ++i) {
    CHECK(sorted[static_cast<std::size_t>(i)] >= distribution.quantile(static_cast<double>(i) / kGrains));
    CHECK(sorted[static_cast<std::size_t>(i)] <= distribution.quantile((i + 1.0) / kGrains));
  }
  CHECK(seed_of_sizes(1, 0) != seed_of_sizes(1, 1));
  CHECK(seed_of_sizes(1, 0) != seed_of_sizes(2, 0));
}

TEST_CASE("sizes: a sieve size is the middle width of a grain, in m or relative to the catalogue's") {
  GrainKind kind{"box", {3, 1, 2}, 2, 2, 0, 1, ""};
  CHECK(kind.sieve_size() == 4);
  // A pea of the catalogue has 6 mm.
  const Scene in_metres = scene_of(scene_with_size(R"({ distribution = "uniform", smallest = 3e-3, largest = 9e-3 })"));
  const Scene relative_to_pea =
      scene_of(scene_with_size(R"({ distribution = "uniform", unit = "catalogue", smallest = 0.5, largest = 1.5 })"));
  REQUIRE(in_metres.kinds[0].scales.size() == 5);
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(in_metres.kinds[0].scales[i] == relative(relative_to_pea.kinds[0].scales[i]).epsilon(1e-12));
  }
  CHECK(in_metres.kinds[1].scales.empty());
  CHECK(in_metres.has_sizes());
  const double largest = std::ranges::max(in_metres.kinds[0].scales);
  const double smallest = std::ranges::min(in_metres.kinds[0].scales);
  CHECK(in_metres.smallest_half_axis() == smallest * 3e-3);
  CHECK(largest * 3e-3 < in_metres.largest_bounding_radius());  // a die's
}

TEST_CASE("sizes: attitudes and kinds are the same without them, and starts keep their distance") {
  const Scene plain = scene_of(kSceneText);
  const Scene sized = scene_of(scene_with_size(R"({ distribution = "uniform", smallest = 3e-3, largest = 9e-3 })"));
  CHECK_FALSE(plain.has_sizes());
  const std::vector<Placement> one = placements_of(plain);
  const std::vector<Placement> other = placements_of(sized);
  REQUIRE(one.size() == other.size());
  const World world(sized, other);
  for (std::size_t i = 0; i < one.size(); ++i) {
    CHECK(one[i].kind == other[i].kind);
    CHECK(one[i].quaternion == other[i].quaternion);
    CHECK(one[i].scale == 1);
    if (one[i].kind == 1) CHECK(one[i].position == other[i].position);
    for (std::size_t j = 0; j < i; ++j) {
      const Grain& a = world.grains()[i];
      const Grain& b = world.grains()[j];
      const auto [ax, ay, az] = a.position();
      const auto [bx, by, bz] = b.position();
      CHECK(std::hypot(ax - bx, ay - by, az - bz) >= (a.bounding_radius() + b.bounding_radius()) * (1 - 1e-12));
    }
  }
}

TEST_CASE("sizes: the mass of a body goes with the third power of its scale, the inertia with the fifth") {
  const Scene scene = scene_of(kSceneText);
  for (const std::size_t kind : {std::size_t{0}, std::size_t{1}}) {
    Placement large{kind, {0.02, 0.02, 0.1}, {1, 0, 0, 0}, 1.3};
    Placement plain{kind, {0.02, 0.04, 0.1}, {1, 0, 0, 0}};
    const World world(scene, {large, plain});
    const dMass& one = world.grains()[0].mass;
    const dMass& other = world.grains()[1].mass;
    CHECK(one.mass == relative(std::pow(1.3, 3) * other.mass).epsilon(1e-9));
    for (const int i : {0, 5, 10}) CHECK(one.I[i] == relative(std::pow(1.3, 5) * other.I[i]).epsilon(1e-9));
    CHECK(world.grains()[0].smallest_half_axis() == 1.3 * world.grains()[1].smallest_half_axis());
    CHECK(world.grains()[0].aabb()[5] - 0.1 == relative(1.3 * scene.kinds[kind].kind.half_axes[2]).epsilon(1e-12));
  }
}

TEST_CASE("sizes: what was drawn is told by number and by mass") {
  Scene scene = scene_of(scene_with_size(R"({ distribution = "uniform", smallest = 3e-3, largest = 9e-3 })"));
  scene.kinds[0].scales = {1, 0.5, 1.5, 0.75, 1.25};
  const World world(scene, placements_of(scene));
  const std::vector<DrawnSizes> all = measure_sizes(world, scene);
  REQUIRE(all.size() == 1);
  const DrawnSizes& sizes = all[0];
  CHECK(sizes.kind == "pea");
  CHECK(sizes.number == 5);
  const double pea = 1200 * 4.0 / 3 * std::numbers::pi * 27e-9;
  CHECK(sizes.mass == relative(pea * (1 + 0.125 + 3.375 + 0.421875 + 1.953125)).epsilon(1e-9));
  CHECK(sizes.mean == relative(6e-3).epsilon(1e-12));
  CHECK(sizes.standard_deviation == relative(6e-3 * std::sqrt(0.625 / 4)).epsilon(1e-12));
  CHECK(sizes.smallest == relative(3e-3).epsilon(1e-12));
  CHECK(sizes.largest == relative(9e-3).epsilon(1e-12));
  CHECK(sizes.median == relative(6e-3).epsilon(1e-12));
  CHECK(sizes.by_mass[0] == relative(6e-3).epsilon(1e-12));    // a tenth is 0.69 peas: 0.55 are smaller
  CHECK(sizes.by_mass[1] == relative(7.5e-3).epsilon(1e-12));  // of 6.88 peas 1.55 are smaller, 3.5 with it
  CHECK(sizes.by_mass[2] == relative(9e-3).epsilon(1e-12));
  const std::unique_ptr<Measurement> grains = find_measurement_kind("grains")->on_by_default->make(world);
  CHECK(grains->columns() == "body,grain,scale,sieve_size_m,mass_kg");
  for (const std::size_t written : {std::size_t{0}, std::size_t{2}}) {  // a resumed table has some grains already
    TableText table;
    grains->measure({0, world, {}, nullptr, written}, table);
    std::istringstream stream(table.text());
    std::size_t lines = written;
    for (std::string line; std::getline(stream, line); ++lines) CHECK(line.starts_with(std::to_string(lines) + ','));
    CHECK(lines == 7);
  }
}

TEST_CASE("sizes: a large pea rests on the floor at its own radius, with its own weight") {
  const Scene scene = scene_of(kSceneText);
  const World world(scene, {{0, {0.02, 0.03, 4.6e-3}, {1, 0, 0, 0}, 1.5}});
  Stepper stepper(world, scene);
  for (int i = 0; i < 400; ++i) stepper.step(i == 399);
  CHECK(world.grains()[0].position()[2] == relative(4.5e-3).epsilon(3e-3));  // the surface layer is 2e-3 of a pea
  REQUIRE(stepper.measured_contacts().size() == 1);
  CHECK(stepper.measured_contacts()[0].force()[2] == relative(9.81 * world.grains()[0].mass.mass).epsilon(1e-3));
}

TEST_CASE("sizes: every mistake ends with one line") {
  const std::vector<std::pair<const char*, std::vector<const char*>>> mistakes = {
      {"3", {"scene.toml:12: grain.size is 3; allowed: a table"}},
      {R"({ distribution = "gauss" })", {R"(grain.size.distribution is "gauss")", "uniform, normal, lognormal, sieve"}},
      {R"({ distribution = "normal", mean = 6e-3, deviation = 1e-3 })", {"grain.size.smallest is missing", "(0, 2] m"}},
      {R"({ distribution = "normal", mean = 6e-3, deviation = 0, smallest = 1e-3, largest = 9e-3 })",
       {"grain.size.deviation is 0", "(0, 2] m"}},
      {R"({ distribution = "uniform", smallest = 6e-3, largest = 6e-3 })",
       {"grain.size.largest is 0.006", "(0.006, 6] m (above size.smallest)"}},
      {R"({ distribution = "uniform", smallest = 6e-3, largest = 7e-3, mean = 3 })", {R"(unknown key "mean" in [grain.size])"}},
      {R"({ distribution = "uniform", smallest = 0, largest = 7e-3 })", {"grain.size.smallest is 0"}},
      {R"({ distribution = "lognormal", median = 6e-3, geometric_deviation = 1, smallest = 1e-3, largest = 7e-3 })",
       {"grain.size.geometric_deviation is 1", "(1, 100]"}},
      {R"({ distribution = "uniform", unit = "catalogue", smallest = 0.5, largest = 1.5, by = "volume" })",
       {R"(grain.size.by is "volume")", "number, mass"}},
      {R"({ distribution = "sieve", openings = [1e-3], passing = [1] })", {"grain.size.openings has 1 numbers", "2 to 200"}},
      {R"({ distribution = "sieve", openings = [2e-3, 1e-3], passing = [0, 1] })",
       {"grain.size.openings[1] is 0.001", "above the one before, 0.002"}},
      {R"({ distribution = "sieve", openings = [1e-3, 2e-3], passing = [0.1, 1] })",
       {"grain.size.passing[0] is 0.1", "allowed: 0"}},
      {R"({ distribution = "sieve", openings = [1e-3, 2e-3], passing = [0, 0.9] })",
       {"grain.size.passing[1] is 0.9", "allowed: 1"}},
      {R"({ distribution = "sieve", openings = [1e-3, 2e-3, 3e-3, 4e-3], passing = [0, 0.9, 0.8, 1] })",
       {"grain.size.passing[2] is 0.8", "no less than the one before, 0.9"}},
      {R"({ distribution = "sieve", openings = [1e-3, 2e-3], passing = [0, 0.5, 1] })",
       {"grain.size.passing is an array of 3", "an array of 2"}},
  };
  for (const auto& mistake : mistakes) {
    CAPTURE(mistake.first);
    check_says(complaint(scene_with_size(mistake.first)), mistake.second);
  }
}
