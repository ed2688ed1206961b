// Prints a number that depends on every digit of the answers for some pairs: tests/proximity/same_digits.cmake. The pairs are made
// without the C library's functions, whose digits may differ.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <random>

#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/shapes/superovoid.hpp"
#include "support/painted_stack.hpp"

using namespace supernormal;

namespace {

class Pairs {
 public:
  double uniform(double low, double high) { return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53); }

  Vector3 vector(double low, double high) { return Vector3{uniform(low, high), uniform(low, high), uniform(low, high)}; }

  double exponent() {
    const double x = uniform(0, 1);
    return 1.02 + 4 * x + 100 * x * x * x * x * x * x;
  }

  std::unique_ptr<Shape> shape() {
    const Vector3 half = vector(0.5, 1.5);
    switch (engine_() % 6) {
      case 0:
        return std::make_unique<Ellipsoid>(half);
      case 1: {
        const double taper = uniform(-0.2, 0.2);
        return std::make_unique<Superovoid>(half, 2 + exponent(), 2 + exponent(), taper, taper);
      }
      case 2:
        return std::make_unique<Cylinder>(half.x(), half.y());
      case 3:
        return std::make_unique<Box>(half);
      default: {
        const double delta = exponent();
        return std::make_unique<Superellipsoid>(half, delta, engine_() % 4 == 0 ? delta : exponent());
      }
    }
  }

  Pose pose(const Vector3& position) {
    double x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1), w = 1;
    const double scale = 1 / std::sqrt(x * x + y * y + z * z + w * w);
    x *= scale, y *= scale, z *= scale, w *= scale;
    Pose out{position, {}};
    out.rotation << 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), 2 * (x * y + w * z), 1 - 2 * (x * x + z * z),
        2 * (y * z - w * x), 2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y);
    return out;
  }

 private:
  std::mt19937_64 engine_{21};
};

}  // namespace

int main() {
  std::uint64_t sum = 14695981039346656037U;  // FNV-1a
  Pairs pairs;
  for (int k = 0; k < 5000; ++k) {
    const auto shape1 = pairs.shape(), shape2 = pairs.shape();
    const Pose pose1 = pairs.pose(pairs.vector(-1, 1)), pose2 = pairs.pose(pairs.vector(-1.8, 1.8));
    for (const double number : test::numbers_of(find_proximity(*shape1, pose1, *shape2, pose2))) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &number, sizeof bits);
      sum = (sum ^ bits) * 1099511628211U;
    }
  }
  std::printf("%016llx\n", static_cast<unsigned long long>(sum));
  return 0;
}
