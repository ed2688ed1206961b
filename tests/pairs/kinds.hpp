// The kinds of pairs. Each draws pairs, tests facts that hold for all of them, and reports.
#pragma once

#include <cstdint>

#include "pairs/report.hpp"

namespace supernormal::test {

/// What a command line asks for.
struct Draws {
  std::uint64_t count = 0;
  std::uint64_t seed = 0;
  std::uint64_t first = 0;  ///< the number of the first pair; for the soaks
};

void run_lanes(const Draws& draws, Report& report);
void run_derivatives(const Draws& draws, Report& report);
void run_flat_derivatives(const Draws& draws, Report& report);
void run_clearances(const Draws& draws, Report& report);
void run_impacts(const Draws& draws, Report& report);
void run_fly_bys(const Draws& draws, Report& report);
void run_soak(const Draws& draws, Report& report);
void run_sharp_soak(const Draws& draws, Report& report);

}  // namespace supernormal::test
