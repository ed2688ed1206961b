// The three solvers on pairs with known results, as a Markdown table: how often each fails, and its cost if it succeeds.
//
//     solver_table [superellipsoid_pairs.csv]
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

namespace {

using namespace supernormal;

// A gap is wrong if its error exceeds this fraction of the smallest half-axis.
constexpr double kWrong = 1e-6;
constexpr int kMaxEvaluations = 200;

// A pair with an overlap of more than this fraction of the smallest half-axis counts as overlapping, any other as touching. The
// groups in the file are 1e-3 and 2e-2.
constexpr double kTouching = 5e-3;

// The columns are: class; half-axes and exponents of both; position and orientation of body 2; gap; normal, points, two marks.
constexpr std::size_t kNumbers = 29;
constexpr std::size_t kGap = 17;

struct Pair {
  std::string kind;
  std::shared_ptr<const Shape> shape1, shape2;
  Pose pose2;
  double unit;  // smallest half-axis, m
  double gap;   // m
};

std::shared_ptr<const Shape> make_shape(const double* v) {
  const Vector3 half_axes(v[0], v[1], v[2]);
  if (v[3] == 2 && v[4] == 2) return std::make_shared<Ellipsoid>(half_axes);
  return std::make_shared<Superellipsoid>(half_axes, v[3], v[4]);
}

Pair parse_pair(const std::string& line) {
  Pair pair;
  std::istringstream in(line);
  std::getline(in, pair.kind, ',');
  std::vector<double> v;
  for (std::string field; std::getline(in, field, ',');) v.push_back(std::stod(field));
  if (v.size() != kNumbers) throw std::runtime_error("a class and " + std::to_string(kNumbers) + " numbers expected in: " + line);
  pair.shape1 = make_shape(&v[0]);
  pair.shape2 = make_shape(&v[5]);
  pair.pose2.position = {v[10], v[11], v[12]};
  pair.pose2.rotation = Eigen::Quaterniond(v[13], v[14], v[15], v[16]).normalized().toRotationMatrix();
  pair.unit = std::min(pair.shape1->half_extents().minCoeff(), pair.shape2->half_extents().minCoeff());
  pair.gap = v[kGap];
  return pair;
}

std::vector<Pair> load_pairs(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::vector<Pair> pairs;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && line[0] != '#' && line.rfind("class,", 0) != 0) pairs.push_back(parse_pair(line));
  }
  if (pairs.empty()) throw std::runtime_error("no pairs in " + path);
  return pairs;
}

struct Tally {
  int failures = 0, pairs = 0;

  std::string text() const { return std::to_string(failures) + " of " + std::to_string(pairs); }
};

struct Row {
  Tally apart, overlapping;
  std::vector<int> evaluations;  // one number per success

  /// The number of evaluations at the fraction `share` of the successes.
  std::string percentile(double share) {
    if (evaluations.empty()) return "-";
    std::sort(evaluations.begin(), evaluations.end());
    const double rank = std::ceil(share * static_cast<double>(evaluations.size()));
    return std::to_string(evaluations[static_cast<std::size_t>(std::max(rank - 1, 0.0))]);
  }
};

Row measure(const std::vector<Pair>& pairs, const std::string& kind, Solver solver) {
  Settings settings;
  settings.solver = solver;
  settings.max_evaluations = kMaxEvaluations;
  Row row;
  for (const Pair& pair : pairs) {
    if (pair.kind != kind) continue;
    const Proximity out = find_proximity(*pair.shape1, {}, *pair.shape2, pair.pose2, settings);
    const bool good = out.status == Status::Converged && std::abs(out.gap - pair.gap) <= kWrong * pair.unit;
    Tally& tally = pair.gap < -kTouching * pair.unit ? row.overlapping : row.apart;
    ++tally.pairs;
    if (good) {
      row.evaluations.push_back(out.evaluations);
    } else {
      ++tally.failures;
    }
  }
  return row;
}

void print_table(const std::vector<Pair>& pairs) {
  struct Named {
    Solver solver;
    const char* name;
  };
  constexpr Named kSolvers[] = {
      {Solver::Hybrid, "hybrid"}, {Solver::Newton, "Newton (Algorithm I)"}, {Solver::FixedPoint, "fixed point (Algorithm II)"}};
  std::printf("| class | solver | failures apart or touching | failures overlapped | median evaluations | 99th percentile |\n");
  std::printf("|---|---|---|---|---|---|\n");
  std::vector<std::string> kinds;
  for (const Pair& pair : pairs) {
    if (std::find(kinds.begin(), kinds.end(), pair.kind) == kinds.end()) kinds.push_back(pair.kind);
  }
  for (const std::string& kind : kinds) {
    for (const Named& named : kSolvers) {
      Row row = measure(pairs, kind, named.solver);
      std::printf("| %s | %s | %s | %s | %s | %s |\n", kind.c_str(), named.name, row.apart.text().c_str(),
                  row.overlapping.text().c_str(), row.percentile(0.5).c_str(), row.percentile(0.99).c_str());
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 2) {
    std::fprintf(stderr, "usage: solver_table [superellipsoid_pairs.csv]\n");
    return 2;
  }
  try {
    print_table(load_pairs(argc == 2 ? argv[1] : SUPERNORMAL_PAIRS));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "solver_table: %s\n", error.what());
    return 2;
  }
}
