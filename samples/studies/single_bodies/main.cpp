// Single bodies and small clouds with a closed-form or published result. Prints both side by side as a Markdown table.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

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

/// Returns the exit code.
int run_program(int argc, char** argv) {
  std::vector<std::string> names, wanted;
  for (const Experiment& experiment : kExperiments) names.emplace_back(experiment.name);
  CLI::App app("Compares motions of single bodies and small clouds with closed forms and published results");
  app.add_option("EXPERIMENT", wanted, "all without a name")->check(CLI::IsMember(names));
  CLI11_PARSE(app, argc, argv);
  std::printf("| experiment | quantity | ours | reference | deviation | source |\n|---|---|---:|---:|---:|---|\n");
  for (const Experiment& experiment : kExperiments) {
    if (!wanted.empty() && std::ranges::find(wanted, experiment.name) == wanted.end()) continue;
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
