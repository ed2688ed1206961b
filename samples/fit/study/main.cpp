// Measures how well fit recovers known bodies: the tables of samples/fit/constants.md.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "bodies.hpp"
#include "kind/kind_text.hpp"
#include "studies.hpp"
#include "truth.hpp"

namespace {

void write_points(const std::string& path, const std::vector<fit::Vector3>& points) {
  std::ofstream file(path);
  file.precision(12);
  for (const fit::Vector3& x : points) file << x.x() << ' ' << x.y() << ' ' << x.z() << '\n';
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

/// Writes 4000 points of each stone, and prints the kind of the stones themselves.
void write_stones(const std::string& folder, std::size_t count, double noise) {
  std::filesystem::create_directories(folder);
  std::vector<fit::FittedBody> exact;
  std::vector<fit::KindScan> scans;
  for (const fit::Body& stone : fit::make_stones(count, 1)) {
    const std::string name = "stone_" + std::to_string(scans.size() + 101) + ".xyz";
    write_points(std::string(folder).append("/").append(name),
                 fit::scatter(stone, {.points = 4000, .noise = noise, .seed = scans.size() + 1}).points);
    exact.emplace_back().body = stone;
    fit::KindScan scan{name, exact.back(), {}, {}};
    scan.error.radius = 1;
    scans.push_back(scan);
  }
  std::fputs(fit::describe(fit::find_kind(exact), scans).c_str(), stdout);
}

int run_program(int argc, char** argv) {
  CLI::App app("Fits bodies that are known.", "fit_study");
  app.require_subcommand(1);
  int bodies = 12;
  const auto add_bodies = [&](CLI::App* study) {
    study->add_option("--bodies", bodies, "bodies in a row of the table")->check(CLI::Range(1, 100000))->capture_default_str();
  };
  CLI::App* const recovery = app.add_subcommand("recovery", "errors of the numbers, whole and half bodies, with noise");
  add_bodies(recovery);
  CLI::App* const coverage = app.add_subcommand("coverage", "how often the truth lies within one and two standard errors");
  add_bodies(coverage);
  CLI::App* const unions = app.add_subcommand("unions", "the bodies of samples/compound taken apart");
  CLI::App* const time = app.add_subcommand("time", "processor time of 100 000 points");
  CLI::App* const compound = app.add_subcommand("compound", "writes points of a body of samples/compound");
  std::string name, path;
  double sigma = 0.0003;
  std::size_t each = 4000;
  compound->add_option("name", name, "dumbbell or molar")->required();
  compound->add_option("file", path, "NAME.xyz, written")->required();
  compound->add_option("--sigma", sigma, "m, noise in every direction")->check(CLI::NonNegativeNumber)->capture_default_str();
  compound->add_option("--points", each, "of each of its parts")->check(CLI::Range(100, 1000000))->capture_default_str();
  CLI::App* const stones = app.add_subcommand("stones", "writes a folder of scans of stones of one kind, and prints the kind");
  std::size_t count = 20;
  double noise = 0.01;
  stones->add_option("folder", path, "written")->required();
  stones->add_option("--scans", count, "in the folder")->check(CLI::Range(2, 10000))->capture_default_str();
  stones->add_option("--noise", noise, "relative to the mean half-axis")->check(CLI::NonNegativeNumber)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  if (*recovery) fit::print_recovery(bodies);
  if (*coverage) fit::print_coverage(bodies);
  if (*unions) fit::print_unions();
  if (*time) fit::print_time();
  if (*stones) write_stones(path, count, noise);
  if (*compound) write_points(path, fit::scatter_union(fit::make_compound(name), each, sigma, 1).points);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fit_study: %s\n", error.what());
    return 1;
  }
}
