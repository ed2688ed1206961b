// The loop in C++ with which supernormal.find_proximities() is compared. It reads pairs of superellipsoids, solves one after the
// other, writes the results and prints the seconds of the loop.
//
//     loop PAIRS RESULTS     both files are arrays of doubles, a row for each pair
//
// A row of PAIRS: half-axes (3), delta, epsilon of body 1; the same of body 2; position (3) and rotation (9, by rows) of body 2.
// Body 1 is at the origin. A row of RESULTS: see write_row().
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

namespace supernormal::test {
namespace {

constexpr std::size_t kPairWidth = 22;

std::vector<double> read_doubles(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::vector<double> values(static_cast<std::size_t>(file.tellg()) / sizeof(double));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(double)));
  if (values.size() % kPairWidth != 0) throw std::runtime_error(path + " holds no whole number of pairs");
  return values;
}

Superellipsoid shape_of(const double* p) { return {Vector3(p[0], p[1], p[2]), p[3], p[4]}; }

Pose pose_of(const double* p) {
  Pose pose;
  pose.position = Vector3(p[0], p[1], p[2]);
  pose.rotation << p[3], p[4], p[5], p[6], p[7], p[8], p[9], p[10], p[11];
  return pose;
}

std::vector<Proximity> solve(const std::vector<double>& pairs) {
  std::vector<Proximity> results(pairs.size() / kPairWidth);
  for (std::size_t i = 0; i < results.size(); ++i) {
    const double* const row = &pairs[kPairWidth * i];
    results[i] = find_proximity(shape_of(row), {}, shape_of(row + 5), pose_of(row + 10));
  }
  return results;
}

void write_row(std::ofstream& file, const Proximity& r) {
  const double row[] = {r.gap,
                        r.error,
                        r.normal.x(),
                        r.normal.y(),
                        r.normal.z(),
                        r.point1.x(),
                        r.point1.y(),
                        r.point1.z(),
                        r.point2.x(),
                        r.point2.y(),
                        r.point2.z(),
                        r.contact.x(),
                        r.contact.y(),
                        r.contact.z(),
                        r.global_error,
                        static_cast<double>(r.evaluations),
                        static_cast<double>(r.status),
                        r.is_global ? 1.0 : 0.0};
  file.write(reinterpret_cast<const char*>(row), sizeof row);
}

void run(const std::string& pairs_path, const std::string& results_path) {
  const std::vector<double> pairs = read_doubles(pairs_path);
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t processor_start = std::clock();
  const std::vector<Proximity> results = solve(pairs);
  const double processor = static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC;
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  std::cout << processor << ' ' << wall.count() << '\n';
  std::ofstream file(results_path, std::ios::binary);
  for (const Proximity& result : results) write_row(file, result);
  if (!file.flush()) throw std::runtime_error("cannot write " + results_path);
}

}  // namespace
}  // namespace supernormal::test

int main(int argc, char** argv) {
  try {
    if (argc != 3) throw std::invalid_argument("usage: loop PAIRS RESULTS");
    supernormal::test::run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
