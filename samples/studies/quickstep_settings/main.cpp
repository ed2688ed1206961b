// Measures the influence of quickstep's settings on Supernormal's bodies. It changes one setting at a time, on small scenes, and
// prints Markdown tables.

#include <supernormal/supernormal.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "trial.hpp"

using namespace quickstep_settings;

namespace {

struct Variant {
  std::string name;
  Settings settings;
};

struct Column {
  const char* name;
  double size;  ///< m
  double time;  ///< s
  void (*fill)(Scene&);
};

Outcome run(const Column& column, const Settings& settings) {
  Scene scene(column.size);
  column.fill(scene);
  return quickstep_settings::run(scene, settings, column.time);
}

void print_header(const std::vector<Column>& columns) {
  std::printf("| |");
  for (const Column& column : columns) std::printf(" %s |", column.name);
  std::printf("\n|---|");
  for (std::size_t i = 0; i < columns.size(); ++i) std::printf("---:|");
  std::printf("\n");
}

Settings with(void (*change)(Settings&), Settings base = {}) {
  change(base);
  return base;
}

std::vector<Variant> variants() {
  return {
      {"ODE's defaults, step 2 ms", {}},
      {"step 1 ms", with([](Settings& s) { s.step = 1e-3; })},
      {"step 0.5 ms", with([](Settings& s) { s.step = 5e-4; })},
      {"step 0.25 ms", with([](Settings& s) { s.step = 2.5e-4; })},
      {"40 iterations", with([](Settings& s) { s.iterations = 40; })},
      {"80 iterations", with([](Settings& s) { s.iterations = 80; })},
      {"ERP 0.1", with([](Settings& s) { s.erp = 0.1; })},
      {"ERP 0.4", with([](Settings& s) { s.erp = 0.4; })},
      {"ERP 0.8", with([](Settings& s) { s.erp = 0.8; })},
      {"CFM 0.01 step / mass", with([](Settings& s) { s.softness = 0.01; })},
      {"CFM 0.1 step / mass", with([](Settings& s) { s.softness = 0.1; })},
      {"CFM 1 step / mass", with([](Settings& s) { s.softness = 1; })},
      {"surface layer 0.2 %", with([](Settings& s) { s.surface_layer = 0.002; })},
      {"surface layer 1 %", with([](Settings& s) { s.surface_layer = 0.01; })},
      {"correcting velocity 0.1 m/s", with([](Settings& s) { s.correcting_velocity = 0.1; })},
  };
}

/// Prints the remaining motion of bodies that are all kept awake.
void print_unrest() {
  const std::vector<Column> columns = {{"stack of 10, 5 cm", 0.05, 4, fill_stack},
                                       {"20 times heavier on 2, 5 cm", 0.05, 4, fill_heavy},
                                       {"40 grains, 5 cm", 0.05, 6, fill_grains},
                                       {"40 grains, 1 mm", 0.001, 1, fill_grains}};
  std::printf("Speed that remains, mm/s, and deepest overlap, %% of the smallest half-axis, in the second half of the time:\n\n");
  print_header(columns);
  for (const Variant& variant : variants()) {
    std::printf("| %s |", variant.name.c_str());
    for (const Column& column : columns) {
      const Outcome outcome = run(column, variant.settings);
      std::printf(" %.2g; %.2g |", 1e3 * outcome.speed, 100 * outcome.overlap);
    }
    std::printf("\n");
    std::fflush(stdout);
  }
}

void print_sleep() {
  const std::vector<Column> columns = {{"brick, 5 cm", 0.05, 4, fill_brick},
                                       {"stack of 10, 5 cm", 0.05, 4, fill_stack},
                                       {"20 times heavier on 2, 5 cm", 0.05, 4, fill_heavy},
                                       {"pebble, 5 cm", 0.05, 10, fill_pebble},
                                       {"40 grains, 1 mm", 0.001, 2, fill_grains}};
  const Settings base = with([](Settings& s) {
    s.auto_disable = true;
    s.step = 5e-4;
  });
  const Settings averaged = with([](Settings& s) { s.average_samples = 10; }, base);
  std::printf("\nTime after which all sleep, s (step 0.5 ms):\n\n");
  print_header(columns);
  const auto print_row = [&](const char* name, const Settings& settings, bool of_size) {
    std::printf("| %s |", name);
    for (const Column& column : columns) {
      Settings s = settings;
      if (of_size) s.angular_threshold = s.linear_threshold / column.size;
      const double asleep = run(column, s).asleep;
      if (asleep < 0) {
        std::printf(" never |");
      } else {
        std::printf(" %.2f |", asleep);
      }
    }
    std::printf("\n");
    std::fflush(stdout);
  };
  print_row("auto-disable, ODE's thresholds", base, false);
  print_row("mean of 10 samples", averaged, false);
  print_row("mean of 10, angular threshold = linear / half-axis", averaged, true);
  print_row("the same, 40 iterations", with([](Settings& s) { s.iterations = 40; }, averaged), true);
  print_row("the same, angular damping 0.01", with([](Settings& s) { s.angular_damping = 0.01; }, averaged), true);
}

void print_sunk() {
  std::printf("\nHow high a body of 5 cm gets that starts 30 %% deep in the floor, in half-axes above its rest (step 2 ms):\n\n");
  const Column sunk = {"", 0.05, 1, fill_sunk};
  const double to_rest = 0.3;
  for (const double velocity : {0.0, 1.0, 0.1}) {
    Settings settings;
    settings.correcting_velocity = velocity;
    const double height = run(sunk, settings).rise - to_rest;
    if (velocity == 0) {
      std::printf("- correcting velocity unlimited: %.2f\n", height);
    } else {
      std::printf("- correcting velocity %.1f m/s: %.2f\n", velocity, height);
    }
  }
}

void print_all() {
  dInitODE2(0);
  dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll));
  print_unrest();
  print_sleep();
  print_sunk();
  snClose();
  dCloseODE();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    CLI::App app(
        "Compares settings of quickstep for bodies that rest: unrest, sleep, and how those that start in the floor come out");
    app.footer("Prints tables in Markdown, in some minutes. It takes no options.");
    CLI11_PARSE(app, argc, argv);
    print_all();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "quickstep_settings: %s\n", error.what());
    return 1;
  }
  return 0;
}
