#include "random_body.hpp"

#include <array>
#include <cmath>

namespace fit {

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

Body random_superellipsoid(std::mt19937_64& random) {
  const auto exponent = [&] { return 1 + std::exp(std::log(0.3) + std::log(7 / 0.3) * uniform(random)); };
  const double a = 1.2 + 0.4 * uniform(random), b = 0.8 + 0.3 * uniform(random), c = 0.4 + 0.3 * uniform(random);
  const std::array<Vector3, 3> orders = {Vector3(a, b, c), Vector3(c, a, b), Vector3(b, c, a)};
  Body body;
  body.family = Family::Superellipsoid;
  body.position = {3, -2, 5};
  body.half_axes = orders[random() % orders.size()];
  body.delta = exponent();
  body.epsilon = exponent();
  const double w = uniform(random) - 0.5, x = uniform(random) - 0.5, y = uniform(random) - 0.5, z = uniform(random) - 0.5;
  body.orientation = Eigen::Quaterniond(w, x, y, z).normalized();
  return body;
}

Body random_superovoid(std::mt19937_64& random, double share) {
  Body body = random_superellipsoid(random);
  body.family = Family::Superovoid;
  body.taper = (random() % 2 == 0 ? share : -share) * taper_limit(body.epsilon);
  return body;
}

}  // namespace fit
