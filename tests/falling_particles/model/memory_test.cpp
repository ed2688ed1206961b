#include "model/memory.hpp"

#include <doctest/doctest.h>

#include <initializer_list>

using namespace falling_particles;

TEST_CASE("memory grows in proportion to the grains") {
  CHECK(memory_needed(2'000'000) < 2 * memory_needed(1'000'000));
  CHECK(memory_needed(1'000'000) < 25e9);
  for (const double bytes : {1e8, 1e9, 23e9}) {
    const int grains = most_grains(bytes);
    CHECK(memory_needed(grains) <= bytes);
    CHECK(memory_needed(grains + 1) > bytes);
  }
  CHECK(most_grains(0) == 0);
  CHECK(memory_of_machine() > 1e8);
}
