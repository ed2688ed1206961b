// Single bodies and small clouds with a closed-form or published result. Prints both side by side as a Markdown table.

#include <cstdio>
#include <cstring>
#include <exception>

#include "lab.hpp"

namespace {

using single_bodies::Result;
using single_bodies::Results;

struct Experiment {
  const char* name;
  Results (*run)();
};

constexpr Experiment kExperiments[] = {
    {"elastic_gas", single_bodies::elastic_gas},
    {"rocking", single_bodies::rocking},
    {"rolling", single_bodies::rolling},
    {"incline", single_bodies::incline},
    {"skipping_bean", single_bodies::skipping_bean},
    {"rattleback", single_bodies::rattleback},
    {"tippe_top", single_bodies::tippe_top},
};

void print(const Result& result) {
  std::printf("| %s | %s | %.6g | %.6g | ", result.experiment.c_str(), result.quantity.c_str(), result.ours, result.reference);
  if (result.reference == 0) {
    std::printf("–");
  } else {
    std::printf("%.3f %%", 100 * (result.ours / result.reference - 1));
  }
  std::printf(" | %s |\n", result.source.c_str());
}

bool is_wanted(const char* name, int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(name, argv[i]) == 0) return true;
  }
  return argc == 1;
}

/// Returns the exit code: 2 for an unknown experiment.
int run_program(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    bool known = false;
    for (const Experiment& experiment : kExperiments) known = known || std::strcmp(experiment.name, argv[i]) == 0;
    if (known) continue;
    std::fprintf(stderr, "usage: single_bodies [EXPERIMENT...]\nunknown experiment \"%s\"; allowed:", argv[i]);
    for (const Experiment& experiment : kExperiments) std::fprintf(stderr, " %s", experiment.name);
    std::fprintf(stderr, "\n");
    return 2;
  }
  std::printf("| experiment | quantity | ours | reference | deviation | source |\n|---|---|---:|---:|---:|---|\n");
  for (const Experiment& experiment : kExperiments) {
    if (!is_wanted(experiment.name, argc, argv)) continue;
    for (const Result& result : experiment.run()) print(result);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    dInitODE2(0);
    dAllocateODEDataForThread(dAllocateFlagBasicData | dAllocateFlagCollisionData);
    const int code = run_program(argc, argv);
    snClose();
    dCloseODE();
    return code;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "single_bodies: %s\n", error.what());
    return 1;
  }
}
