#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "model/fit_union.hpp"
#include "study/compounds.hpp"

using namespace fit;

TEST_CASE("a dumbbell is taken apart") {
  const std::vector<Body> truth = make_compound("dumbbell");
  const Cloud cloud = scatter_union(truth, 700, 3e-4, 1);
  const std::vector<FittedBody> fitted = fit_union(cloud, 3, {.family = Family::Superellipsoid});
  REQUIRE(fitted.size() == 3);
  for (const Body& part : truth) {
    const auto nearest =
        std::ranges::min_element(fitted, {}, [&](const FittedBody& each) { return (each.body.position - part.position).norm(); });
    CHECK((nearest->body.position - part.position).norm() < 1e-3);
    CHECK((nearest->body.half_axes - part.half_axes).cwiseAbs().maxCoeff() < 1e-3);
    CHECK(std::abs(nearest->body.epsilon / part.epsilon - 1) < 0.1);
  }
}
