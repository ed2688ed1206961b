// Tests whether heaps come to rest as well as heaps of dBoxes: bundles of needles, crossed needles, and a heavy cube on three light
// ones.

#include <ode/ode.h>
#include <supernormal/supernormal.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <vector>

#include "heap.hpp"

using namespace resting;

namespace {

const std::map<std::string, Heap> kHeaps = {{"bundle", Heap::Bundle}, {"crossed", Heap::Crossed}, {"three", Heap::OnThree}};

struct Options {
  std::vector<std::string> heaps = {"bundle", "crossed", "three"};
  std::vector<double> exponents = {0, 2, 4, 6, 8, 20, 60, 100};
  std::vector<double> sizes = {0.005};
  std::vector<double> steps = {0.002, 0.005, 0.01};
  std::vector<int> rooms = {8, 3};
  int iterations = 20;
  int in_layer = 60;
  int starts = 1;
  bool looks_ahead = false;
};

// Prints one line for each start.
void print_row(const std::string& heap, const HeapRow& row, int starts) {
  for (int number = 0; number < starts; ++number) {
    const HeapRest rest = settle(row, number);
    std::printf("%-7s %6.4f %6.4f %d %3.0f: %2d awake after %6.3f s, %8.3f mm/s, overlap %.4f\n", heap.c_str(), row.size, row.step,
                row.room, row.exponent, rest.awake, rest.time, 1e3 * rest.speed, rest.overlap);
    std::fflush(stdout);
  }
}

void run(const Options& options) {
  dInitODE2(0);
  dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll));
  std::printf("heap, size m, step s, room, exponent (0: dBoxes)\n");
  for (const std::string& heap : options.heaps) {
    for (const double size : options.sizes) {
      for (const double step : options.steps) {
        for (const int room : options.rooms) {
          for (const double exponent : options.exponents) {
            print_row(heap,
                      {kHeaps.at(heap), exponent, size, step, room, options.iterations, options.in_layer, options.looks_ahead},
                      options.starts);
          }
        }
      }
    }
  }
  snClose();
  dCloseODE();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Options options;
    CLI::App app("Whether heaps come to rest as those of dBoxes do");
    app.add_option("--heaps", options.heaps, "bundle, crossed, three")->check(CLI::IsMember(kHeaps))->delimiter(',');
    app.add_option("--exponents", options.exponents, "of the bodies; 0: dBoxes")->delimiter(',');
    app.add_option("--sizes", options.sizes, "half-thickness, m")->delimiter(',');
    app.add_option("--steps", options.steps, "s")->delimiter(',');
    app.add_option("--rooms", options.rooms, "contacts a pair, 1 to 8")->check(CLI::Range(1, 8))->delimiter(',');
    app.add_option("--iterations", options.iterations, "of quickstep");
    app.add_option("--in-layer", options.in_layer, "needles side by side in a bundle of 60")->check(CLI::PositiveNumber);
    app.add_option("--starts", options.starts, "how many for each row");
    app.add_flag("--look-ahead", options.looks_ahead, "give the bodies contacts before they overlap");
    CLI11_PARSE(app, argc, argv);
    run(options);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "heaps: %s\n", error.what());
    return 1;
  }
}
