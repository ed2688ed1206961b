#include "sample.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <string>

using namespace supernormal;
using namespace supernormal::soak;

namespace {

constexpr std::uint64_t kSamples = 20000;

bool is_same(const Sample& a, const Sample& b) {
  return a.pair.name == b.pair.name && a.pair.body1.lengths == b.pair.body1.lengths &&
         a.pair.body2.lengths == b.pair.body2.lengths && a.pair.pose2.position == b.pair.pose2.position &&
         a.pair.pose2.rotation == b.pair.pose2.rotation && a.settings.tolerance == b.settings.tolerance &&
         a.placed_gap == b.placed_gap;
}

}  // namespace

TEST_CASE("a sample is a function of seed and number, not of the samples before") {
  const SampleSource source(7), again(7), other(8);
  Sample a, b, c;
  int same_with_other_seed = 0;
  for (std::uint64_t k = 0; k < 200; ++k) {
    source.draw(k, a);
    again.draw(199 - k, b);
    again.draw(k, b);
    other.draw(k, c);
    CHECK(is_same(a, b));
    same_with_other_seed += is_same(a, c) ? 1 : 0;
  }
  CHECK(same_with_other_seed == 0);
}

TEST_CASE("samples cover the catalogue and the random classes, from apart to one within the other") {
  const SampleSource source(7);
  std::set<std::string> names;
  int apart = 0, touching = 0, shallow = 0, deep = 0;
  Sample sample;
  for (std::uint64_t k = 0; k < kSamples; ++k) {
    source.draw(k, sample);
    names.insert(sample.pair.name);
    REQUIRE(sample.pair.pose2.position.allFinite());
    CHECK((sample.pair.pose2.rotation.transpose() * sample.pair.pose2.rotation - Matrix3::Identity()).norm() <= 1e-14);
    if (!sample.placed_gap) continue;
    const double unit = std::min(sample.pair.shape1->half_extents().minCoeff(), sample.pair.shape2->half_extents().minCoeff());
    const double relative = *sample.placed_gap / unit;
    (relative > 1e-3 ? apart : relative >= -1e-3 ? touching : relative > -0.3 ? shallow : deep) += 1;
  }
  for (const samples::HardCase& one : samples::hard_cases()) {
    if (!names.contains(one.name)) FAIL_CHECK(one.name, " is not drawn");
  }
  CHECK(names.contains("random: extreme_boxy"));
  for (const int count : {apart, touching, shallow, deep}) CHECK(count > 100);
}

TEST_CASE("the sharp mix has only bodies that are sharp in one section and flat in another") {
  const SampleSource source(7, Mix::Sharp);
  int sharp_beside_flat = 0;
  Sample sample;
  for (std::uint64_t k = 0; k < 1000; ++k) {
    source.draw(k, sample);
    CHECK(sample.pair.name == "random: of any exponents");
    for (const samples::Body* body : {&sample.pair.body1, &sample.pair.body2}) {
      const auto [least, largest] = std::minmax(body->delta, body->epsilon);
      sharp_beside_flat += least < 1.3 && largest > 20 ? 1 : 0;
    }
  }
  CHECK(sharp_beside_flat > 50);
}
