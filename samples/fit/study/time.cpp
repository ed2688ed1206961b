#include <array>
#include <cstdio>
#include <ctime>

#include "model/fit_body.hpp"
#include "studies.hpp"
#include "truth.hpp"

namespace fit {
namespace {

struct Case {
  Vector3 half_axes;
  double delta, epsilon, taper;
  bool is_half_missing;
};

double seconds_of(const Cloud& cloud, const FitSettings& settings) {
  const std::clock_t start = std::clock();
  fit_body(cloud, settings);
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

}  // namespace

void print_time() {
  std::puts("100 000 points, one thread; processor time, s\n");
  std::puts("| half-axes | delta, epsilon | taper | data | noise | of its family | auto |\n|---|---|---|---|---|---|---|");
  const Vector3 oblong(1.5, 1.1, 0.8), ball(1, 1, 1);
  const std::array<Case, 7> cases = {{{oblong, 2, 2, 0, false},
                                      {oblong, 2.5, 4, 0, false},
                                      {oblong, 8, 6, 0, false},
                                      {oblong, 1.2, 20, 0, false},
                                      {oblong, 2.5, 4, -0.3, false},
                                      {oblong, 8, 6, 0, true},
                                      {ball, 8, 6, 0, true}}};
  for (const Case& chosen : cases) {
    Body truth;
    truth.family = chosen.taper == 0 ? Family::Superellipsoid : Family::Superovoid;
    truth.half_axes = chosen.half_axes;
    truth.delta = chosen.delta;
    truth.epsilon = chosen.epsilon;
    truth.taper = chosen.taper;
    truth.position = {3, -2, 5};
    truth.orientation = Eigen::Quaterniond(0.7, 0.3, -0.2, 0.5).normalized();
    for (const double noise : {0.0, 0.01, 0.05}) {
      const Cloud cloud = scatter(truth, {.points = 100000, .noise = noise, .is_half_missing = chosen.is_half_missing});
      FitSettings settings;
      const double of_any = seconds_of(cloud, settings);
      settings.family = truth.family;
      std::printf("| %g, %g, %g | %g, %g | %g | %s | %g %% | %.2f | %.2f |\n", truth.half_axes.x(), truth.half_axes.y(),
                  truth.half_axes.z(), truth.delta, truth.epsilon, truth.taper, chosen.is_half_missing ? "half" : "whole",
                  100 * noise, seconds_of(cloud, settings), of_any);
      std::fflush(stdout);
    }
  }
}

}  // namespace fit
