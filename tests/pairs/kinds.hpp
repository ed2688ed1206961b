// The kinds of pairs. Each draws pairs, tests facts that hold for all of them, and reports.
#pragma once

#include <cstdint>
#include <cstdio>
#include <initializer_list>
#include <string>

namespace supernormal::test {

/// What a command line asks for.
struct Draws {
  std::uint64_t count = 0;
  std::uint64_t seed = 0;
  std::uint64_t first = 0;  ///< the number of the first pair; for the soaks
};

/// What a kind prints: a table, and each fault that it finds.
class Report {
 public:
  void head(std::initializer_list<const char*> columns) const {
    for (const char* column : columns) std::printf("| %s ", column);
    std::printf("|\n");
    for (std::size_t k = 0; k < columns.size(); ++k) std::printf(k == 0 ? "|---" : "|--:");
    std::printf("|\n");
  }

  void row(const std::string& name, std::initializer_list<double> figures) const {
    std::printf("| %s |", name.c_str());
    for (const double figure : figures) std::printf(" %.7g |", figure);
    std::printf("\n");
    std::fflush(stdout);
  }

  void fault(const std::string& what) {
    ++faults_;
    std::printf("FAULT: %s\n", what.c_str());
  }

  long faults() const { return faults_; }

 private:
  long faults_ = 0;
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
