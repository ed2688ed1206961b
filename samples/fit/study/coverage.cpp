#include <array>
#include <cmath>
#include <cstdio>

#include "compare.hpp"
#include "random_body.hpp"
#include "studies.hpp"

namespace fit {
namespace {

constexpr std::size_t kPoints = 1000;

struct Case {
  Family family;
  double noise;
  bool is_half_missing;
};

struct Kind {
  const char* name;
  int first, count;
};
constexpr std::array<Kind, 5> kKinds = {{{"centre", kPosition, 3},
                                         {"orientation", kRotation, 3},
                                         {"half-axes", kLogAxes, 3},
                                         {"exponents", kLogDelta, 2},
                                         {"taper", kTaper, 1}}};

struct Count {
  int one = 0, two = 0, all = 0, undetermined = 0;

  void add(const Compared& compared, int parameter) {
    if (!compared.is_determined[static_cast<std::size_t>(parameter)]) {
      ++undetermined;
      return;
    }
    const double ratio = std::abs(compared.deviation[parameter]) / compared.standard_error[parameter];
    ++all;
    if (ratio <= 1) ++one;
    if (ratio <= 2) ++two;
  }

  void print() const {
    if (all == 0) {
      std::printf(" – |");
    } else {
      std::printf(" %.0f, %.0f |", 100.0 * one / all, 100.0 * two / all);
    }
  }
};

void print_row(const Case& chosen, int bodies) {
  std::mt19937_64 random(11);
  std::array<Count, kKinds.size()> counts;
  Count below_noise;  // exponents of bodies with edges below the noise
  int other_axes = 0, edges_below_noise = 0;
  for (int k = 0; k < bodies; ++k) {
    const bool is_ovoid = chosen.family == Family::Superovoid;
    const Body truth = is_ovoid ? random_superovoid(random, 0.5) : random_superellipsoid(random);
    const Compared compared = fit_and_compare(truth, {.points = kPoints,
                                                      .noise = chosen.noise,
                                                      .is_half_missing = chosen.is_half_missing,
                                                      .seed = static_cast<std::uint64_t>(k) + 1});
    if (compared.has_other_axes) {
      ++other_axes;
      continue;
    }
    if (compared.is_edge_below_noise) {
      ++edges_below_noise;
      for (const int parameter : {kLogDelta, kLogEpsilon}) below_noise.add(compared, parameter);
      continue;
    }
    for (std::size_t i = 0; i < kKinds.size(); ++i) {
      if (kKinds[i].first == kTaper && !is_ovoid) continue;
      for (int j = 0; j < kKinds[i].count; ++j) counts[i].add(compared, kKinds[i].first + j);
    }
  }
  int undetermined = 0;
  std::printf("| %s | %s | %g %% |", name_of(chosen.family), chosen.is_half_missing ? "half" : "whole", 100 * chosen.noise);
  for (const Count& count : counts) {
    count.print();
    undetermined += count.undetermined;
  }
  std::printf(" %d | %d | %d |", undetermined, other_axes, edges_below_noise);
  below_noise.print();
  std::puts("");
  std::fflush(stdout);
}

}  // namespace

void print_coverage(int bodies) {
  std::printf("%d bodies a row, %zu points each; %% of the numbers within one and two standard errors\n\n", bodies, kPoints);
  std::printf("| body | data | noise |");
  for (const Kind& kind : kKinds) std::printf(" %s |", kind.name);
  std::puts(" ? | other axes | edges below noise | their exponents |\n|---|---|---|---|---|---|---|---|---|---|---|---|");
  for (const Case& chosen : {Case{Family::Superellipsoid, 0.01, false}, Case{Family::Superellipsoid, 0.05, false},
                             Case{Family::Superellipsoid, 0.01, true}, Case{Family::Superellipsoid, 0.05, true},
                             Case{Family::Superovoid, 0.01, false}, Case{Family::Superovoid, 0.05, false}}) {
    print_row(chosen, bodies);
  }
}

}  // namespace fit
